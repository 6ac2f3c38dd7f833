#include "drive_core.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {
namespace {

using idl::stream::StreamRequestKind;
constexpr std::uint32_t settling = 250;  // periods after motion in virtual time, until the servos stand still
constexpr std::uint64_t forever = std::numeric_limits<std::uint64_t>::max();
}  // namespace

void DriveCore::configure(const machine::Parameters& p, bool virtual_time) {
  const bool first = axes_.empty();
  virtual_time_ = virtual_time;
  revision_ = p.revision;
  dt_ = p.get(parameter::interpolation_cycle) * 1e-6;
  lead_ = static_cast<std::uint64_t>(p.integer(parameter::stream_lead));
  // Three quarters of the lead, but no more than the channel's credit allows it to write: whole frames only.
  const auto frame = static_cast<std::uint64_t>(
      p.integer(virtual_time ? parameter::frame_cycles_virtual_time : parameter::frame_cycles_real_time));
  prefill_ = std::max<std::uint64_t>(1, std::min((lead_ * 3 - 1) / 4, lead_ > frame ? lead_ - frame + 1 : 1));
  if (first) {
    axes_ = machine::drive_axes(p);
    const std::size_t n = axes_.size();
    servos_.resize(n);
    for (auto* v : {&command_, &target_, &velocity_, &scratch_, &return_from_, &return_to_})
      v->assign(n, 0.0);
    reported_.assign(n, false);
    for (std::size_t i = 0; i < n; ++i) {
      command_[i] = target_[i] = p.get(parameter::reference_coordinate, axes_[i].number);
      servos_[i].place(command_[i]);
    }
    for (std::uint16_t c = 0; c < 10; ++c)
      if (!machine::channel_axes(p, c).number.empty()) channels_[c];
  }
  limits_.resize(axes_.size());
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    const auto a = axes_[i].number;
    limits_[i] = {std::max(p.get(parameter::rapid_feed, a), p.get(parameter::maximum_feed, a)) / 60,
                  p.get(parameter::maximum_acceleration, a), p.get(parameter::positive_limit, a),
                  p.get(parameter::negative_limit, a), p.get(parameter::following_error_limit, a)};
    servos_[i].configure(ServoParameters::from(p, a));
  }
  spindle_axes_ = machine::spindles(p);
  spindles_.resize(spindle_axes_.size());
  for (std::size_t i = 0; i < spindles_.size(); ++i)
    spindles_[i].configure(p.get(parameter::maximum_acceleration, spindle_axes_[i].number), dt_);
  skip_inputs_.configure(p, axes_);
}

void DriveCore::restore(const Memory& memory) {
  if (memory.magic != Memory::magic_value || memory.axes != axes_.size()) return;
  next_ = memory.next;
  tick_ = memory.tick;
  for (auto& [number, channel] : channels_) {
    const auto& kept = memory.channels[number % memory.channels.size()];
    channel.begun = kept.begun != 0;
    channel.epoch = channel.begun ? kept.epoch : memory.epoch;
    channel.request = kept.request;
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    command_[i] = target_[i] = memory.position[i];
    servos_[i].place(memory.position[i]);
  }
}

Memory DriveCore::memory() const {
  Memory memory;
  memory.magic = Memory::magic_value;
  memory.axes = static_cast<std::uint32_t>(axes_.size());
  memory.next = next_;
  memory.tick = tick_;
  for (const auto& [number, channel] : channels_) {
    memory.epoch = std::max(memory.epoch, channel.epoch);
    memory.channels[number % memory.channels.size()] = {channel.epoch, channel.request, channel.begun};
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) memory.position[i] = servos_[i].encoder();
  return memory;
}

bool DriveCore::put(idl::stream::AxisFrame& frame) {
  return channels_[frame.channel].window.put(frame) != stream::Arrival::differs;
}

