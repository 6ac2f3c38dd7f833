// SPDX-License-Identifier: Apache-2.0
// Slaves of gantries: aligned with their masters when the drives are switched on, taken off and coupled
// again. Source: HNC-8 10a062, 10a106, 10a107, 10a130, 10a131; the slave's release of its PLC.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "drive_core.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "stream/gantry_synchronization.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::drive {
namespace {
constexpr std::uint8_t off_bit = 2;  // of Outputs::axis_enable
}  // namespace

// mm: how far compensation puts the slave from where its master's setpoint says. It is known once the channel
// has moved.
double DriveCore::compensated_offset(const GantrySlave& slave) const {
  const auto* channel = streams_.find(slave.channel);
  if (channel == nullptr) return 0;
  const auto* state = stream::find_state(channel->states, idl::stream::Stage::GANTRY);
  return state != nullptr ? stream::compensated_offsets(slave.places, state->values)[slave.place] : 0;
}

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
    const double error = slave.pair.error(command_[m], command_[s]) - compensated_offset(slave);
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
    const double error = slave.pair.error(command_[slave.master_column()], command_[slave.column()]) -
                         compensated_offset(slave);
    slave.refused = std::abs(error) > slave.pair.alignment_limit;
    if (!slave.refused) continue;
    report_misalignment(slave, error);
    aligned = false;
  }
  return aligned;
}

void DriveCore::demand_slaves_off(const std::vector<std::uint8_t>& enable) {
  for (auto& slave : slaves_.all())
    slave.off_demanded = slave.pair.slave < enable.size() && (enable[slave.pair.slave] & off_bit) != 0;
  couple_slaves();
}

// At rest only: a slave in motion stays with its master.
void DriveCore::couple_slaves() {
  if (any_active() || (mode_ != Mode::FOLLOWING && mode_ != Mode::OFF)) return;
  for (auto& slave : slaves_.all()) {
    if (slave.off == slave.off_demanded) continue;
    slave.off = slave.off_demanded;
    slave.held = command_[slave.column()];
    slave.offset_known = slave.refused = false;
  }
}

// The first setpoint of a channel since the drives were switched on or a slave was coupled: what is between
// the slave and its place stays. `error` of the setpoints is what compensation wants.
void DriveCore::keep_distances() {
  for (auto& slave : slaves_.all()) {
    if (slave.offset_known || slave.off) continue;
    const auto* channel = streams_.find(slave.channel);
    if (channel == nullptr || !channel->active || channel->start != next_) continue;
    const double* values = channel->row(next_);
    const auto* frame = channel->window.peek();
    if (values == nullptr || frame == nullptr) continue;
    const auto value = [&](std::uint16_t axis) {
      const auto found = std::find(frame->axes.begin(), frame->axes.end(), axis);
      return found == frame->axes.end() ? nullptr : values + (found - frame->axes.begin());
    };
    const double *master = value(slave.pair.master), *own = value(slave.pair.slave);
    if (master == nullptr || own == nullptr) continue;
    const double distance = slave.pair.error(command_[slave.master_column()], command_[slave.column()]) -
                            slave.pair.error(*master, *own);
    slave.offset = std::abs(distance) > on_path_distance ? distance : 0;
    slave.offset_known = true;
  }
}

}  // namespace trunnion::drive
