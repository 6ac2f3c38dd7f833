// SPDX-License-Identifier: Apache-2.0
#include "hostile_writer.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>

#include "contracts/topics.hpp"

namespace trunnion::integration {
namespace {

using Random = std::mt19937_64;

std::size_t draw(Random& random, std::size_t below) { return static_cast<std::size_t>(random() % below); }

// Of a field: what its type can hold at all, and what is near to the value it has.
template <class T>
void change(T& value, Random& random) {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_same_v<T, bool>) {
    value = !value;
  } else if constexpr (std::is_same_v<T, std::string>) {
    const std::string others[] = {"", "../../x", std::string(200, 'x'), "\xff\xfe", value + "x"};
    value = others[draw(random, std::size(others))];
  } else if constexpr (std::is_enum_v<T>) {
    value = static_cast<T>(draw(random, bus::enum_size<T>() + 1));
  } else if constexpr (std::is_floating_point_v<T>) {
    const T others[] = {0,        -value,    value + 1,          value * 2,        T(1e-300),
                        T(1e6),   T(-1e12),  Limits::max(),      Limits::lowest(), Limits::infinity(),
                        T(1e300), T(-1e300), Limits::quiet_NaN()};
    value = others[draw(random, std::size(others))];
  } else {
    using Bits = std::make_unsigned_t<T>;  // wraps round
    const auto bits = static_cast<Bits>(value);
    const T others[] = {T(0),
                        T(1),
                        T(2),
                        T(31),
                        T(32),
                        T(Limits::max() / 2),
                        Limits::min(),
                        Limits::max(),
                        T(Bits(bits + 1)),
                        T(Bits(bits - 1)),
                        T(Bits(bits * 2))};
    value = others[draw(random, std::size(others))];
  }
}

/// Visits the fields of a message and changes one of them, counted through all its structs.
class Change {
 public:
  Change(Random& random, std::size_t target) : random_(random), target_(target) {}
  template <class T>
  void operator()(const char*, T& value, std::size_t bound, std::size_t = 0) {
    visit(value, bound);
  }
  std::size_t fields() const { return at_; }

 private:
  static constexpr std::size_t most_elements = 4096, most_visited = 8;

  template <class T>
  void visit(T& value, std::size_t bound) {
    if constexpr (bus::Struct<T>) {
      bus::Fields<T>::visit(value, *this);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, std::string>) {
      if (at_++ == target_) change(value, random_);
      if constexpr (std::is_same_v<T, std::string>) value.resize(std::min(value.size(), bound));
    } else {
      if (at_++ == target_) change_length(value, std::min(bound, most_elements));
      if (value.empty()) return;
      // Of numbers any one; of structs some.
      if constexpr (std::is_arithmetic_v<typename T::value_type>)
        visit(value[draw(random_, value.size())], 0);
      else
        for (std::size_t i = 0; i < std::min(value.size(), most_visited); ++i) visit(value[i], most_elements);
    }
  }
  template <class T>
  void change_length(std::vector<T>& values, std::size_t bound) {
    const std::size_t others[] = {0, 1, values.size() / 2, values.size() + 1, bound};
    values.resize(std::min(others[draw(random_, std::size(others))], bound));
  }