bool DriveCore::any_active() const {
  return std::any_of(channels_.begin(), channels_.end(), [](const auto& c) { return c.second.active; });
}

void DriveCore::leave(Channel& channel) {
  channel.active = false;
  release_spindle(channel);
  if (any_active()) return;
  if (mode_ == Mode::HELD || mode_ == Mode::RETURNING) mode_ = Mode::FOLLOWING;
  target_ = command_;
  std::fill(velocity_.begin(), velocity_.end(), 0.0);
  rate_ = 1, phase_ = 0, reserve_ = 0;
  off_path_ = resume_ = false;
}

void DriveCore::request(const idl::stream::StreamRequest& request) {
  auto& channel = channels_[request.channel];
  if (request.request == channel.request && request.epoch == channel.epoch) return;
  channel.request = request.request;
  switch (request.kind) {
    case StreamRequestKind::START:
    case StreamRequestKind::NEW_EPOCH: {
      leave(channel);
      // A start within an epoch this process did not see begin is a message from before it was restarted.
      const bool known = request.kind == StreamRequestKind::NEW_EPOCH
                             ? request.epoch > channel.epoch
                             : channel.begun && request.epoch == channel.epoch;
      if (!known) break;
      channel.epoch = request.epoch;
      channel.begun = true;
      channel.active = mode_ != Mode::OFF && mode_ != Mode::BRAKING;
      channel.prefilled = false;
      channel.start = next_ + (std::count_if(channels_.begin(), channels_.end(),
                                             [](const auto& c) { return c.second.active; }) > 1
                                   ? lead_
                                   : 0);
      channel.window.set_next(channel.epoch, channel.start);
      break;
    }
    case StreamRequestKind::RESUME:
      resume_ = mode_ == Mode::HELD;
      break;
    case StreamRequestKind::LEAVE:
      leave(channel);
      break;
  }
}

void DriveCore::set_enables(const std::vector<std::uint8_t>& enable, bool emergency_stop) {
  bool all = !axes_.empty();
  for (const auto& axis : axes_) all = all && axis.number < enable.size() && enable[axis.number] != 0;
  const bool on = all && !emergency_stop;
  emergency_stop_ = emergency_stop;
  enabled_ = on;
  if (on && mode_ == Mode::OFF) {
    mode_ = any_active() ? Mode::HELD : Mode::FOLLOWING;
    rate_ = any_active() ? 0 : 1;
  } else if (!on && mode_ != Mode::OFF) {
    if (mode_ == Mode::HELD || (mode_ == Mode::FOLLOWING && !any_active()))
      mode_ = Mode::OFF;
    else if (mode_ != Mode::BRAKING)
      begin_braking();
  }
}

const double* DriveCore::row(const Channel& channel, std::uint64_t cycle) const {
  for (const auto* frame = channel.window.peek(); frame != nullptr;
       frame = channel.window.find(frame->first + frame->count))
    if (cycle >= frame->first && cycle < frame->first + frame->count)
      return &frame->setpoints[(cycle - frame->first) * frame->axes.size()];
  return nullptr;
}

DriveCore::Supply DriveCore::supply() const {
  std::uint64_t until = forever, last = next_;
  bool ends = true;
  for (const auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    std::uint64_t end = std::max(channel.window.next(), next_);
    bool ended = false;
    for (const auto* frame = channel.window.peek(); frame != nullptr && !ended && end < next_ + 4 * lead_;
         frame = channel.window.find(frame->first + frame->count)) {
      end = frame->first + frame->count;
      ended = frame->ends;
    }
    last = std::max(last, end);
    if (!ended) {
      ends = false;
      until = std::min(until, end);
    }
  }
  return {(ends ? last : until) - next_, ends};
}

