// SPDX-License-Identifier: Apache-2.0
// Slaves of gantries: aligned with their masters when the drives are switched on, taken off and coupled
// again. Source: HNC-8 10a062, 10a106, 10a107, 10a130, 10a131; the slave's release of its PLC.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {

// When the drives are switched on: a slave within its limit is moved to its master, others stay where they
// are.
void DriveCore::align_slaves() {
  double seconds = 0;
  for (auto& slave : slaves_.all()) {
    slave.refused = false;
    const auto m = slave.master_column(), s = slave.column();
    if (slave.off) continue;
    if (!slave.pair.aligns || !status_.axes[m].homed || !status_.axes[s].homed) {
      slave.offset_known = slave.offset_known && any_active();
      continue;
    }
    const double error = GantrySlaves::misalignment(slave, streams_, command_);
    if (std::abs(error) > slave.pair.alignment_limit) {
      slave.refused = true;
      report_misalignment(slave, error);
      continue;
    }
    target_[s] -= slave.offset;
    slave.offset = 0, slave.offset_known = true;
    const double d = std::abs(error);
    if (d <= on_path_distance) continue;
    if (seconds == 0) scratch_ = command_;
    scratch_[s] = command_[s] - error;
    const double velocity = std::min(limits_[s].velocity, slave.pair.alignment_rate / dt_);
    seconds = std::max({seconds, dt_, quintic_seconds(d, velocity, limits_[s].acceleration)});
  }
  if (seconds == 0) return;
  return_.start(command_, scratch_, seconds, dt_);
  after_alignment_ = mode_;
  mode_ = Mode::RETURNING;
}

// The slaves are where their masters are; a channel that was stopped continues from where it was held.
void DriveCore::end_alignment() {
  mode_ = after_alignment_;
  after_alignment_ = Mode::OFF;
  if (mode_ == Mode::FOLLOWING) {
    target_ = command_;
    settle_ = virtual_time_ ? settling_periods : 0;
  }
}

void DriveCore::report_misalignment(const GantrySlave& slave, double error) {
  char text[300];
  std::snprintf(
      text, sizeof text,
      "Slave axis %s is %.4f mm off its master %s, more than the %.4f mm that are aligned (parameters "
      "%s, %s, %s): it was not moved. Take it off, jog the master to it, couple it",
      axes_[slave.column()].name.c_str(), error, axes_[slave.master_column()].name.c_str(),
      slave.pair.alignment_limit,
      machine::number_text(parameter::synchronization_error_limit.number(slave.pair.slave)).c_str(),
      machine::number_text(parameter::alignment_limit.number(slave.pair.slave)).c_str(),
      machine::number_text(parameter::alignment_maximum.number(slave.pair.slave)).c_str());
  raise(alarm::synchronization_error, slave.pair.slave, text);
}

// False, with the alarm of each, when slaves are out of tolerance since the drives were switched on.
bool DriveCore::all_aligned() {
  bool aligned = true;
  for (auto& slave : slaves_.all()) {
    if (!slave.refused || slave.off) continue;
    const double error = GantrySlaves::misalignment(slave, streams_, command_);
    slave.refused = std::abs(error) > slave.pair.alignment_limit;
    if (!slave.refused) continue;
    report_misalignment(slave, error);
    aligned = false;
  }
  return aligned;
}

// At rest only: a slave in motion stays with its master.
void DriveCore::couple_slaves() {
  if (any_active() || (mode_ != Mode::FOLLOWING && mode_ != Mode::OFF)) return;
  slaves_.couple(command_);
}

}  // namespace trunnion::drive
