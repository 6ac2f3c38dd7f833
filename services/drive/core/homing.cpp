// SPDX-License-Identifier: Apache-2.0
// The reference of axes whose encoders do not know it: homing, and no motion of a channel without it.
#include <utility>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::drive {

using idl::stream::ReferenceSearch;

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

void DriveCore::home(ChannelStream& channel, const idl::stream::StreamRequest& request) {
  // As long as nothing else is known.
  channel.search = ReferenceSearch::SEARCH_FAILED;
  const int found = machine::column_of(axes_, request.axis);
  if (found < 0) return;
  if (mode_ == Mode::FOLLOWING && any_active())
    raise(alarm::homing_failed, request.axis,
          "Axis " + axes_[static_cast<std::size_t>(found)].name +
              " was not homed: another channel moves its axes. Wait until it has ended, then home again");
  if (mode_ != Mode::FOLLOWING || any_active()) return;
  auto column = static_cast<std::size_t>(found);
  if (const auto* slave = slaves_.at(column); slave != nullptr && !slave->off)
    column = slave->master_column();
  const auto& axis = axes_[column];
  homing_.gather(request.channel, column, slaves_, command_);
  switch (homing_.start(axis, limits_, command_, request.speed)) {
    case HomingGroup::Start::moves:
      channel.search = ReferenceSearch::SEARCHES;
      mode_ = Mode::HOMING;
      return;
    case HomingGroup::Start::nothing:
      channel.search = ReferenceSearch::REFERENCE_FOUND;
      reference_members();
      break;
    case HomingGroup::Start::contrary:
      raise(alarm::homing_failed, axis.number,
            "Axis " + axis.name +
                " and its slaves search their references in opposite directions: see to parameter "
                "homing_direction");
      break;
  }
  homing_.end();
}

// The channels take turns. Drives that are off refuse.
void DriveCore::begin_waiting_search() {
  while (mode_ != Mode::HOMING) {
    auto* const channel = streams_.next_waiting(homing_.channel());
    if (channel == nullptr) return;
    const auto request = std::exchange(channel->waiting, {});
    channel->request = request.request;
    home(*channel, request);
  }
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
  for (const auto& member : homing_.members()) {
    const auto i = member.column;
    const auto shift = HomingGroup::shift(member, limits_[i], status_.axes[i], command_[i]);
    if (shift) reference(i, *shift);
  }
}

// For the channel that has demanded it.
void DriveCore::note_search(HomingCycle::State state) {
  auto* const channel = streams_.find(homing_.channel());
  if (channel == nullptr) return;
  if (state == HomingCycle::State::moving)
    channel->search = homing_.leaves_switch() ? ReferenceSearch::MOVES_OFF_SWITCH : ReferenceSearch::SEARCHES;
  else if (state == HomingCycle::State::done)
    channel->search = ReferenceSearch::REFERENCE_FOUND;
  else
    channel->search = ReferenceSearch::SEARCH_FAILED;
}

void DriveCore::step_homing() {
  const auto state = homing_.step(limits_, status_.axes, dt_, command_);
  note_search(state);
  if (state == HomingCycle::State::moving) return;
  if (state == HomingCycle::State::done) {
    reference_members();
  } else if (enable_.demanded()) {
    const auto& axis = axes_[homing_.column()];
    auto text = homing_.failure(axis, limits_[homing_.column()]);
    if (!text.empty()) raise(alarm::homing_failed, axis.number, std::move(text));
  }
  homing_.end();
  target_ = command_;
  mode_ = enable_.demanded() ? Mode::FOLLOWING : Mode::OFF;
}

}  // namespace trunnion::drive
