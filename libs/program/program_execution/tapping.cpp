// SPDX-License-Identifier: Apache-2.0
#include "program_execution/tapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::program_execution {

void Tapping::begin(const AxisValues& start, const language::Command& stroke) {
  active_ = true;
  start_ = start;
  lead_ = stroke.value;
  axis_ = stroke.number;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) length = std::hypot(length, stroke.target[i] - start[i]);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    direction_[i] = (stroke.target[i] - start[i]) / length;
    largest = std::max(largest, std::abs(direction_[i]));
  }
  along_axis_ = stroke.modal.transformation == language::Transformation::none && largest == 1;
}

double Tapping::revolutions(const AxisValues& position) const {
  double depth = 0;
  for (std::size_t i = 0; i < 3; ++i) depth += (position[i] - start_[i]) * direction_[i];
  return depth / lead_;
}

// Of a direction askew to the machine's axes the largest component is at least 1 / sqrt 3, so that share for
// each axis bounds the path.
motion::Limits Tapping::limits(motion::Limits limits, double acceleration) const {
  const double share = along_axis_ ? 1 : std::numbers::inv_sqrt3;
  const double most = share * acceleration / 360 * std::abs(lead_);
  for (std::size_t i = 0; i < 3; ++i)
    limits.axes[i].acceleration = std::min(limits.axes[i].acceleration, most);
  return limits;
}

double Tapping::override_of(double wanted, double speed, double highest) {
  return highest > 0 && wanted * speed > highest ? highest / speed : wanted;
}

language::Command Tapping::line(language::Command stroke) {
  stroke.kind = language::CommandKind::line;
  stroke.modal.feed_mode = language::FeedMode::per_minute;
  stroke.modal.feed = std::abs(stroke.value) * stroke_speed(stroke);
  stroke.modal.path_control = language::PathControl::exact_stop;
  return stroke;
}

}  // namespace trunnion::program_execution
