// SPDX-License-Identifier: Apache-2.0
#include "simulated_hardware.hpp"

#include <cstring>

#include "machine/parameter_constants.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::drive {

void SimulatedHardware::configure(const machine::Parameters& p, const std::vector<machine::AxisInfo>& axes,
                                  const std::vector<machine::AxisInfo>& spindles, double period) {
  period_ = period;
  const bool first = servos_.size() != axes.size();
  servos_.resize(axes.size());
  home_switches_.resize(axes.size());
  homed_.resize(axes.size(), 1);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto number = axes[i].number;
    const auto truth = truth_.find(axes[i].name);
    servos_[i].configure(ServoParameters::from(p, number), truth == truth_.end() ? nullptr : &truth->second);
    servos_[i].keep_position_error(false);
    if (first) servos_[i].place(p.get(parameter::reference_coordinate, number));
    home_switches_[i].position = p.get(parameter::reference_coordinate, number);
    home_switches_[i].direction = p.integer(parameter::homing_direction, number);
  }
  std::vector<const truth::DriveTruth*> truths(axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (const auto truth = truth_.find(axes[i].name); truth != truth_.end()) truths[i] = &truth->second;
  faults_.configure(p, axes, truths);
  links_ = GantryLink::of(p, beam_);
  linked_.assign(axes.size(), 0);
  for (const auto& link : links_)
    for (std::size_t i = 0; i < axes.size(); ++i)
      if (link.active() && link.has(i)) linked_[i] = 1;
  for (const auto& link : links_)
    for (const auto& slave : link.slaves())
      servos_[static_cast<std::size_t>(slave.pair.slave_column)].keep_position_error(slave.compensation > 0);
  test_.configure(p, axes, period);
  spindles_.resize(spindles.size());
  for (std::size_t i = 0; i < spindles.size(); ++i) {
    const auto truth = spindle_truth_.find(spindles[i].name);
    const auto number = spindles[i].number;
    spindles_[i].configure(
        {p.get(parameter::maximum_acceleration, number), p.get(parameter::spindle_lag, number) / 1000},
        period, truth == spindle_truth_.end() ? nullptr : &truth->second);
  }
  skip_inputs_.configure(p, axes);
  if (probe_) probe_->configure(p, axes);
  encoder_.resize(axes.size());
  angle_.resize(spindles.size());
}

void SimulatedHardware::restore(std::span<const double> positions, std::span<const std::uint8_t> homed) {
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    servos_[i].place(positions[i]);
    homed_[i] = homed[i];
  }
}

bus::Json SimulatedHardware::explicit_state() const { return snapshot::written(*this); }

void SimulatedHardware::continue_from(const bus::Json& state) {
  snapshot::read(state, *this);
  test_.continue_test();
}

std::span<const std::uint8_t> SimulatedHardware::kept() {
  if (!probe_) return {};
  kept_ = probe_->memory();
  return {reinterpret_cast<const std::uint8_t*>(&kept_), sizeof kept_};
}

void SimulatedHardware::restore_kept(std::span<const std::uint8_t> kept) {
  if (!probe_ || kept.size() != sizeof kept_) return;
  std::memcpy(&kept_, kept.data(), sizeof kept_);
  probe_->restore(kept_);
}

void SimulatedHardware::status(DriveStatus& out) const {
  out.axes.resize(servos_.size());
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    const auto& servo = servos_[i];
    auto& axis = out.axes[i];
    axis.position = servo.encoder();
    axis.following_error = servo.command() - servo.encoder();
    axis.hold_position = servo.command();
    axis.velocity = servo.velocity();
    axis.torque = servo.torque();
    axis.homed = homed_[i] != 0 && servo.homed();
    axis.encoder_difference = servo.encoder_difference();
    axis.home_switch = home_switches_[i].on;
    axis.home_latch = home_switches_[i].latch;
    axis.marks = servo.marks(), axis.mark_latch = servo.mark_latch();
    const auto shift = servo.scale_shift();
    axis.scale_known = shift.has_value(), axis.scale_shift = shift.value_or(0);
  }
  faults_.status(out.axes);
  out.spindles.resize(spindles_.size());
  for (std::size_t i = 0; i < spindles_.size(); ++i) out.spindles[i] = spindles_[i].status();
  out.skip_inputs = skip_inputs_.on();
  if (probe_ && probe_->on()) out.skip_inputs |= 1;
}

void SimulatedHardware::set_reference(std::size_t i, double shift) {
  servos_[i].set_reference(shift);
  homed_[i] = 1;
}

void SimulatedHardware::step_axes(const SetpointRow& row) {
  if (row.controlled && !faults_.any()) {
    faults_.before(servos_);
    for (std::size_t i = 0; i < servos_.size(); ++i)
      if (linked_[i] == 0) servos_[i].step(row.axes[i], period_, test_.of(i));
    for (auto& link : links_)
      if (link.active()) link.step(servos_, row.axes, period_, test_);
    faults_.after(servos_, links_);
    return;
  }
  if (faults_.running()) {
    const double h = period_ / servo_substeps;
    for (std::size_t i = 0; i < servos_.size(); ++i) {
      if (linked_[i] != 0) continue;
      for (int k = 0; k < servo_substeps && faults_.ways()[i] != RunOut::none; ++k)
        servos_[i].run_out(faults_.ways()[i], h, 0);
      if (faults_.ways()[i] == RunOut::none) servos_[i].hold();
    }
    for (auto& link : links_)
      if (link.active()) link.run_out(servos_, faults_.ways(), period_);
    faults_.settle(servos_);
    return;
  }
  for (auto& servo : servos_) servo.hold();
  for (const auto& link : links_)
    if (link.active()) link.hold(servos_);
}

void SimulatedHardware::exchange(const SetpointRow& row, DriveStatus& out, EncoderRowSink& rows) {
  test_.begin_period(row.moving);
  step_axes(row);
  test_.end_period();
  for (std::size_t i = 0; i < servos_.size(); ++i) {
    auto& home = home_switches_[i];
    const bool on = (servos_[i].load() - home.position) * home.direction > 0;
    if (on && !home.on) home.latch = servos_[i].encoder();
    home.on = on;
  }
  for (std::size_t i = 0; i < spindles_.size(); ++i)
    spindles_[i].step(row.spindles[i], row.controls_spindles());
  for (std::size_t i = 0; i < servos_.size(); ++i) encoder_[i] = servos_[i].encoder();
  for (std::size_t i = 0; i < spindles_.size(); ++i) angle_[i] = spindles_[i].angle();
  rows.encoder_row({row.number, encoder_, angle_});
  if (row.controlled) skip_inputs_.step(servos_, row.number, rows);
  if (probe_) probe_->step(row, period_, servos_, spindles_, rows);
  status(out);
}

}  // namespace trunnion::drive
