// SPDX-License-Identifier: Apache-2.0
// Axes that a program or an MDI line homes (G28.2): one after the other, by the search of the drive that mode
// REF has, too.
#include <algorithm>

#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::channel {
namespace {

constexpr double millimetres_per_inch = 25.4;

/// mm/s or deg/s; 0 = the axis' own.
double search_speed(const language::Command& command, std::size_t axis) {
  const bool inches = !command.modal.metric && !canonical::is_rotary(axis);
  return command.value * (inches ? millimetres_per_inch : 1) / 60;
}

/// Of an axis the channel has.
std::uint16_t logical_axis(const machine::ChannelAxes& axes, std::size_t axis) {
  std::uint16_t number = 0;
  for (std::size_t i = 0; i < axes.index.size(); ++i)
    if (axes.index[i] == axis) number = axes.number[i];
  return number;
}

}  // namespace

void ChannelCore::set_unreferenced(std::set<std::uint16_t> axes) {
  homing_.set_unreferenced(std::move(axes));
  tell_references();
}

void ChannelCore::tell_references() {
  const auto names = names_without_reference();
  program_flow_.set_without_reference(names);
  mdi_.flow().set_without_reference(names);
}

std::uint16_t ChannelCore::homed_axes() const {
  const auto& axes = machine_.channel_axes();
  std::uint16_t homed = 0;
  for (std::size_t i = 0; i < axes.index.size(); ++i)
    if (homing_.referenced(axes.number[i])) homed = static_cast<std::uint16_t>(homed | 1u << axes.index[i]);
  return homed;
}

// A locked axis would move, and the positions shown are not those of the axes.
void ChannelCore::begin_program_homing(const language::Command& command) {
  if (lock_.any()) {
    flow().refuse_pending(language::AlarmNumber::homing_axis_locked);
    return;
  }
  program_homing_.begin(command.sequence, command.number);
  states_.wait();
  home_next();
}

// Of the axis, or of a slave that moves with it.
bool ChannelCore::has_home_switch(std::uint16_t axis) const {
  const auto has = [this](std::uint16_t number) {
    return parameters_->integer(parameter::homing_direction, number) != 0;
  };
  if (has(axis)) return true;
  const auto slaves = coupled_slaves(axis);
  return std::any_of(slaves.begin(), slaves.end(), has);
}

std::vector<std::uint16_t> ChannelCore::coupled_slaves(std::uint16_t axis) const {
  std::vector<std::uint16_t> slaves;
  for (const auto& pair : machine::gantry_pairs(*parameters_, number_))
    if (pair.master == axis && !link().taken_off(static_cast<std::size_t>(pair.slave_column)))
      slaves.push_back(pair.slave);
  return slaves;
}

// An axis whose encoder knows its position and that has no home switch has nothing to search. When the
// encoder does not know it, the drive would take the place where the axis is: that is for a person who sees
// it.
void ChannelCore::home_next() {
  while (const auto axis = program_homing_.next()) {
    const auto number = logical_axis(machine_.channel_axes(), *axis);
    if (!homing_.referenced(number) && !has_home_switch(number)) {
      event(alarm::homing_failed, program_name() + ":" + std::to_string(flow().main_line()) + ": axis " +
                                      std::string(1, canonical::axis_letters[*axis]) +
                                      " was not homed: it has no home switch. A reference return in mode REF "
                                      "makes the place where it is its reference position");
      stop_activity();
      return;
    }
    if (homing_.needed(number, parameters_.get())) {
      homing_.begin(number, search_speed(flow().pending(), *axis));
      advance_homing();
      return;
    }
    program_homing_.pass(*axis);
  }
  end_program_homing();
}

void ChannelCore::advance_program_homing() {
  const auto outcome = homing_.take_outcome();
  const auto axis = program_homing_.next();
  if (outcome == Homing::Outcome::none || !axis || !states_.in<Waiting>()) return;
  switch (outcome) {
    case Homing::Outcome::none:
      return;
    case Homing::Outcome::ended:  // cycle start goes on with it
      states_.end_wait(true);
      return;
    case Homing::Outcome::failed:
      event(alarm::homing_failed, program_name() + ":" + std::to_string(flow().main_line()) + ": axis " +
                                      std::string(1, canonical::axis_letters[*axis]) +
                                      " was not homed. See the alarm of the axis, then reset");
      stop_activity();
      return;
    case Homing::Outcome::found:
      break;
  }
  note_found(logical_axis(machine_.channel_axes(), *axis));
  program_homing_.pass(*axis);
  if (interlock_.holds() && program_homing_.next())
    states_.end_wait(true);
  else
    home_next();
}

// Slaves are homed with their master, but for those that are taken off.
void ChannelCore::note_found(std::uint16_t axis) {
  homing_.note_found(axis);
  for (const auto slave : coupled_slaves(axis)) homing_.note_found(slave);
  tell_references();
}

// The path begins anew where the drive has found the axes; offsets and modal state stay.
void ChannelCore::end_program_homing() {
  program_homing_.end();
  machine_start_ = machine_position();
  adopt_position();
  path().start(machine_start_, language::Transformation::none, path().tool_length());
  flow().home_ended(path().position());
  states_.end_wait(interlock_.holds());
}

}  // namespace trunnion::channel