// Setpoints of every axis at `cycle`; axes no channel moves then keep the point of the path they are at.
void DriveCore::target_of(std::uint64_t cycle, std::vector<double>& out) {
  out = target_;
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const double* values = row(channel, cycle);
    if (values == nullptr) continue;
    const auto* frame = channel.window.peek();
    if (channel.axes != frame->axes) {
      channel.axes = frame->axes;
      channel.columns.clear();
      for (const auto axis : channel.axes) channel.columns.push_back(machine::column_of(axes_, axis));
    }
    for (std::size_t i = 0; i < channel.columns.size(); ++i)
      if (channel.columns[i] >= 0) out[static_cast<std::size_t>(channel.columns[i])] = values[i];
  }
}

// Periods it takes to stop from the fastest speed of the next `cycles` cycles with every axis within its
// acceleration.
double DriveCore::stop_periods(std::uint64_t cycles) {
  double periods = 0;
  before_ = target_;
  for (std::uint64_t c = next_; c < next_ + cycles; ++c) {
    target_of(c, scratch_);
    for (std::size_t i = 0; i < axes_.size(); ++i)
      periods = std::max(periods, std::abs(scratch_[i] - before_[i]) / (limits_[i].acceleration * dt_ * dt_));
    std::swap(before_, scratch_);
  }
  return periods;
}

bool DriveCore::enough(const Supply& s) const { return s.cycles > 0 && (s.ends || s.cycles > reserve_); }

bool DriveCore::prefilled(const Supply& s) const { return s.ends || s.cycles >= prefill_; }

bool DriveCore::waiting() const { return mode_ == Mode::FOLLOWING && any_active() && !enough(supply()); }

bool DriveCore::can_step(bool give_up) const {
  switch (mode_) {
    case Mode::BRAKING:
    case Mode::RETURNING:
      return true;
    case Mode::HELD:
      return resume_ && prefilled(supply());
    case Mode::OFF:
      return false;
    case Mode::FOLLOWING:
      break;
  }
  if (!any_active()) return settle_ > 0;
  const auto s = supply();
  return enough(s) || (give_up && reserve_ > 0);
}

void DriveCore::step() {
  ++tick_;
  switch (mode_) {
    case Mode::OFF:
      for (auto& servo : servos_) servo.hold();
      for (std::size_t i = 0; i < axes_.size(); ++i) command_[i] = servos_[i].command();
      move_spindles(false);
      return;
    case Mode::HELD:
      if (resume_ && prefilled(supply())) resume();
      break;
    case Mode::RETURNING:
      step_return();
      break;
    case Mode::BRAKING:
      brake();
      break;
    case Mode::FOLLOWING: {
      if (!any_active()) {
        if (settle_ > 0) --settle_;
        break;
      }
      const auto s = supply();
      bool begun = reserve_ > 0;
      for (auto& [number, channel] : channels_) {
        if (channel.active && !channel.prefilled && channel.start <= next_)
          channel.prefilled = virtual_time_ || prefilled(s);
        begun = begun || (channel.active && channel.prefilled);
      }
      if (!begun) break;
      if (enough(s)) {
        follow();
      } else if (reserve_ > 0) {  // moving: stop within what is at hand
        ++starved_;
        char text[160];
        std::snprintf(text, sizeof text,
                      "No setpoint for cycle %llu in time; %llu cycles at hand, %llu needed to stop",
                      static_cast<unsigned long long>(next_ + s.cycles),
                      static_cast<unsigned long long>(s.cycles), static_cast<unsigned long long>(reserve_));
        raise(alarm::setpoint_missing, 0, text);
        begin_braking();
        brake();
      } else {
        ++starved_;
      }
      break;
    }
  }
  move_axes();
}

