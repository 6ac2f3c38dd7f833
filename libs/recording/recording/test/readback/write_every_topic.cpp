// SPDX-License-Identifier: Apache-2.0
// Writes a recording with one message of every topic, and a JSON file with what is in it.
// Usage: write_every_topic RECORDING EXPECTED
#include <fstream>
#include <iostream>
#include <string_view>
#include <type_traits>

#include "bus/codec.hpp"
#include "bus/json.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"
#include "recording/file_stream.hpp"
#include "recording/mcap_writer.hpp"

namespace {

using namespace trunnion;

// Gives every field another value, none of them zero or empty.
class Filler {
 public:
  template <class T>
  void operator()(const char*, T& value, std::size_t bound, std::size_t element_bound = 0) {
    fill(value, bound, element_bound);
  }

 private:
  template <class T>
  void fill(T& value, std::size_t bound, std::size_t element_bound = 0) {
    ++count_;
    if constexpr (bus::Struct<T>) {
      bus::Fields<T>::visit(value, *this);
      bus::Fields<T>::visit_limits(value, [&](const char* limited, const auto&, std::int64_t low,
                                              std::int64_t high) { limit(value, limited, low, high); });
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(1 + count_ % (bus::enum_size<T>() - 1));
    } else if constexpr (std::is_same_v<T, bool>) {
      value = true;
    } else if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(-0.1 - 1.7 * static_cast<double>(count_));
    } else if constexpr (std::is_integral_v<T>) {
      // All bytes differ and JSON's doubles still hold it.
      value = static_cast<T>(0x0001020304050600ull * (sizeof(T) == 8) + 0x01020300ull * (sizeof(T) >= 4) + 1 +
                             count_ % 120);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = "\xc3\xa4 " + std::to_string(count_);  // text is UTF-8
      if (bound != 0) value.resize(std::min(bound, value.size()));
    } else {
      value.resize(bound == 0 ? 3 : std::min<std::size_t>(bound, 3));
      for (auto& element : value) fill(element, element_bound);
    }
  }
  template <class T>
  void limit(T& value, std::string_view limited, std::int64_t low, std::int64_t high) {
    bus::Fields<T>::visit(value, [&](std::string_view name, auto& field, std::size_t, std::size_t = 0) {
      if constexpr (std::is_integral_v<std::remove_reference_t<decltype(field)>>)
        if (name == limited)
          field = static_cast<std::remove_reference_t<decltype(field)>>(
              low + 1 + static_cast<std::int64_t>(count_ % static_cast<std::uint64_t>(high - low)));
    });
  }
  std::uint64_t count_ = 0;
};

class EveryTopic {
 public:
  explicit EveryTopic(const std::string& path) : sink_(path), writer_(sink_, {.chunk_bytes = 2000}) {
    const recording::StringMap metadata = {{"machine", "readback"}, {"domain", "7"}};
    writer_.metadata("trunnion", metadata);
    expected_["metadata"] = metadata;
  }

  template <class T>
  void add(const bus::Topic<T>& topic) {
    const auto* entry = bus::find_topic(topic.name);
    T value;
    filler_("", value, 0);
    bus::encode(value, bytes_);
    const auto channel = writer_.add_channel(topic.name, entry->type, entry->schema);
    const auto sequence = static_cast<std::uint32_t>(100 + count_);
    const std::uint64_t time = 1'700'000'000'000'000'000ull + 1000ull * count_;
    ok_ = writer_.write(channel, sequence, time, bytes_) && ok_;
    expected_["topics"][topic.name] = {{"type", entry->type},
                                       {"sequence", sequence},
                                       {"time", std::to_string(time)},
                                       {"value", entry->to_json(bytes_)}};
    ++count_;
  }

  bool finish(const std::string& expected_path) {
    if (!writer_.finish() || !ok_) {
      std::cerr << sink_.problem() << "\n";
      return false;
    }
    if (count_ != bus::all_topics().size()) {
      std::cerr << count_ << " of " << bus::all_topics().size() << " topics are written here\n";
      return false;
    }
    std::ofstream file(expected_path);
    file << expected_.dump();
    return static_cast<bool>(file.flush());
  }

 private:
  recording::FileSink sink_;
  recording::Writer writer_;
  Filler filler_;
  bus::Bytes bytes_;
  bus::Json expected_;
  std::size_t count_ = 0;
  bool ok_ = true;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  EveryTopic all(argv[1]);
  all.add(topics::path_batch);
  all.add(topics::kinematics_batch);
  all.add(topics::compensation_batch);
  all.add(topics::gantry_batch);
  all.add(topics::feedback);
  all.add(topics::stream_request);
  all.add(topics::stage_progress);
  all.add(topics::recording_progress);
  all.add(topics::channel_state);
  all.add(topics::variables);
  all.add(topics::channel_request);
  all.add(topics::channel_reply);
  all.add(topics::auxiliary_request);
  all.add(topics::auxiliary_done);
  all.add(topics::macro_signal);
  all.add(topics::cycle_request);
  all.add(topics::cycle_reply);
  all.add(topics::plc_outputs);
  all.add(topics::plc_image);
  all.add(topics::plc_input_log);
  all.add(topics::panel_request);
  all.add(topics::panel_reply);
  all.add(topics::online_request);
  all.add(topics::online_reply);
  all.add(topics::plc_watched);
  all.add(topics::plc_forces);
  all.add(topics::plc_programs);
  all.add(topics::parameter_set);
  all.add(topics::tool_table);
  all.add(topics::work_offsets);
  all.add(topics::parameter_request);
  all.add(topics::parameter_reply);
  all.add(topics::program_list);
  all.add(topics::program_request);
  all.add(topics::program_reply);
  all.add(topics::measurement_request);
  all.add(topics::measurement_reply);
  all.add(topics::measurement_state);
  all.add(topics::measurement_result);
  all.add(topics::announcement);
  all.add(topics::service_state);
  all.add(topics::alarm);
  all.add(topics::alarm_reset);
  all.add(topics::snapshot_request);
  all.add(topics::service_snapshot);
  all.add(topics::cluster);
  all.add(topics::swap_request);
  all.add(topics::swap_reply);
  all.add(topics::launcher_identity);
  all.add(topics::promotion);
  all.add(topics::operator_request);
  all.add(topics::servo_test_request);
  all.add(topics::servo_test_samples);
  return all.finish(argv[2]) ? 0 : 1;
}
