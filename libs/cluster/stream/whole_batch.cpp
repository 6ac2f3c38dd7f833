// SPDX-License-Identifier: Apache-2.0
#include "stream/whole_batch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trunnion::stream {
namespace {

constexpr std::size_t path_columns = 9;
constexpr std::uint64_t most_setpoints = 64, most_axes = 32;
constexpr std::uint64_t most_states = 4;  // of each stage one; a stage adds its own

// Keeps the first fault. Builds a text only when there is one.
class BatchCheck {
 public:
  void within(const char* field, std::uint64_t value, std::uint64_t low, std::uint64_t high) {
    if (!fault_.empty() || (value >= low && value <= high)) return;
    fault_ = std::string(field) + ": " + std::to_string(value) + ", must be " + std::to_string(low) + " to " +
             std::to_string(high);
  }
  void cycles(std::uint64_t first, std::uint64_t count) {
    within("first", first, 0, last_cycle - std::min(count, last_cycle));
  }
  template <class Value>
  void rows(const char* field, const std::vector<Value>& values, std::uint64_t count, std::uint64_t columns) {
    if (!fault_.empty() || values.size() == count * columns) return;
    fault_ = std::string(field) + ": " + std::to_string(values.size()) + " values, must be " +
             std::to_string(count) + " rows of " + std::to_string(columns);
  }
  template <class Value>
  void rows_or_none(const char* field, const std::vector<Value>& values, std::uint64_t count,
                    std::uint64_t columns) {
    if (!values.empty()) rows(field, values, count, columns);
  }
  void reachable(const char* field, const std::vector<double>& values) {
    if (!fault_.empty()) return;
    bool all = true;
    for (const double value : values) all = all && std::abs(value) <= farthest;  // false for NaN
    if (!all) fault_ = std::string(field) + ": farther than 1e12 mm or deg";
  }
  void axes(const std::vector<std::uint16_t>& axes) {
    within("axes", axes.size(), 1, most_axes);
    std::uint32_t seen = 0;
    for (const auto axis : axes) {
      within("axes", axis, 0, most_axes - 1);
      if (!fault_.empty()) return;
      if ((seen >> axis & 1u) != 0) fault_ = "axes: axis " + std::to_string(axis) + " twice";
      seen |= 1u << axis;
    }
  }
  std::string take() { return std::move(fault_); }

 private:
  std::string fault_;
};

template <class Batch>
void check_batch(BatchCheck& check, const Batch& batch, std::size_t columns) {
  check.within("count", batch.count, 1, most_setpoints);
  check.cycles(batch.first, batch.count);
  check.rows("setpoints", batch.setpoints, batch.count, columns);
  check.rows("lines", batch.lines, batch.count, 1);
  if (batch.follows_spindle)
    check.rows("spindle", batch.spindle, batch.count, 1);
  else
    check.rows_or_none("spindle", batch.spindle, batch.count, 1);
  check.reachable("setpoints", batch.setpoints);
  check.reachable("spindle", batch.spindle);
  check.rows_or_none("turning_radius", batch.turning_radius, batch.count, 1);
  check.reachable("turning_radius", batch.turning_radius);
  check.within("states", batch.states.size(), 0, most_states);
}

}  // namespace

std::string fault_of(const idl::stream::PathBatch& batch) {
  BatchCheck check;
  check_batch(check, batch, path_columns);
  return check.take();
}

std::string fault_of(const idl::stream::AxisBatch& batch) {
  BatchCheck check;
  check.axes(batch.axes);
  check_batch(check, batch, batch.axes.size());
  return check.take();
}

std::string fault_of(const idl::stream::Feedback& batch) {
  BatchCheck check;
  check.within("axis_count", batch.axis_count, 0, most_axes);
  check.within("count", batch.count, 0, most_feedback_rows);
  check.cycles(batch.first, batch.count);
  check.within("tick", batch.tick, 0, last_cycle);
  check.rows("commanded", batch.commanded, batch.count, batch.axis_count);
  check.rows("actual", batch.actual, batch.count, batch.axis_count);
  check.rows_or_none("spindle_angle", batch.spindle_angle, batch.count, batch.spindle_speed.size());
  check.rows_or_none("velocity", batch.velocity, 1, batch.axis_count);
  check.rows_or_none("torque", batch.torque, 1, batch.axis_count);
  check.rows_or_none("position", batch.position, 1, batch.axis_count);
  check.rows_or_none("enabled", batch.enabled, 1, batch.axis_count);
  check.reachable("commanded", batch.commanded);
  check.reachable("actual", batch.actual);
  check.reachable("position", batch.position);
  for (const auto& echo : batch.channels) {
    check.within("channels, next", echo.next, 0, last_cycle);
    check.within("channels, start", echo.start, 0, last_cycle);
  }
  return check.take();
}

}  // namespace trunnion::stream
