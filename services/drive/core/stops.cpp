// SPDX-License-Identifier: Apache-2.0
// What stops the axes, and what switches them off: supervision, the touch probe and drives.
#include <algorithm>
#include <cstdio>
#include <string>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "timeouts.hpp"

namespace trunnion::drive {

// An emergency stop chain that is open shows itself by nothing else: its alarm can be reset all the same.
void DriveCore::await_drives() {
  if (!enable_.is_late(mode_ == Mode::OFF, dt_)) return;
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
  if (mode_ == Mode::HOMING) note_search(HomingCycle::State::failed);
  streams_.refuse_waiting();
  enable_.lose();
  off_path_ = any_active();
  rate_.hold();
  rate_.forget_phase();
  reserve_ = 0;
  mode_ = Mode::OFF;
}

// Stop category 1: the drives of spindles that hold one part stay on until both are at rest.
bool DriveCore::spindles_run_down() const {
  return mode_ == Mode::OFF && !enable_.lost() && hardware_->enabled() &&
         spindles_.synchronization().must_run_down(status_.spindles);
}

// The drive of an axis that does not follow cannot be braked by setpoints, and the other axes stop with it.
void DriveCore::supervise() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const SupervisedAxis axis{axes_[i], limits_[i], status_.axes[i], command_[i], velocity_[i]};
    const bool moves = row_.axes[i].velocity != 0;
    if (supervision_.does_not_follow(i, axis, moves, row_.number, rows_.in_force())) {
      events_.push_back(excessive_following_error(axis));
      switch_off();
      return;
    }
    if (auto event = supervision_.finding(i, axis)) {
      events_.push_back(std::move(*event));
      stop();
    }
  }
  supervise_spindles();
}

// The axes go on with the thread, whether the spindle that follows them turns or not.
void DriveCore::supervise_spindles() {
  for (std::size_t i = 0; i < spindles_.size(); ++i) {
    auto& coupling = spindles_.coupling(static_cast<int>(i));
    const bool whole = mode_ == Mode::FOLLOWING && rate_.whole();
    if (!coupling.does_not_follow(row_.number, rows_.in_force(), status_.spindles[i].angle, whole)) continue;
    const auto& spindle = spindles_.axes()[i];
    char text[240];
    std::snprintf(text, sizeof text,
                  "Spindle %s does not follow the axes: following error %.2f deg, limit %.2f (parameter %s). "
                  "See what brakes it, then reset",
                  spindle.name.c_str(), coupling.following_error(), coupling.limit(),
                  machine::number_text(parameter::following_error_limit.number(spindle.number)).c_str());
    raise(alarm::following_error, spindle.number, text);
    stop();
  }
}

// Behind the last setpoint of a skip move the contact may still come: the axes follow with their lag.
void DriveCore::watch_probe() {
  if (!probe_.made((status_.skip_inputs & 1u) != 0, row_.probe_on)) return;
  if (mode_ != Mode::HOMING && streams_.any_skips()) return;
  std::string place;
  for (std::size_t i = 0; i < axes_.size() && place.size() < 120; ++i) {
    char text[48];
    const bool turns = axes_[i].type != machine::axis_type_linear;
    std::snprintf(text, sizeof text, "%s%s %.4f%s", place.empty() ? "" : ", ", axes_[i].name.c_str(),
                  status_.axes[i].position, turns ? " deg" : " mm");
    place += text;
  }
  raise(alarm::probe_contact, 0,
        "The touch probe made contact outside a skip move at " + place + ": reset, then retract the probe");
  if (mode_ == Mode::RETURNING)
    begin_braking();
  else
    stop();
}

void DriveCore::acknowledge() {
  supervision_.acknowledge();
  spindles_.acknowledge();
  enable_.acknowledge();
  hardware_->reset_faults();
}

}  // namespace trunnion::drive
