// SPDX-License-Identifier: Apache-2.0
#include "drive_core.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/stream_settings.hpp"

namespace trunnion::drive {

using idl::stream::StreamRequestKind;

void DriveCore::configure(const machine::Parameters& p, bool virtual_time) {
  const bool first = axes_.empty();
  virtual_time_ = virtual_time;
  revision_ = p.revision;
  dt_ = p.get(parameter::interpolation_cycle) * 1e-6;
  const machine::StreamSettings stream(p, virtual_time);
  lead_ = stream.lead;
  // Three quarters of the lead, but no more than the channel's credit allows it to write: whole batches only.
  prefill_ = std::max<std::uint64_t>(1, std::min((lead_ * 3 - 1) / 4, lead_ - stream.feedback_batch + 1));
  if (first) {
    axes_ = machine::drive_axes(p);
    const std::size_t n = axes_.size();
    row_.axes.resize(n);
    for (auto* v : {&command_, &target_, &velocity_, &scratch_}) v->assign(n, 0.0);
    return_.configure(n);
    supervision_.configure(n);
    for (std::uint16_t c = 0; c < 10; ++c)
      if (!machine::channel_axes(p, c).number.empty()) streams_.add(c);
  }
  limits_.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) limits_[i] = axis_limits(p, axes_[i].number);
  slaves_.configure(p, axes_.size());
  spindles_.configure(p, dt_);
  for (std::size_t i = 0; i < spindles_.size(); ++i)
    spindles_.coupling(static_cast<int>(i))
        .configure(p.get(parameter::following_error_limit, spindles_.axes()[i].number));
  spindles_.report_parameters(events_);
  row_.spindles.resize(spindles_.size());
  hardware_->configure(p, axes_, spindles_.axes(), dt_);
  if (first)
    place_at_hardware();
  else
    hardware_->status(status_);
}

// The commands begin where the hardware finds the axes.
void DriveCore::place_at_hardware() {
  hardware_->status(status_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    command_[i] = target_[i] = status_.axes[i].hold_position;
    row_.axes[i] = {command_[i], 0, 0};
  }
}

void DriveCore::restore(const Memory& memory) {
  if (memory.magic != Memory::magic_value) return;
  next_ = memory.next;
  tick_ = memory.tick;
  streams_.restore(memory);
  std::vector<double> positions = command_;  // of axes that are not in the memory: where they are
  std::vector<std::uint8_t> homed(axes_.size(), 0);
  for (std::size_t i = 0; i < axes_.size(); ++i)
    for (std::size_t k = 0; k < std::min<std::size_t>(memory.axes, memory.position.size()); ++k)
      if (memory.number[k] == axes_[i].number) positions[i] = memory.position[k], homed[i] = memory.homed[k];
  hardware_->restore(positions, homed);
  place_at_hardware();
}

void DriveCore::restore_without_positions(Memory memory) {
  memory.magic = Memory::magic_value;
  memory.axes = 0;
  restore(memory);
}

std::vector<machine::AxisInfo> DriveCore::unreferenced() const {
  std::vector<machine::AxisInfo> axes;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (!status_.axes[i].homed) axes.push_back(axes_[i]);
  return axes;
}

Memory DriveCore::memory() const {
  Memory memory;
  memory.magic = Memory::magic_value;
  memory.axes = static_cast<std::uint32_t>(axes_.size());
  memory.next = next_;
  memory.tick = tick_;
  streams_.keep(memory);
  for (std::size_t i = 0; i < std::min(axes_.size(), memory.position.size()); ++i) {
    memory.position[i] = status_.axes[i].position;
    memory.homed[i] = status_.axes[i].homed ? 1 : 0;
    memory.number[i] = axes_[i].number;
  }
  return memory;
}

