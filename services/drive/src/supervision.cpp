// SPDX-License-Identifier: Apache-2.0
// What stops the axes, and what switches them off: following errors, encoders that differ, travel, drives.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "timeouts.hpp"

namespace trunnion::drive {
namespace {
constexpr double excessive = 2;  // times the limit of the following error
}  // namespace

// An emergency stop chain that is open shows itself by nothing else: its alarm can be reset all the same.
void DriveCore::await_drives() {
  const bool waits = mode_ == Mode::OFF && enabled_ && !control_lost_;
  off_periods_ = waits ? off_periods_ + 1 : 0;
  if (off_periods_ * dt_ <= drives_on_timeout) return;
  char text[80];
  std::snprintf(text, sizeof text, "The drives are not on %g s after their enable", drives_on_timeout);
  lose_control(text);
}

// `text`: that the hardware has the drives off. Nothing can be braked on the path any longer.
void DriveCore::lose_control(std::string text) {
  const auto faulty =
      std::find_if(status_.axes.begin(), status_.axes.end(), [](const auto& a) { return a.fault; });
  if (faulty != status_.axes.end()) {
    const auto& axis = axes_[static_cast<std::size_t>(faulty - status_.axes.begin())];
    text = "The drive of axis " + axis.name + " reports a fault; the axes were switched off";
    if (*faulty->fault_text != 0) text += std::string(" (") + faulty->fault_text + ")";
    raise(alarm::drive_fault, axis.number, text + ": remove the cause, then reset the alarms");
    for (std::size_t i = 0; i < axes_.size(); ++i)
      if (status_.axes[i].partner_fault)
        raise(alarm::partner_stopped, axes_[i].number,
              "The drive of axis " + axes_[i].name + " has stopped with that of its partner, axis " +
                  axis.name);
  } else {
    raise(alarm::drive_fault, 0, text + ": see to its emergency stop chain, then reset the alarms");
  }
  switch_off();
}

void DriveCore::switch_off() {
  control_lost_ = true;
  off_path_ = any_active();
  rate_.hold();
  rate_.forget_phase();
  reserve_ = 0;
  mode_ = Mode::OFF;
}

// An error behind which a stop along the path moves the axis only further: it is far beyond its limit, or is
// there still when the axis should have come to rest. The row in force counts, not the newest of a queue.
bool DriveCore::does_not_follow(std::size_t i) {
  const double limit = limits_[i].following, error = std::abs(status_.axes[i].following_error);
  if (row_.axes[i].velocity != 0) moved_[i] = row_.number;
  if (limit <= 0 || error <= limit) {
    unsettled_[i] = 0;
    return false;
  }
  unsettled_[i] = rows_.in_force() > moved_[i] ? unsettled_[i] + 1 : 0;
  return error > excessive * limit || unsettled_[i] > settling_periods;
}

// Its drive cannot be braked by setpoints, and the other axes stop with it.
void DriveCore::switch_off_for(std::size_t i) {
  const auto& axis = axes_[i];
  char text[240];
  std::snprintf(
      text, sizeof text,
      "Axis %s does not follow: following error %.4f %s, limit %.4f (parameter %s). The drives were "
      "switched off: check its encoder, motor and direction, then reset",
      axis.name.c_str(), status_.axes[i].following_error,
      axis.type == machine::axis_type_linear ? "mm" : "deg", limits_[i].following,
      machine::number_text(parameter::following_error_limit.number(axis.number)).c_str());
  raise(alarm::following_error_excessive, axis.number, text);
  switch_off();
}

// By the encoder, too: the setpoint is within the travel while the axis runs away from it.
std::optional<double> DriveCore::beyond_travel(std::size_t i) const {
  constexpr double margin = 0.5;
  const auto& l = limits_[i];
  const auto& axis = status_.axes[i];
  if ((command_[i] > l.positive + margin && velocity_[i] > 0) ||
      (command_[i] < l.negative - margin && velocity_[i] < 0))
    return command_[i];
  if (!axis.homed) return std::nullopt;
  const double ahead = axis.position - command_[i];
  if ((axis.position > l.positive + margin && ahead > margin && axis.velocity > 0) ||
      (axis.position < l.negative - margin && ahead < -margin && axis.velocity < 0))
    return axis.position;
  return std::nullopt;
}

void DriveCore::supervise() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (does_not_follow(i)) {
      switch_off_for(i);
      return;
    }
    if (reported_[i]) continue;
    const auto& l = limits_[i];
    const double error = status_.axes[i].following_error;
    char text[200];
    if (l.following > 0 && std::abs(error) > l.following) {
      std::snprintf(text, sizeof text, "Axis %s: following error %.4f, limit %.4f (parameter %s)",
                    axes_[i].name.c_str(), error, l.following,
                    machine::number_text(parameter::following_error_limit.number(axes_[i].number)).c_str());
      raise(alarm::following_error, axes_[i].number, text);
    } else if (const double difference = status_.axes[i].encoder_difference;
               l.encoder_difference > 0 && std::abs(difference) > l.encoder_difference) {
      std::snprintf(
          text, sizeof text, "Axis %s: motor and load encoder differ by %.4f, limit %.4f (parameter %s)",
          axes_[i].name.c_str(), difference, l.encoder_difference,
          machine::number_text(parameter::encoder_difference_limit.number(axes_[i].number)).c_str());
      raise(alarm::encoder_difference, axes_[i].number, text);
    } else if (const auto at = beyond_travel(i)) {
      std::snprintf(text, sizeof text, "Axis %s at %.4f is beyond its travel %.4f .. %.4f",
                    axes_[i].name.c_str(), *at, l.negative, l.positive);
      raise(alarm::over_travel, axes_[i].number, text);
    } else {
      continue;
    }
    reported_[i] = true;
    stop();
  }
}

void DriveCore::acknowledge() {
  std::fill(reported_.begin(), reported_.end(), false);
  control_lost_ = false;
  off_periods_ = 0;
  hardware_->reset_faults();
}

}  // namespace trunnion::drive
