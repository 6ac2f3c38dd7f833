// SPDX-License-Identifier: Apache-2.0
#include "spindles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

using idl::stream::SpindleCondition;
using idl::stream::SpindleState;

void Spindles::configure(const machine::Parameters& parameters, double period) {
  axes_ = machine::spindles(parameters);
  period_ = period;
  couplings_.resize(axes_.size());
  orientations_.resize(axes_.size());
  ramps_.resize(axes_.size());
  gears_.resize(axes_.size());
  windows_.resize(axes_.size());
  highest_.resize(axes_.size());
  permitted_.resize(axes_.size());
  surface_.configure(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto number = axes_[i].number;
    orientations_[i].configure(orientation_settings(parameters, number), period);
    ramps_[i].configure(ramp_settings(parameters, number), period);
    gears_[i].configure(gear_speeds(parameters, number));
    windows_[i] = parameters.get(parameter::speed_window, number) / 100;
    const double highest = parameters.get(parameter::maximum_speed, number);
    highest_[i] = highest > 0 ? highest : std::numeric_limits<double>::infinity();
  }
  synchronized_.configure(parameters, axes_, period);
}

void Spindles::demand_speeds(const std::vector<double>& speed) {
  for (std::size_t i = 0; i < couplings_.size(); ++i)
    couplings_[i].demand_speed(i < speed.size() ? speed[i] : 0);
}

void Spindles::demand_orientations(const std::vector<std::uint8_t>& orient,
                                   const std::vector<double>& angle) {
  for (std::size_t i = 0; i < orientations_.size(); ++i)
    orientations_[i].demand(i < orient.size() && orient[i] != 0, i < angle.size() ? angle[i] : -1);
}

void Spindles::engage_gears(const std::vector<std::uint8_t>& gear) {
  for (std::size_t i = 0; i < gears_.size(); ++i)
    gears_[i].engage(i < gear.size() ? gear[i] : std::uint8_t{0});
}

void Spindles::couple(const std::vector<idl::plc::SpindleCoupling>& couplings) {
  const bool before = synchronized_.any();
  synchronized_.couple(couplings);
  if (before || synchronized_.any()) limit_orientations();
}

// A master turns to its angle as the slowest spindle that follows it can.
void Spindles::limit_orientations() {
  for (std::size_t i = 0; i < orientations_.size(); ++i)
    orientations_[i].limit_acceleration(
        synchronized_.lowest_acceleration(i, orientations_[i].approach_speed()));
}

void Spindles::lead_on(double cycles) {
  for (auto& coupling : couplings_) coupling.lead_on(cycles);
}

double Spindles::highest_speed(std::size_t i) const { return std::min(highest_[i], gears_[i].highest()); }

double Spindles::commanded_speed(std::size_t i) const {
  double highest = highest_speed(i);
  for (std::size_t k = 0; k < size(); ++k)
    if (synchronized_.follows(k) && synchronized_.master_of(k) == i)
      highest = std::min(highest, highest_speed(k));
  return std::clamp(surface_.follows(i) ? surface_.speed(i) : couplings_[i].setpoint().speed, -highest,
                    highest);
}

void Spindles::step(const std::vector<SpindleStatus>& status, bool controlled,
                    std::vector<SpindleSetpoint>& out, bool running_down) {
  synchronized_.judge(couplings_, status, controlled, running_down);
  if (synchronized_.any()) limit_orientations();
  for (std::size_t i = 0; i < couplings_.size(); ++i) {
    auto setpoint = couplings_[i].setpoint();
    setpoint.speed = commanded_speed(i);
    const bool follows = synchronized_.follows(i), leads = synchronized_.leads(i);
    const bool waits = synchronized_.waits(i);
    if (waits) setpoint.speed = 0;
    setpoint = orientations_[i].step(setpoint, status[i], controlled && !follows && !waits);
    const bool ramps = controlled && !setpoint.coupled && !follows && !leads;
    const double reference = ramps_[i].step(ramps ? setpoint.speed : status[i].speed, ramps);
    if (ramps) setpoint.speed = reference;
    if (running_down && !follows && !leads) setpoint.speed = 0, setpoint.coupled = false;
    setpoint.gear = gears_[i].in_force();
    permitted_[i] = highest_speed(i);
    out[i] = setpoint;
  }
  synchronized_.step(status, permitted_, out);
}