void DriveCore::leave(ChannelStream& channel) {
  channel.active = channel.ending = channel.resume = false;
  channel.release_spindle(spindles_);
  channel.thread.clear();
  // The others go on from between two cycles: its axes stay where they are.
  for (const int column : channel.columns)
    if (column >= 0) target_[static_cast<std::size_t>(column)] = command_[static_cast<std::size_t>(column)];
  if (any_active()) return;
  if (mode_ == Mode::HELD || mode_ == Mode::RETURNING) mode_ = Mode::FOLLOWING;
  target_ = command_;
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  rate_.run_whole();
  reserve_ = 0;
  off_path_ = false;
}

void DriveCore::request(const idl::stream::StreamRequest& request) {
  auto* const found = streams_.find(request.channel);
  if (found == nullptr) return;
  auto& channel = *found;
  if (request.request == channel.request && request.epoch == channel.epoch) return;
  // A process that continues from a snapshot hears the newest request of each channel again.
  if (request == channel.waiting) return;
  channel.refuse_waiting();
  // It is answered when it begins.
  if (request.kind == StreamRequestKind::HOME && mode_ == Mode::HOMING) {
    channel.waiting = request;
    return;
  }
  channel.request = request.request;
  switch (request.kind) {
    case StreamRequestKind::START:
    case StreamRequestKind::NEW_EPOCH:
      start(channel, request);
      break;
    case StreamRequestKind::RESUME:
      channel.resume = mode_ == Mode::HELD;
      break;
    case StreamRequestKind::LEAVE:
      leave(channel);
      if (mode_ == Mode::HOMING && request.channel == homing_.channel()) homing_.abort();
      break;
    case StreamRequestKind::HOME:
      home(channel, request);
      break;
  }
}

void DriveCore::start(ChannelStream& channel, const idl::stream::StreamRequest& request) {
  leave(channel);
  couple_slaves();
  if (!channel.expects(request)) return;
  channel.epoch = request.epoch;
  channel.begun = true;
  channel.active =
      mode_ != Mode::OFF && mode_ != Mode::BRAKING && mode_ != Mode::HOMING && all_homed() && all_aligned();
  channel.prefilled = false;
  channel.start = next_ + (streams_.active() > 1 ? lead_ : 0);
  channel.window.set_next(channel.epoch, channel.start);
}

void DriveCore::set_enables(const std::vector<std::uint8_t>& enable, bool emergency_stop) {
  bool all = !axes_.empty();
  for (const auto& axis : axes_) all = all && axis.number < enable.size() && (enable[axis.number] & 1) != 0;
  enable_.demand(all && !emergency_stop);
  spindles_.run_down(!enable_.granted());
  slaves_.demand_off(enable);
  couple_slaves();
  if (enable_.demanded()) {
    switch_on();
  } else if (mode_ == Mode::HELD || (mode_ == Mode::FOLLOWING && !any_active())) {
    mode_ = Mode::OFF;
  } else if (mode_ == Mode::HOMING) {
    homing_.abort();
  } else if (mode_ != Mode::OFF && mode_ != Mode::BRAKING) {
    begin_braking();
  }
}

// As soon as the drives are on: those of real hardware take their time.
void DriveCore::switch_on() {
  if (mode_ != Mode::OFF || enable_.lost() || !hardware_->enabled()) return;
  if (any_active()) {
    mode_ = Mode::HELD;
    rate_.hold();
  } else {
    mode_ = Mode::FOLLOWING;
    rate_.run();
  }
  align_slaves();
}

// The hardware ran out of rows and has stopped the axes at the newest one.
void DriveCore::stop_at_newest_row(std::uint64_t starved) {
  starved_ += starved;
  const bool homing = mode_ == Mode::HOMING;
  const bool moving = mode_ == Mode::BRAKING || mode_ == Mode::RETURNING || homing || reserve_ > 0;
  if (!moving) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "The hardware was without setpoints for %llu periods before cycle %llu and stopped the axes",
                static_cast<unsigned long long>(starved), static_cast<unsigned long long>(next_));
  raise(alarm::setpoint_missing, 0, text);
  if (mode_ == Mode::RETURNING) off_path_ = true;
  if (homing) {
    note_search(HomingCycle::State::failed);
    streams_.refuse_waiting();
    target_ = command_;
  }
  for (auto& axis : row_.axes) axis.velocity = 0;
  stopped();
}

