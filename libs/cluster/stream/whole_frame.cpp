// SPDX-License-Identifier: Apache-2.0
#include "stream/whole_frame.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace trunnion::stream {
namespace {

constexpr std::size_t path_columns = 9;
constexpr std::uint64_t most_setpoints = 64, most_axes = 32;
constexpr std::uint64_t most_states = 4;  // of each stage one; a stage adds its own

// Keeps the first fault. Builds a text only when there is one.
class FrameCheck {
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

template <class Frame>
void check_batch(FrameCheck& check, const Frame& frame, std::size_t columns) {
  check.within("count", frame.count, 1, most_setpoints);
  check.cycles(frame.first, frame.count);
  check.rows("setpoints", frame.setpoints, frame.count, columns);
  check.rows("lines", frame.lines, frame.count, 1);
  check.rows_or_none("spindle", frame.spindle, frame.count, 1);
  check.reachable("setpoints", frame.setpoints);
  check.reachable("spindle", frame.spindle);
  check.within("states", frame.states.size(), 0, most_states);
}

}  // namespace

std::string fault_of(const idl::stream::PathFrame& frame) {
  FrameCheck check;
  check_batch(check, frame, path_columns);
  return check.take();
}

std::string fault_of(const idl::stream::AxisFrame& frame) {
  FrameCheck check;
  check.axes(frame.axes);
  check_batch(check, frame, frame.axes.size());
  return check.take();
}

std::string fault_of(const idl::stream::FeedbackFrame& frame) {
  FrameCheck check;
  check.within("axis_count", frame.axis_count, 0, most_axes);
  check.within("count", frame.count, 0, most_feedback_rows);
  check.cycles(frame.first, frame.count);
  check.within("tick", frame.tick, 0, last_cycle);
  check.rows("commanded", frame.commanded, frame.count, frame.axis_count);
  check.rows("actual", frame.actual, frame.count, frame.axis_count);
  check.rows_or_none("spindle_angle", frame.spindle_angle, frame.count, frame.spindle_speed.size());
  check.rows_or_none("velocity", frame.velocity, 1, frame.axis_count);
  check.rows_or_none("torque", frame.torque, 1, frame.axis_count);
  check.rows_or_none("position", frame.position, 1, frame.axis_count);
  check.rows_or_none("enabled", frame.enabled, 1, frame.axis_count);
  check.reachable("commanded", frame.commanded);
  check.reachable("actual", frame.actual);
  check.reachable("position", frame.position);
  for (const auto& echo : frame.channels) {
    check.within("channels, next", echo.next, 0, last_cycle);
    check.within("channels, start", echo.start, 0, last_cycle);
  }
  return check.take();
}

}  // namespace trunnion::stream
