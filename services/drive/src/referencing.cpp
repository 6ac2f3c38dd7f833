// SPDX-License-Identifier: Apache-2.0
// The reference of axes whose encoders do not know it: homing, and no motion of a channel without it.
#include <algorithm>
#include <cmath>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::drive {
namespace {
// Of the travel, its longest search: a switch may be somewhat beyond the software limits.
constexpr double longest_travel = 1.1;
constexpr double turn = 360;  // deg, in which a rotary axis passes its switch
// Of the longest travel, at creep feed: off the switch and back, and on to an index mark.
constexpr double slow_share = 0.25;
}  // namespace

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

// The slaves of a master move with it, so nothing is racked; each finds its own reference.
void DriveCore::home(std::uint16_t channel, std::uint16_t number) {
  const int found = machine::column_of(axes_, number);
  if (found < 0 || mode_ != Mode::FOLLOWING || any_active()) return;
  auto column = static_cast<std::size_t>(found);
  if (const auto* slave = slaves_.at(column); slave != nullptr && !slave->off)
    column = slave->master_column();
  homing_axis_ = column;
  homing_channel_ = channel;
  homing_members_ = {{column, 1, command_[column]}};
  for (auto& slave : slaves_.all()) {
    if (slave.master_column() != column || slave.off) continue;
    homing_members_.push_back({slave.column(), slave.pair.sign, command_[slave.column()]});
    slave.offset_known = false;
  }
  if (begin_homing(column)) return;
  // An absolute encoder whose position was lost gets its reference where it is.
  for (const auto& member : homing_members_)
    if (!status_.axes[member.column].homed)
      reference(member.column, limits_[member.column].reference - command_[member.column]);
  homing_members_.clear();
}

double DriveCore::homing_travel(std::size_t column) const {
  const double range = limits_[column].positive - limits_[column].negative;
  return longest_travel * (axes_[column].type == machine::axis_type_rotary ? std::min(range, turn) : range);
}

// False when no axis has to search.
bool DriveCore::begin_homing(std::size_t column) {
  Homing::Settings settings;
  settings.direction = 0;
  const auto& master = limits_[column];
  settings.search = std::min(master.homing_search, master.velocity);
  settings.creep = std::min(master.homing_creep, master.velocity);
  settings.acceleration = master.acceleration;
  settings.travel = homing_travel(column);
  settings.reference = master.reference;
  bool contrary = false;
  for (const auto& member : homing_members_) {
    const auto& l = limits_[member.column];
    settings.search = std::min({settings.search, l.homing_search, l.velocity});
    settings.creep = std::min({settings.creep, l.homing_creep, l.velocity});
    settings.acceleration = std::min(settings.acceleration, l.acceleration);
    if (l.homing_direction == 0) continue;
    const double direction = l.homing_direction * member.sign;
    contrary = contrary || (settings.direction != 0 && settings.direction != direction);
    settings.direction = direction;
    settings.index = settings.index || l.homing_marks == 1;
  }
  if (settings.direction == 0) return false;
  // Away from the switch and towards it at most.
  settings.seconds = 2 * settings.travel / settings.search + slow_share * settings.travel / settings.creep;
  if (contrary) {
    raise(alarm::homing_failed, axes_[column].number,
          "Axis " + axes_[column].name +
              " and its slaves search their references in opposite directions: see to parameter "
              "homing_direction");
    homing_members_.clear();
    return true;
  }
  homing_.start(settings, command_[column]);
  mode_ = Mode::HOMING;
  return true;
}

// The positions of an axis are greater by `shift` from now on.
void DriveCore::reference(std::size_t column, double shift) {
  hardware_->set_reference(column, shift);
  hardware_->status(status_);
  command_[column] += shift;
  row_.axes[column].position += shift;
  target_ = command_;
}

Homing::Signals DriveCore::homing_signals() {
  Homing::Signals all{false, true, true};
  for (auto& member : homing_members_) {
    const auto& l = limits_[member.column];
    const auto& axis = status_.axes[member.column];
    if (l.homing_direction == 0) continue;
    if (l.homing_marks == 2) {
      all.all_switches = all.all_switches && axis.scale_known;
      continue;
    }
    all.any_switch = all.any_switch || axis.home_switch;
    all.all_switches = all.all_switches && axis.home_switch;
    if (l.homing_marks != 1) continue;
    if (homing_.edges_found() && member.edge_taken && !member.mark_taken && axis.marks != member.marks) {
      member.latch = axis.mark_latch;
      member.mark_taken = true;
    }
    all.all_marks = all.all_marks && member.mark_taken;
  }
  return all;
}

void DriveCore::step_homing() {
  const double position = homing_.step_together(homing_signals(), dt_);
  const double moved = position - homing_members_.front().from;
  for (auto& member : homing_members_) {
    command_[member.column] = member.column == homing_axis_ ? position : member.from + member.sign * moved;
    if (!homing_.edges_found() || member.edge_taken) continue;
    member.edge_taken = true;
    member.latch = status_.axes[member.column].home_latch;
    member.marks = status_.axes[member.column].marks;
  }
  if (homing_.state() == Homing::State::moving) return;
  if (homing_.state() == Homing::State::done) {
    for (const auto& member : homing_members_) {
      const auto& l = limits_[member.column];
      const auto& axis = status_.axes[member.column];
      if (l.homing_direction != 0)
        reference(member.column, l.reference + (l.homing_marks == 2 ? axis.scale_shift : -member.latch));
      else if (!axis.homed)
        reference(member.column, l.reference - command_[member.column]);
    }
  } else if (enable_.demanded()) {
    report_homing_failure();
  }
  homing_members_.clear();
  target_ = command_;
  mode_ = enable_.demanded() ? Mode::FOLLOWING : Mode::OFF;
}

// Whoever has ended the search knows it.
void DriveCore::report_homing_failure() {
  const auto& axis = axes_[homing_axis_];
  const auto& settings = homing_.settings();
  const char* const unit = axis.type == machine::axis_type_linear ? "mm" : "deg";
  std::string most;
  if (homing_.failure() == Homing::Failure::travel) most = text::quantity(settings.travel, unit);
  if (homing_.failure() == Homing::Failure::time) most = text::quantity(settings.seconds, "s");
  if (most.empty()) return;
  const auto who = "Axis " + axis.name + (homing_members_.size() > 1 ? " or its slave" : "");
  const auto direction = machine::number_text(parameter::homing_direction.number(axis.number));
  if (limits_[homing_axis_].homing_marks == 2)
    raise(alarm::homing_failed, axis.number,
          who + " has not passed two marks of its scale within " + most +
              ": check the scale, its cable and parameter " + direction + ", then home again");
  else
    raise(alarm::homing_failed, axis.number,
          who + " has not found its " + (settings.index ? "home switch or index mark" : "home switch") +
              " within " + most + ": check the switch, its cable and parameter " + direction +
              ", then home again");
}

void DriveCore::abort_homing() { homing_.abort(); }

}  // namespace trunnion::drive