void DriveCore::step() {
  ++tick_;
  if (const auto starved = hardware_->read(status_, rows_); starved > 0) stop_at_newest_row(starved);
  if (mode_ == Mode::OFF && enable_.demanded())
    switch_on();
  else if (mode_ != Mode::OFF && !hardware_->enabled())
    lose_control("The hardware has switched the drives off");
  await_drives();
  switch (mode_) {
    case Mode::OFF:
      break;
    case Mode::HELD:
      if (streams_.resume_demanded() && prefilled(supply())) resume();
      break;
    case Mode::RETURNING:
      step_return();
      break;
    case Mode::BRAKING:
      brake();
      break;
    case Mode::HOMING:
      step_homing();
      break;
    case Mode::FOLLOWING:
      if (any_active())
        follow_supply();
      else if (settle_ > 0)
        --settle_;
      break;
  }
  if (mode_ != Mode::HOMING) begin_waiting_search();
  exchange();
}

void DriveCore::follow_supply() {
  const auto s = supply();
  const bool begun = streams_.let_begin(next_, virtual_time_ || prefilled(s));
  if (!begun && reserve_ == 0) return;
  if (enough(s)) {
    follow();
    return;
  }
  ++starved_;
  if (reserve_ == 0) return;
  // Moving: stop within what is at hand.
  char text[160];
  std::snprintf(text, sizeof text,
                "No setpoint for cycle %llu in time; %llu cycles at hand, %llu needed to stop",
                static_cast<unsigned long long>(next_ + s.cycles), static_cast<unsigned long long>(s.cycles),
                static_cast<unsigned long long>(reserve_));
  raise(alarm::setpoint_missing, 0, text);
  begin_braking();
  brake();
}

// The setpoint of the next cycle is passed: it is executed, reported and forgotten. False when it is not
// here.
bool DriveCore::pass_cycle() {
  if (supply().cycles == 0) return false;
  const bool whole = mode_ == Mode::FOLLOWING && rate_.whole();
  streams_.follow_spindles({next_, lead_, dt_, static_cast<double>(rows_.pending() + 1), whole},
                           status_.spindles, spindles_, axes_, limits_);
  target_of(next_, scratch_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    velocity_[i] = scratch_[i] - target_[i];
    if (std::abs(velocity_[i]) > 1.5 * limits_[i].velocity * dt_ + on_path_distance) {
      char text[200];
      std::snprintf(text, sizeof text, "Axis %s would jump by %.6f in cycle %llu; its fastest is %.6f",
                    axes_[i].name.c_str(), velocity_[i], static_cast<unsigned long long>(next_),
                    limits_[i].velocity * dt_);
      raise(alarm::setpoint_jump, axes_[i].number, text);
      rate_.hold();
      mode_ = Mode::HELD;
      return false;
    }
  }
  target_ = scratch_;
  rows_.handed_over(next_, row_.number + 1, target_);
  streams_.couple_spindles(next_, status_.spindles, spindles_);
  streams_.pass(next_, spindles_);
  ++next_;
  return true;
}