void Spindles::fill(const std::vector<SpindleStatus>& status, const std::vector<SpindleSetpoint>& row,
                    bool controlled, idl::stream::Feedback& out, bool running_down) const {
  out.spindle_speed.resize(size());
  out.spindle_oriented.resize(size());
  out.spindles.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    out.spindle_speed[i] = status[i].speed;
    out.spindle_oriented[i] = orientations_[i].oriented(status[i]) ? 1 : 0;
    out.spindles[i] = state(i, status[i], row[i], controlled, running_down);
  }
}

// A speed within the window, and that of the PLC's signal of it.
SpindleState Spindles::state(std::size_t i, const SpindleStatus& status, const SpindleSetpoint& row,
                             bool controlled, bool running_down) const {
  constexpr double least_window = 5;  // 1/min
  constexpr double seconds_of_minute = 60;
  SpindleState state;
  const auto& coupling = couplings_[i];
  const auto& orientation = orientations_[i];
  if (controlled && coupling.setpoint().coupled) {
    state.condition = SpindleCondition::SPINDLE_FOLLOWS_PATH;
    state.reference = coupling.change() / period_ * seconds_of_minute;
  } else if (controlled && orientation.demanded()) {
    state.condition = orientation.oriented(status) ? SpindleCondition::SPINDLE_ORIENTED
                                                   : SpindleCondition::SPINDLE_POSITIONING;
    state.reference = row.coupled ? orientation.speed() : row.speed;
  } else {
    const double commanded = controlled ? commanded_speed(i) : 0;
    const bool at_speed =
        std::abs(status.speed - commanded) <= std::max(windows_[i] * std::abs(commanded), least_window);
    state.condition = !at_speed        ? SpindleCondition::SPINDLE_ACCELERATING
                      : commanded == 0 ? SpindleCondition::SPINDLE_STOPPED
                                       : SpindleCondition::SPINDLE_AT_SPEED;
    state.reference = (controlled || running_down) && !row.coupled ? row.speed : 0;
  }
  state.homed = status.homed;
  state.gear = gears_[i].in_force();
  state.torque = status.torque;
  state.angle = status.angle;
  synchronized_.fill(state, i);
  return state;
}

void Spindles::report_parameters(std::vector<DriveEvent>& events) const {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto& settings = ramps_[i].settings();
    if (settings.usable()) continue;
    const auto number = axes_[i].number;
    char text[240];
    std::snprintf(text, sizeof text,
                  "Spindle %s does not turn: its base speed %g 1/min (parameter %s) must be above 0 and at "
                  "most its power speed %g 1/min (parameter %s)",
                  axes_[i].name.c_str(), settings.base_speed,
                  machine::number_text(parameter::base_speed.number(number)).c_str(), settings.power_speed,
                  machine::number_text(parameter::power_speed.number(number)).c_str());
    events.push_back({&alarm::spindle_parameters, number, text});
  }
}

void Spindles::report(const std::vector<SpindleStatus>& status, std::vector<DriveEvent>& events) const {
  constexpr double degrees = 360;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto& orientation = orientations_[i];
    if (!orientation.lost() && !orientation.late()) continue;
    const auto number = axes_[i].number;
    const char* name = axes_[i].name.c_str();
    const double angle = orientation.angle();
    const double beside = degrees * std::remainder(status[i].angle - angle / degrees, 1.0);
    char text[240];
    if (orientation.lost())
      std::snprintf(text, sizeof text,
                    "Spindle %s is %.3f deg from its orientation angle %.3f deg, the window is that of "
                    "parameter %s: see what turns it, then reset",
                    name, beside, angle,
                    machine::number_text(parameter::orientation_window.number(number)).c_str());
    else if (status[i].homed)
      std::snprintf(text, sizeof text,
                    "Spindle %s turns at %.0f 1/min and is %.3f deg from its orientation angle %.3f deg %g s "
                    "after the order: see what blocks or drives it, then reset",
                    name, status[i].speed, beside, angle, orientation.time_limit());
    else
      std::snprintf(text, sizeof text,
                    "Spindle %s turns at %.0f 1/min and has not passed its index mark %g s after the order "
                    "of its orientation: see what blocks it, and its encoder, then reset",
                    name, status[i].speed, orientation.time_limit());
    events.push_back({&alarm::orientation_lost, number, text});
  }
  for (const auto& finding : synchronized_.findings()) events.push_back(event_of(finding, axes_));
}

void Spindles::acknowledge() {
  for (auto& orientation : orientations_) orientation.acknowledge();
}

}  // namespace trunnion::drive
