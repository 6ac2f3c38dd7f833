// SPDX-License-Identifier: Apache-2.0
// The reference of axes whose encoders do not know it: homing, and no motion of a channel without it.
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

void DriveCore::home(std::uint16_t channel, std::uint16_t number) {
  const int found = machine::column_of(axes_, number);
  if (found < 0 || mode_ != Mode::FOLLOWING || any_active()) return;
  auto column = static_cast<std::size_t>(found);
  if (const auto* slave = slaves_.at(column); slave != nullptr && !slave->off)
    column = slave->master_column();
  const auto& axis = axes_[column];
  search_.gather(channel, column, slaves_, command_);
  switch (search_.start(axis, limits_, command_)) {
    case HomingSearch::Start::moves:
      mode_ = Mode::HOMING;
      return;
    case HomingSearch::Start::nothing:
      reference_members();
      break;
    case HomingSearch::Start::contrary:
      raise(alarm::homing_failed, axis.number,
            "Axis " + axis.name +
                " and its slaves search their references in opposite directions: see to parameter "
                "homing_direction");
      break;
  }
  search_.end();
}

// The positions of an axis are greater by `shift` from now on.
void DriveCore::reference(std::size_t column, double shift) {
  hardware_->set_reference(column, shift);
  hardware_->status(status_);
  command_[column] += shift;
  row_.axes[column].position += shift;
  target_ = command_;
}

void DriveCore::reference_members() {
  for (const auto& member : search_.members()) {
    const auto i = member.column;
    const auto shift = HomingSearch::shift(member, limits_[i], status_.axes[i], command_[i]);
    if (shift) reference(i, *shift);
  }
}

void DriveCore::step_homing() {
  const auto state = search_.step(limits_, status_.axes, dt_, command_);
  if (state == Homing::State::moving) return;
  if (state == Homing::State::done) {
    reference_members();
  } else if (enable_.demanded()) {
    const auto& axis = axes_[search_.column()];
    auto text = search_.failure(axis, limits_[search_.column()]);
    if (!text.empty()) raise(alarm::homing_failed, axis.number, std::move(text));
  }
  search_.end();
  target_ = command_;
  mode_ = enable_.demanded() ? Mode::FOLLOWING : Mode::OFF;
}

}  // namespace trunnion::drive
