// SPDX-License-Identifier: Apache-2.0
#include "report/capture.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "bus/codec.hpp"
#include "bus/registry.hpp"
#include "contracts/topics.hpp"

namespace trunnion::report {
namespace {

constexpr std::size_t path_width = 9;

class Collector {
 public:
  Collector(Capture& out, std::uint16_t channel) : out_(out), channel_(channel) {
    for (const auto& stage : machine::service::stages)
      if (stage.transforms()) axis_stages_[bus::find_topic(stage.output)->description.name] = &stage;
  }

  void take(const recording::MessageView& message) {
    const std::string& topic = message.channel->topic;
    ++out_.messages;
    const auto time = static_cast<std::int64_t>(message.log_time);
    bool ok = true;
    if (topic == topics::path_batch.name)
      ok = bus::decode(message.data, path_), ok && on_path(time);
    else if (const auto stage = axis_stages_.find(topic); stage != axis_stages_.end())
      ok = bus::decode(message.data, axes_) && on_axes(stage->second, time);
    else if (topic == topics::feedback.name)
      ok = bus::decode(message.data, feedback_), ok && on_feedback(time);
    else if (topic == topics::parameter_set.name)
      ok = bus::decode(message.data, parameters_), ok && on_parameters();
    else if (topic == topics::tool_table.name)
      ok = out_.has_tools = bus::decode(message.data, out_.tables.tools);
    else if (topic == topics::work_offsets.name)
      ok = out_.has_offsets = bus::decode(message.data, out_.tables.offsets);
    if (!ok && out_.problem.empty()) out_.problem = "a message of " + topic + " is not of its type";
  }

  void finish() {
    for (const auto& [key, coverage] : coverage_) {
      out_.lost[key.first] += coverage.lost();
      out_.late_batches += coverage.late();
      out_.repeated_batches += coverage.repeated();
      if (key.first == "path_batch" && !coverage.begins_at_a_start() && out_.problem.empty())
        out_.problem = "the recording starts after the start of the motion";
    }
    // Of a cycle that was written again in a later epoch the first was void.
    std::stable_sort(out_.path.begin(), out_.path.end(), [](const PathRow& a, const PathRow& b) {
      return std::tuple(a.cycle, ~a.epoch) < std::tuple(b.cycle, ~b.epoch);
    });
    out_.path.erase(std::unique(out_.path.begin(), out_.path.end(),
                                [](const PathRow& a, const PathRow& b) { return a.cycle == b.cycle; }),
                    out_.path.end());
    sort(out_.gantry);
    sort(out_.commanded);
    sort(out_.actual);
    if (first_starved_) out_.starved = last_starved_ - *first_starved_;
  }

 private:
  recording::CycleCoverage& coverage(const std::string& handle, std::uint32_t epoch) {
    return coverage_[{handle, epoch}];
  }

  bool on_path(std::int64_t time) {
    if (path_.channel != channel_) return true;
    coverage("path_batch", path_.epoch).add(path_.first, path_.count, path_.starts, path_.ends);
    const std::size_t rows = std::min<std::size_t>(path_.count, path_.setpoints.size() / path_width);
    auto& times = out_.batches[{path_.epoch, path_.first}];
    const bool news = times.written[0] == 0;
    stamp(times, 0, time, path_.first + path_.count - 1);
    times.starts = path_.starts;
    if (!news) return true;
    for (std::size_t i = 0; i < rows; ++i) {
      const bool rtcp = path_.transformation == idl::stream::Transformation::RTCP;
      PathRow row{path_.first + i,   path_.epoch, i < path_.lines.size() ? path_.lines[i] : 0, rtcp,
                  path_.tool_length, {}};
      std::copy_n(&path_.setpoints[i * path_width], path_width, row.position.begin());
      out_.path.push_back(row);
    }
    return true;
  }

