// SPDX-License-Identifier: Apache-2.0
// The reference of axes whose encoders do not know it: homing, and no motion of a channel without it.
#include <algorithm>
#include <cmath>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::drive {

// False, with an alarm that names them, when axes have no reference.
bool DriveCore::all_homed() {
  std::string names;
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (!status_.axes[i].homed) {
      if (names.empty()) first = axes_[i].number;
      names += (names.empty() ? "" : ", ") + axes_[i].name;
    }
  if (names.empty()) return true;
  raise(alarm::not_homed, first,
        "Axes without a reference: " + names + ". Mode REF, then reference return of each");
  return false;
}

void DriveCore::home(std::uint16_t number) {
  const int column = machine::column_of(axes_, number);
  if (column < 0 || mode_ != Mode::FOLLOWING || any_active()) return;
  homing_axis_ = static_cast<std::size_t>(column);
  const auto& l = limits_[homing_axis_];
  if (l.homing_direction == 0) {
    // An absolute encoder whose position was lost gets its reference where it is.
    if (!status_.axes[homing_axis_].homed) reference(l.reference - command_[homing_axis_]);
    return;
  }
  Homing::Settings settings;
  settings.direction = l.homing_direction;
  settings.search = std::min(l.homing_search, l.velocity);
  settings.creep = std::min(l.homing_creep, l.velocity);
  settings.acceleration = l.acceleration;
  settings.travel = l.positive - l.negative;
  settings.reference = l.reference;
  homing_.start(settings, command_[homing_axis_]);
  mode_ = Mode::HOMING;
}

// The positions of the axis that is homed are greater by `shift` from now on.
void DriveCore::reference(double shift) {
  hardware_->set_reference(homing_axis_, shift);
  hardware_->status(status_);
  command_[homing_axis_] += shift;
  row_.axes[homing_axis_].position += shift;
  target_ = command_;
}

void DriveCore::step_homing() {
  command_[homing_axis_] = homing_.step(status_.axes[homing_axis_], dt_);
  if (homing_.state() == Homing::State::moving) return;
  if (homing_.state() == Homing::State::done) {
    reference(homing_.shift());
  } else if (enabled_) {
    raise(alarm::homing_failed, axes_[homing_axis_].number,
          "Axis " + axes_[homing_axis_].name +
              " has not found its home switch: see to the switch and to parameter homing_direction");
  }
  target_ = command_;
  mode_ = enabled_ ? Mode::FOLLOWING : Mode::OFF;
}

void DriveCore::abort_homing() { homing_.abort(); }

}  // namespace trunnion::drive
