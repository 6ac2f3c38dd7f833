// SPDX-License-Identifier: Apache-2.0
#include "axis_supervision.hpp"

#include <cmath>
#include <cstdio>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {
namespace {

constexpr double excessive = 2;  // times the limit of the following error

// By the encoder, too: the setpoint is within the travel while the axis runs away from it.
std::optional<double> beyond_travel(const SupervisedAxis& axis) {
  constexpr double margin = 0.5;
  const auto& l = axis.limits;
  const auto& status = axis.status;
  if ((axis.command > l.positive + margin && axis.velocity > 0) ||
      (axis.command < l.negative - margin && axis.velocity < 0))
    return axis.command;
  if (!status.homed) return std::nullopt;
  const double ahead = status.position - axis.command;
  if ((status.position > l.positive + margin && ahead > margin && status.velocity > 0) ||
      (status.position < l.negative - margin && ahead < -margin && status.velocity < 0))
    return status.position;
  return std::nullopt;
}

std::optional<DriveEvent> fault_of(const SupervisedAxis& axis) {
  const auto& l = axis.limits;
  const auto& info = axis.info;
  const double error = axis.status.following_error;
  char text[200];
  if (l.following > 0 && std::abs(error) > l.following) {
    std::snprintf(text, sizeof text, "Axis %s: following error %.4f, limit %.4f (parameter %s)",
                  info.name.c_str(), error, l.following,
                  machine::number_text(parameter::following_error_limit.number(info.number)).c_str());
    return DriveEvent{&alarm::following_error, info.number, text};
  }
  if (const double difference = axis.status.encoder_difference;
      l.encoder_difference > 0 && std::abs(difference) > l.encoder_difference) {
    std::snprintf(text, sizeof text,
                  "Axis %s: motor and load encoder differ by %.4f, limit %.4f (parameter %s)",
                  info.name.c_str(), difference, l.encoder_difference,
                  machine::number_text(parameter::encoder_difference_limit.number(info.number)).c_str());
    return DriveEvent{&alarm::encoder_difference, info.number, text};
  }
  if (const auto at = beyond_travel(axis)) {
    std::snprintf(text, sizeof text, "Axis %s at %.4f is beyond its travel %.4f .. %.4f", info.name.c_str(),
                  *at, l.negative, l.positive);
    return DriveEvent{&alarm::over_travel, info.number, text};
  }
  return std::nullopt;
}

}  // namespace

DriveEvent excessive_following_error(const SupervisedAxis& axis) {
  const auto& info = axis.info;
  char text[240];
  std::snprintf(
      text, sizeof text,
      "Axis %s does not follow: following error %.4f %s, limit %.4f (parameter %s). The drives were "
      "switched off: check its encoder, motor and direction, then reset",
      info.name.c_str(), axis.status.following_error, info.type == machine::axis_type_linear ? "mm" : "deg",
      axis.limits.following,
      machine::number_text(parameter::following_error_limit.number(info.number)).c_str());
  return {&alarm::following_error_excessive, info.number, text};
}

void AxisSupervision::configure(std::size_t axes) {
  reported_.assign(axes, false);
  moved_.assign(axes, 0);
  unsettled_.assign(axes, 0);
}

bool AxisSupervision::does_not_follow(std::size_t i, const SupervisedAxis& axis, bool moves,
                                      std::uint64_t row, std::uint64_t in_force) {
  const double limit = axis.limits.following, error = std::abs(axis.status.following_error);
  if (moves) moved_[i] = row;
  if (limit <= 0 || error <= limit) {
    unsettled_[i] = 0;
    return false;
  }
  unsettled_[i] = in_force > moved_[i] ? unsettled_[i] + 1 : 0;
  return error > excessive * limit || unsettled_[i] > settling_periods;
}

std::optional<DriveEvent> AxisSupervision::finding(std::size_t i, const SupervisedAxis& axis) {
  if (reported_[i]) return std::nullopt;
  auto fault = fault_of(axis);
  if (fault) reported_[i] = true;
  return fault;
}

}  // namespace trunnion::drive