void DriveCore::advance(double cycles) {
  rate_.pass(cycles);
  while (rate_.due()) {
    if (!pass_cycle()) {
      rate_.forget_phase();
      break;
    }
    rate_.take_cycle();
  }
  if (mode_ == Mode::HELD) return;
  const double phase = rate_.phase();
  if (phase > 0 && supply().cycles > 0) {
    target_of(next_, scratch_);
    for (std::size_t i = 0; i < axes_.size(); ++i)
      command_[i] = target_[i] + phase * (scratch_[i] - target_[i]);
    streams_.lead_spindles(next_, phase, spindles_);
  } else {
    command_ = target_;
    if (phase > 0 && mode_ == Mode::BRAKING) {  // the last setpoint at hand is passed while still moving
      for (std::size_t i = 0; i < axes_.size(); ++i) command_[i] += phase * velocity_[i];
      spindles_.lead_on(phase);
      off_path_ = true;
      rate_.forget_phase();
    }
  }
}

// The channel that starts alone may begin away from where its axes are: they are moved there first. When
// others move, its first setpoint is a setpoint like any other, and must not jump.
bool DriveCore::approach_needed() {
  if (!streams_.any_starts(next_) || streams_.active() != 1) return false;
  target_of(next_, scratch_);
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (std::abs(scratch_[i] - command_[i]) > on_path_distance) return true;
  return false;
}

void DriveCore::follow() {
  if (rate_.whole()) {
    slaves_.keep_distances(streams_, next_, command_);
    if (approach_needed()) {
      const auto start = scratch_;
      plan_return(start);
      return;
    }
    if (!pass_cycle()) return;
    command_ = target_;
  } else {
    advance(rate_.next(rate_.dips() ? 0 : rate_step()));
  }
  double moving = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    moving = std::max(moving, std::abs(velocity_[i]) / (limits_[i].acceleration * dt_ * dt_));
  // The stop leads through the next setpoints, where another axis may be the fastest.
  moving = std::max(moving, stop_periods(std::min(supply().cycles, lead_ / 2)));
  reserve_ = std::min<std::uint64_t>(static_cast<std::uint64_t>(std::ceil(moving / 2)),
                                     lead_ / 2 - streams_.ahead(lead_));
  if (!any_active()) {
    settle_ = virtual_time_ ? settling_periods : 0;
    reserve_ = 0;
    rate_.run_whole();
    std::fill(velocity_.begin(), velocity_.end(), 0.0);
  }
}

// Hands the setpoints of this period over and reads the machine.
void DriveCore::exchange() {
  ++row_.number;
  const bool controlled_before = row_.controls_spindles();
  row_.controlled = mode_ != Mode::OFF;
  row_.spindles_controlled = spindles_run_down();
  row_.moving = mode_ == Mode::FOLLOWING && any_active();
  row_.enable = row_.controls_spindles() || enable_.granted();
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    auto& axis = row_.axes[i];
    const double velocity = row_.controlled ? (command_[i] - axis.position) / dt_ : 0;
    const double acceleration = row_.controlled ? (velocity - axis.velocity) / dt_ : 0;
    axis = {command_[i], velocity, acceleration};
  }
  spindles_.run_down(!enable_.granted());
  if (!controlled_before && row_.controlled) spindles_.await_rest();
  spindles_.step(status_.spindles, row_.controlled, row_.spindles, row_.spindles_controlled);
  spindles_.report(status_.spindles, events_);
  if (testing() && (mode_ == Mode::OFF || mode_ == Mode::BRAKING || mode_ == Mode::HELD))
    hardware_->tester()->end(idl::servo::TestPhase::ENDED_BY_STOP);
  hardware_->exchange(row_, status_, rows_);
  watch_probe();
  if (row_.controls_spindles()) supervise();
  if (!row_.controlled && (!row_.enable || row_.spindles_controlled)) {
    for (std::size_t i = 0; i < axes_.size(); ++i)
      command_[i] = row_.axes[i].position = status_.axes[i].hold_position;
  }
  if (rows_.pending() == 0) streams_.executed();
}

void DriveCore::raise(const machine::AlarmDefinition& alarm, std::uint32_t part, std::string text) {
  events_.push_back({&alarm, part, std::move(text)});
}

std::vector<DriveEvent> DriveCore::take_events() { return std::exchange(events_, {}); }

}  // namespace trunnion::drive