// The setpoint of the next cycle is passed: it is executed, reported and forgotten. False when it is not
// here.
bool DriveCore::pass_cycle() {
  if (supply().cycles == 0) return false;
  target_of(next_, scratch_);
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    velocity_[i] = scratch_[i] - target_[i];
    if (std::abs(velocity_[i]) > 1.5 * limits_[i].velocity * dt_ + on_path_distance) {
      char text[200];
      std::snprintf(text, sizeof text, "Axis %s would jump by %.6f in cycle %llu; its fastest is %.6f",
                    axes_[i].name.c_str(), velocity_[i], static_cast<unsigned long long>(next_),
                    limits_[i].velocity * dt_);
      raise(alarm::setpoint_jump, axes_[i].number, text);
      rate_ = 0;
      mode_ = Mode::HELD;
      return false;
    }
  }
  target_ = scratch_;
  if (rows_ == 0) first_row_ = next_;
  ++rows_;
  commanded_rows_.insert(commanded_rows_.end(), target_.begin(), target_.end());
  for (const auto& servo : servos_) actual_rows_.push_back(servo.encoder());
  for (const auto& spindle : spindles_) spindle_rows_.push_back(spindle.angle());
  skip_inputs_.report(next_, skips_);
  couple_spindles();
  for (auto& [number, channel] : channels_) {
    if (!channel.active) continue;
    const auto* frame = channel.window.peek();
    if (frame == nullptr || next_ + 1 != frame->first + frame->count) continue;
    channel.snapshot = frame->snapshot;
    channel.states = frame->states;
    const bool ends = frame->ends;
    channel.window.advance();
    if (!ends) continue;
    channel.active = false;
    release_spindle(channel);
  }
  ++next_;
  return true;
}

void DriveCore::advance(double cycles) {
  phase_ += cycles;
  while (phase_ >= 1) {
    if (!pass_cycle()) {
      phase_ = 0;
      break;
    }
    phase_ -= 1;
  }
  if (mode_ == Mode::HELD) return;
  if (phase_ > 0 && supply().cycles > 0) {
    target_of(next_, scratch_);
    for (std::size_t i = 0; i < axes_.size(); ++i)
      command_[i] = target_[i] + phase_ * (scratch_[i] - target_[i]);
    lead_spindles(phase_);
  } else {
    command_ = target_;
    if (phase_ > 0 && mode_ == Mode::BRAKING) {  // the last setpoint at hand is passed while still moving
      for (std::size_t i = 0; i < axes_.size(); ++i) command_[i] += phase_ * velocity_[i];
      for (auto& spindle : spindles_) spindle.lead_on(phase_);
      off_path_ = true;
      phase_ = 0;
    }
  }
}

// The channel that starts alone may begin away from where its axes are: they are moved there first. When
// others move, its first setpoint is a setpoint like any other, and must not jump.
bool DriveCore::approach_needed() {
  const auto active =
      std::count_if(channels_.begin(), channels_.end(), [](const auto& c) { return c.second.active; });
  const bool starts = std::any_of(channels_.begin(), channels_.end(),
                                  [&](const auto& c) { return c.second.active && c.second.start == next_; });
  if (!starts || active != 1) return false;
  target_of(next_, scratch_);
  for (std::size_t i = 0; i < axes_.size(); ++i)
    if (std::abs(scratch_[i] - command_[i]) > on_path_distance) return true;
  return false;
}

void DriveCore::follow() {
  if (rate_ == 1 && phase_ == 0) {  // the ordinary case: one cycle in one period, the setpoint as it is
    if (approach_needed()) {
      const auto start = scratch_;
      plan_return(start);
      return;
    }
    if (!pass_cycle()) return;
    command_ = target_;
  } else if (rate_ < 1 && dip_periods_ == 0) {
    rate_ = std::min(1.0, rate_ + rate_step());
    advance(rate_);
  } else {
    return_to_whole_cycles();
  }
  double moving = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i)
    moving = std::max(moving, std::abs(velocity_[i]) / (limits_[i].acceleration * dt_ * dt_));
  // The stop leads through the next setpoints, where another axis may be the fastest.
  moving = std::max(moving, stop_periods(std::min(supply().cycles, lead_ / 2)));
  reserve_ = std::min<std::uint64_t>(static_cast<std::uint64_t>(std::ceil(moving / 2)), lead_ / 2);
  if (!any_active()) {
    settle_ = virtual_time_ ? settling : 0;
    reserve_ = 0, rate_ = 1, phase_ = 0;
    std::fill(velocity_.begin(), velocity_.end(), 0.0);
  }
}

