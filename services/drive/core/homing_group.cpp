// SPDX-License-Identifier: Apache-2.0
#include "homing_group.hpp"

#include <algorithm>

#include "machine/parameter_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::drive {
namespace {

// Of the travel, its longest search: a switch may be somewhat beyond the software limits.
constexpr double longest_travel = 1.1;
constexpr double turn = 360;  // deg, in which a rotary axis passes its switch
// Of the longest travel, at creep feed: off the switch and back, and on to an index mark.
constexpr double slow_share = 0.25;

double search_travel(const machine::AxisInfo& axis, const AxisLimits& limits) {
  const double range = limits.positive - limits.negative;
  return longest_travel * (axis.type == machine::axis_type_rotary ? std::min(range, turn) : range);
}

}  // namespace

void HomingGroup::gather(std::uint16_t channel, std::size_t column, GantrySlaves& slaves,
                         const std::vector<double>& command) {
  column_ = column;
  channel_ = channel;
  members_.reserve(1 + slaves.all().size());
  members_ = {{column, 1, command[column]}};
  for (auto& slave : slaves.all()) {
    if (slave.master_column() != column || slave.off) continue;
    members_.push_back({slave.column(), slave.pair.sign, command[slave.column()]});
    slave.offset_known = false;
  }
}

HomingGroup::Start HomingGroup::start(const machine::AxisInfo& axis, const std::vector<AxisLimits>& limits,
                                      const std::vector<double>& command, double speed) {
  HomingCycle::Settings settings;
  settings.direction = 0;
  const auto& master = limits[column_];
  settings.search = std::min(master.homing_search, master.velocity);
  settings.creep = std::min(master.homing_creep, master.velocity);
  settings.acceleration = master.acceleration;
  settings.travel = search_travel(axis, master);
  settings.reference = master.reference;
  bool contrary = false;
  for (const auto& member : members_) {
    const auto& l = limits[member.column];
    settings.search = std::min({settings.search, l.homing_search, l.velocity});
    settings.creep = std::min({settings.creep, l.homing_creep, l.velocity});
    settings.acceleration = std::min(settings.acceleration, l.acceleration);
    if (l.homing_direction == 0) continue;
    const double direction = l.homing_direction * member.sign;
    contrary = contrary || (settings.direction != 0 && settings.direction != direction);
    settings.direction = direction;
    settings.index = settings.index || l.homing_marks == 1;
  }
  if (settings.direction == 0) return Start::nothing;
  if (contrary) return Start::contrary;
  if (speed > 0) {
    settings.search = std::min(settings.search, speed);
    settings.creep = std::min(settings.creep, settings.search);
  }
  // Away from the switch and towards it at most.
  settings.seconds = 2 * settings.travel / settings.search + slow_share * settings.travel / settings.creep;
  homing_.start(settings, command[column_]);
  return Start::moves;
}

HomingCycle::Signals HomingGroup::signals(const std::vector<AxisLimits>& limits,
                                          const std::vector<AxisStatus>& status) {
  HomingCycle::Signals all{false, true, true};
  for (auto& member : members_) {
    const auto& l = limits[member.column];
    const auto& axis = status[member.column];
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

HomingCycle::State HomingGroup::step(const std::vector<AxisLimits>& limits,
                                     const std::vector<AxisStatus>& status, double period,
                                     std::vector<double>& command) {
  const double position = homing_.step_together(signals(limits, status), period);
  const double moved = position - members_.front().from;
  for (auto& member : members_) {
    command[member.column] = member.column == column_ ? position : member.from + member.sign * moved;
    if (!homing_.edges_found() || member.edge_taken) continue;
    member.edge_taken = true;
    member.latch = status[member.column].home_latch;
    member.marks = status[member.column].marks;
  }
  return homing_.state();
}

std::optional<double> HomingGroup::shift(const Member& member, const AxisLimits& limits,
                                         const AxisStatus& status, double command) {
  if (limits.homing_direction != 0)
    return limits.reference + (limits.homing_marks == 2 ? status.scale_shift : -member.latch);
  if (status.homed) return std::nullopt;
  // An absolute encoder whose position was lost gets its reference where it is.
  return limits.reference - command;
}

std::string HomingGroup::failure(const machine::AxisInfo& axis, const AxisLimits& limits) const {
  const auto& settings = homing_.settings();
  const char* const unit = axis.type == machine::axis_type_linear ? "mm" : "deg";
  std::string most;
  if (homing_.failure() == HomingCycle::Failure::travel) most = text::quantity(settings.travel, unit);
  if (homing_.failure() == HomingCycle::Failure::time) most = text::quantity(settings.seconds, "s");
  if (most.empty()) return {};
  const auto who = "Axis " + axis.name + (members_.size() > 1 ? " or its slave" : "");
  const auto direction = machine::number_text(parameter::homing_direction.number(axis.number));
  if (limits.homing_marks == 2)
    return who + " has not passed two marks of its scale within " + most +
           ": check the scale, its cable and parameter " + direction + ", then home again";
  return who + " has not found its " + (settings.index ? "home switch or index mark" : "home switch") +
         " within " + most + ": check the switch, its cable and parameter " + direction + ", then home again";
}

}  // namespace trunnion::drive
