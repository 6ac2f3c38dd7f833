// SPDX-License-Identifier: Apache-2.0
#include "program_execution/tapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::program_execution {
namespace {

constexpr double no_way = 1e-9;  // mm, of rounding in a tilted plane

}  // namespace

void Tapping::begin(const AxisValues& start, const language::Command& stroke, double highest_speed) {
  active_ = true;
  start_ = start;
  lead_ = stroke.value;
  highest_speed_ = highest_speed;
  axis_ = stroke.number;
  const auto way = [&](std::size_t axis) { return stroke.target[axis] - start[axis]; };
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i) length = std::hypot(length, way(i));
  first_ = length > no_way ? language::X : language::U;
  if (first_ == language::U) {
    length = 0;
    for (std::size_t i = 0; i < 3; ++i) length = std::hypot(length, way(first_ + i));
  }
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    direction_[i] = way(first_ + i) / length;
    largest = std::max(largest, std::abs(direction_[i]));
  }
  along_axis_ = largest == 1 &&
                (first_ == language::U || stroke.modal.transformation == language::Transformation::none);
}

double Tapping::revolutions(const AxisValues& position) const {
  double depth = 0;
  for (std::size_t i = 0; i < 3; ++i) depth += (position[first_ + i] - start_[first_ + i]) * direction_[i];
  return depth / lead_;
}

// Of a direction askew to the machine's axes the largest component is at least 1 / sqrt 3, so that share for
// each axis bounds the path.
motion::Limits Tapping::limits(motion::Limits limits, double acceleration) const {
  const double share = along_axis_ ? 1 : std::numbers::inv_sqrt3;
  const double most = share * acceleration / 360 * std::abs(lead_);
  for (std::size_t i = 0; i < 3; ++i) {
    auto& axis = limits.axes[first_ + i];
    axis.acceleration = std::min(axis.acceleration, most);
  }
  return limits;
}

double Tapping::fastest(const language::Command& stroke, double highest) {
  const double wanted = highest_override * fastest_stroke(stroke);
  return highest > 0 ? std::min(wanted, highest) : wanted;
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