  bool on_axes(const machine::ServiceDefinition* definition, std::int64_t time) {
    if (axes_.channel != channel_ || axes_.axes.empty()) return true;
    const std::size_t stage = definition->stage - 1u;
    coverage(definition->output, axes_.epoch).add(axes_.first, axes_.count, axes_.starts, axes_.ends);
    auto& times = out_.batches[{axes_.epoch, axes_.first}];
    const bool news = times.written[stage] == 0;
    stamp(times, stage, time, axes_.first + axes_.count - 1);
    if (stage + 1 != batch_stages.size() || !news) return true;
    if (out_.gantry_axes.empty()) out_.gantry_axes = axes_.axes;
    if (out_.gantry_axes != axes_.axes) return true;
    const std::size_t rows = std::min<std::size_t>(axes_.count, axes_.setpoints.size() / axes_.axes.size());
    append(out_.gantry, axes_.axes.size(), axes_.first, rows, axes_.epoch, axes_.setpoints);
    return true;
  }

  bool on_feedback(std::int64_t time) {
    if (!first_starved_) first_starved_ = feedback_.starved;
    last_starved_ = feedback_.starved;
    if (feedback_.count == 0 || feedback_.axis_count == 0) return true;
    coverage("feedback", 0).add(feedback_.first, feedback_.count, false, false);
    out_.feedback.push_back({feedback_.first, feedback_.count, feedback_.tick, time});
    const std::size_t width = feedback_.axis_count;
    const std::size_t rows = std::min({static_cast<std::size_t>(feedback_.count),
                                       feedback_.commanded.size() / width, feedback_.actual.size() / width});
    append(out_.commanded, width, feedback_.first, rows, 0, feedback_.commanded);
    append(out_.actual, width, feedback_.first, rows, 0, feedback_.actual);
    return true;
  }

  bool on_parameters() {
    out_.tables.parameters = machine::parameters_of(parameters_);
    return out_.has_parameters = true;
  }

  static void stamp(BatchTimes& times, std::size_t stage, std::int64_t time, std::uint64_t last) {
    times.last_cycle = last;
    // Of two replicas the next stage used the first to arrive.
    auto& written = times.written[stage];
    if (written == 0 || time < written) written = time;
  }

  static void append(RowTable& table, std::size_t width, std::uint64_t first, std::size_t rows,
                     std::uint32_t epoch, const std::vector<double>& values) {
    if (table.width == 0) table.width = width;
    if (table.width != width) return;
    for (std::size_t i = 0; i < rows; ++i) {
      table.cycles.push_back(first + i);
      table.epochs.push_back(epoch);
    }
    table.values.insert(table.values.end(), values.begin(),
                        values.begin() + static_cast<std::ptrdiff_t>(rows * width));
  }

  // Ascending cycles, one row each, of the newest epoch.
  static void sort(RowTable& table) {
    if (std::adjacent_find(table.cycles.begin(), table.cycles.end(), std::greater_equal<>()) ==
        table.cycles.end())
      return;
    std::vector<std::size_t> order(table.cycles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(table.cycles[a], ~table.epochs[a]) < std::tuple(table.cycles[b], ~table.epochs[b]);
    });
    RowTable sorted;
    sorted.width = table.width;
    for (const auto i : order) {
      if (!sorted.cycles.empty() && sorted.cycles.back() == table.cycles[i]) continue;
      sorted.cycles.push_back(table.cycles[i]);
      sorted.epochs.push_back(table.epochs[i]);
      sorted.values.insert(sorted.values.end(), table.row(i), table.row(i) + table.width);
    }
    table = std::move(sorted);
  }

  Capture& out_;
  std::map<std::string, const machine::ServiceDefinition*> axis_stages_;  // by topic
  std::uint16_t channel_;
  std::map<std::pair<std::string, std::uint32_t>, recording::CycleCoverage> coverage_;
  std::optional<std::uint64_t> first_starved_;
  std::uint64_t last_starved_ = 0;
  idl::stream::PathBatch path_;
  idl::stream::AxisBatch axes_;
  idl::stream::Feedback feedback_;
  idl::parameters::ParameterSet parameters_;
};

}  // namespace

Capture read_capture(recording::Source& source, std::uint16_t channel) {
  Capture out;
  out.tables.channel = channel;
  Collector collector(out, channel);
  recording::Reader reader(source);
  recording::MessageView message;
  while (reader.next(message)) collector.take(message);
  collector.finish();
  out.complete = reader.ending() == recording::Ending::complete;
  out.damaged = !reader.damages().empty();
  if (!out.complete) out.problem = reader.problem();
  for (const auto& metadata : reader.metadata())
    if (metadata.name == "trunnion") out.metadata.insert(metadata.values.begin(), metadata.values.end());
  return out;
}

}  // namespace trunnion::report