  Random& random_;
  std::size_t target_, at_ = 0;
};

template <class Visit>
void for_every_topic(Visit&& visit) {
  visit(topics::path_batch);
  visit(topics::kinematics_batch);
  visit(topics::compensation_batch);
  visit(topics::gantry_batch);
  visit(topics::feedback);
  visit(topics::stream_request);
  visit(topics::servo_test_request);
  visit(topics::servo_test_samples);
  visit(topics::stage_progress);
  visit(topics::recording_progress);
  visit(topics::channel_state);
  visit(topics::variables);
  visit(topics::channel_request);
  visit(topics::channel_reply);
  visit(topics::auxiliary_request);
  visit(topics::auxiliary_done);
  visit(topics::macro_signal);
  visit(topics::cycle_request);
  visit(topics::cycle_reply);
  visit(topics::plc_outputs);
  visit(topics::plc_image);
  visit(topics::plc_input_log);
  visit(topics::panel_request);
  visit(topics::panel_reply);
  visit(topics::online_request);
  visit(topics::online_reply);
  visit(topics::plc_watched);
  visit(topics::plc_forces);
  visit(topics::plc_programs);
  visit(topics::parameter_set);
  visit(topics::tool_table);
  visit(topics::work_offsets);
  visit(topics::parameter_request);
  visit(topics::parameter_reply);
  visit(topics::program_list);
  visit(topics::program_request);
  visit(topics::program_reply);
  visit(topics::measurement_request);
  visit(topics::measurement_reply);
  visit(topics::measurement_state);
  visit(topics::measurement_result);
  visit(topics::announcement);
  visit(topics::service_state);
  visit(topics::alarm);
  visit(topics::alarm_reset);
  visit(topics::snapshot_request);
  visit(topics::service_snapshot);
  visit(topics::cluster);
  visit(topics::launcher_identity);
  visit(topics::promotion);
  visit(topics::swap_request);
  visit(topics::swap_reply);
  visit(topics::operator_request);
}

}  // namespace

class HostileWriter::Forger {
 public:
  explicit Forger(std::string topic) : topic_(std::move(topic)) {}
  virtual ~Forger() = default;
  /// True when there is a message of the topic.
  virtual bool take() = 0;
  virtual void forge(Random& random) = 0;
  Written written() const { return {topic_, messages_}; }

 protected:
  std::string topic_;
  std::uint64_t messages_ = 0;
};

namespace {

template <class T>
class ForgerOf : public HostileWriter::Forger {
 public:
  ForgerOf(bus::Bus& bus, const bus::Topic<T>& topic)
      : Forger(topic.name), writer_(bus.writer(topic)), reader_(bus.reader(topic)) {}

  bool take() override {
    T value;
    while (reader_.take(value))
      if (std::find(own_.begin(), own_.end(), value) == own_.end()) newest_ = value;
    return newest_.has_value();
  }
  void forge(Random& random) override {
    T value = *newest_;
    for (std::size_t n = 1 + draw(random, 3); n > 0; --n) {
      Change count(random, std::numeric_limits<std::size_t>::max());
      bus::Fields<T>::visit(value, count);
      Change one(random, draw(random, std::max<std::size_t>(1, count.fields())));
      bus::Fields<T>::visit(value, one);
    }
    try {
      writer_.write(value);
    } catch (const bus::CdrError&) {
      return;  // longer than its bound: no message of the type
    }
    ++messages_;
    own_.push_back(std::move(value));
    if (own_.size() > remembered) own_.pop_front();
  }

 private:
  static constexpr std::size_t remembered = 64;  // of its own messages, which its reader finds, too
  bus::Writer<T> writer_;
  bus::Reader<T> reader_;
  std::optional<T> newest_;
  std::deque<T> own_;
};

}  // namespace

HostileWriter::HostileWriter(const bus::NetworkSettings& network, std::uint64_t seed,
                             const std::set<std::string>& spared)
    : random_(seed), bus_(bus::Vendor::cyclonedds, network) {
  for_every_topic([&]<class T>(const bus::Topic<T>& topic) {
    if (!spared.contains(topic.name)) forgers_.push_back(std::make_unique<ForgerOf<T>>(bus_, topic));
  });
}

HostileWriter::~HostileWriter() = default;

void HostileWriter::write() {
  std::vector<Forger*> ready;
  for (auto& forger : forgers_)
    if (forger->take()) ready.push_back(forger.get());
  if (!ready.empty()) ready[draw(random_, ready.size())]->forge(random_);
}

std::vector<HostileWriter::Written> HostileWriter::written() const {
  std::vector<Written> all;
  for (const auto& forger : forgers_) all.push_back(forger->written());
  return all;
}

}  // namespace trunnion::integration