void DriveCore::move_axes() {
  for (std::size_t i = 0; i < axes_.size(); ++i) servos_[i].step(command_[i], dt_);
  move_spindles(true);
  skip_inputs_.step(servos_);
  supervise();
}

void DriveCore::supervise() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (reported_[i]) continue;
    const auto& l = limits_[i];
    const double error = command_[i] - servos_[i].encoder();
    char text[200];
    if (l.following > 0 && std::abs(error) > l.following) {
      std::snprintf(text, sizeof text, "Axis %s: following error %.4f, limit %.4f (parameter %s)",
                    axes_[i].name.c_str(), error, l.following,
                    machine::number_text(parameter::following_error_limit.number(axes_[i].number)).c_str());
      raise(alarm::following_error, axes_[i].number, text);
    } else if (constexpr double margin = 0.5; (command_[i] > l.positive + margin && velocity_[i] > 0) ||
                                              (command_[i] < l.negative - margin && velocity_[i] < 0)) {
      std::snprintf(text, sizeof text, "Axis %s at %.4f is beyond its travel %.4f .. %.4f",
                    axes_[i].name.c_str(), command_[i], l.negative, l.positive);
      raise(alarm::over_travel, axes_[i].number, text);
    } else {
      continue;
    }
    reported_[i] = true;
    if (mode_ == Mode::FOLLOWING && any_active()) begin_braking();
  }
}

void DriveCore::acknowledge() { std::fill(reported_.begin(), reported_.end(), false); }

void DriveCore::raise(const machine::AlarmDefinition& alarm, std::uint32_t part, std::string text) {
  events_.push_back({&alarm, part, std::move(text)});
}

std::vector<DriveEvent> DriveCore::take_events() { return std::exchange(events_, {}); }

void DriveCore::fill(idl::stream::FeedbackFrame& out) {
  const std::size_t n = axes_.size();
  out.first = rows_ > 0 ? first_row_ : next_;
  out.count = rows_;
  out.tick = tick_;
  out.mode = mode_ == Mode::HELD && resume_ ? Mode::RETURNING : mode_;
  out.revision = revision_;
  out.axis_count = static_cast<std::uint16_t>(n);
  std::swap(out.commanded, commanded_rows_);
  std::swap(out.actual, actual_rows_);
  commanded_rows_.clear();
  actual_rows_.clear();
  rows_ = 0;
  std::swap(out.spindle_angle, spindle_rows_);
  spindle_rows_.clear();
  std::swap(out.skips, skips_);
  skips_.clear();
  out.velocity.resize(n);
  out.torque.resize(n);
  out.position.resize(n);
  out.enabled.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out.velocity[i] = servos_[i].velocity();
    out.torque[i] = servos_[i].torque();
    out.position[i] = servos_[i].encoder();
    out.enabled[i] = mode_ == Mode::OFF ? 0 : 1;
  }
  out.spindle_speed.resize(spindles_.size());
  for (std::size_t i = 0; i < spindles_.size(); ++i) out.spindle_speed[i] = spindles_[i].speed();
  out.starved = starved_;
  out.channels.resize(channels_.size());
  std::size_t k = 0;
  for (const auto& [number, channel] : channels_) {
    auto& echo = out.channels[k++];
    echo.channel = number;
    echo.epoch = channel.epoch;
    echo.active = channel.active;
    echo.next = next_;
    echo.request = channel.request;
    echo.start = channel.start;
    echo.snapshot = channel.snapshot;
    echo.states = channel.states;
  }
}

}  // namespace trunnion::drive
