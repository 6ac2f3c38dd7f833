// SPDX-License-Identifier: Apache-2.0
#include "plc_core.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "canonical/macro_signal.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::plc {
namespace {

std::int64_t percent(double fraction) { return std::llround(fraction * 100); }

}  // namespace

PlcCore::PlcCore() {
  done_.reserve(2 * channel_count);  // one of a channel finishes, and another is asked for again
  const auto name = [](const char* text) { return interface_address(text); };
  emergency_button_ = name("emergency_stop_button"), reset_button_ = name("reset_button");
  drive_present_ = name("drive_present"), drives_on_ = name("drives_on");
  alarm_active_ = name("alarm_active"), alarm_stops_ = name("alarm_stops");
  probe_contact_ = name("probe_contact"), probe_on_ = name("probe_on");
  emergency_stop_ = name("emergency_stop"), feed_hold_ = name("feed_hold"),
  axes_enable_ = name("axes_enable");
  external_reset_ = name("external_reset");
  for (std::size_t i = 0; i < milling_tool_.size(); ++i)
    milling_tool_[i] = interface_address("milling_tool", i);
  for (std::size_t i = 0; i < axis_inhibit_.size(); ++i)
    axis_inhibit_[i] = interface_address("axis_inhibit", i);
  for (std::size_t i = 0; i < slave_off_.size(); ++i) slave_off_[i] = interface_address("slave_off", i);
  for (std::size_t i = 0; i < coolant_.size(); ++i) coolant_[i] = interface_address("coolant", i);
  for (std::size_t c = 0; c < channel_count; ++c) {
    const auto of = [c](const char* text) { return interface_address(text, c); };
    channel_symbols_[c] = {
        of("channel_running"), of("channel_held"),  of("channel_idle"),   of("channel_homed"),
        of("channel_rtcp"),    of("channel_reset"), of("mode_auto"),      of("mode_mdi"),
        of("mode_jog"),        of("mode_ref"),      of("m_strobe"),       of("s_strobe"),
        of("t_strobe"),        of("e_strobe"),      of("m_code"),         of("m_angle"),
        of("s_value"),         of("t_code"),        of("e_order"),        of("e_spindle"),
        of("e_value"),         of("feed_override"), of("rapid_override"), of("spindle_override"),
        of("active_tool"),     of("fin"),           of("fin_failed"),     of("s_surface_speed"),
        of("s_limit"),         of("s_radius"),      of("macro_input"),    of("macro_output")};
    for (const auto address : {channel_symbols_[c].feed_override, channel_symbols_[c].rapid_override,
                               channel_symbols_[c].spindle_override})
      store(memory_.registers, address, 100);  // until the channel publishes its values
  }
  find_control();
  find_spindles();
}

void PlcCore::configure(const machine::Parameters& parameters, bool virtual_time) {
  virtual_time_ = virtual_time;
  axis_exists_.assign(32, 0);
  axis_names_.clear();
  for (const auto& axis : machine::drive_axes(parameters)) {
    axis_exists_[axis.number] = 1;
    axis_names_.push_back(axis.name);
  }
  const auto spindles = machine::spindles(parameters);
  spindles_ = std::min(spindles.size(), spindle_count);
  for (std::size_t s = 0; s < spindles_; ++s) {
    const auto number = spindles[s].number;
    speed_window_[s] = parameters.get(parameter::speed_window, number) / 100;
    highest_speed_[s] = parameters.get(parameter::maximum_speed, number);
    for (std::uint32_t gear = 0; gear < gear_count; ++gear)
      gear_speeds_[s][gear] = parameters.get(parameter::gear_highest_speed, number, gear);
  }
  const bool continues = !configured() && memory_.tick > 0;  // what restore() has left to do counts
  period_us_ = static_cast<std::uint64_t>(parameters.integer(parameter::interpolation_cycle));
  main_part_ = parameters.integer(parameter::plc2_statements);
  view_.changed = view_.changed || !continues;
  if (continues) restore_spindles();
}

void PlcCore::load(StructuredText structured) {
  structured_ = std::move(structured);
  structured_.reset(memory_.program);
  loaded_ = true;
  view_.changed = true;
}

void PlcCore::load(Programs programs) {
  set_position_switches(std::move(programs.switches));
  messages_ = std::move(programs.messages);
  load(std::move(programs.structured));
}

void PlcCore::set_position_switches(std::vector<st::PositionSwitch> switches) {
  switches_ = std::move(switches);
}

void PlcCore::actuate_switches(const std::vector<double>& position) {
  for (const auto& one : switches_)
    for (std::size_t i = 0; i < std::min(axis_names_.size(), position.size()); ++i)
      if (axis_names_[i] == one.axis)
        input({Area::x, one.input.index, one.input.bit}, position[i] >= one.low && position[i] <= one.high);
}

void PlcCore::restore(const Memory& memory) {
  memory_ = memory;
  if (!loaded_) return restore_spindles();
  if (!structured_.fits(memory_.program)) drop_forces_of_variables();
  const auto before = memory_.program;
  structured_.restore(memory_.program);
  // The same programs have seen these inputs: one scan more would be one that nobody has asked for.
  view_.changed = memory_.program != before || memory_.tick == 0;
  restore_spindles();
}

void PlcCore::power_up(const Memory& memory) {
  // Retained timers and controllers have kept times of it. The drive's ticks begin anew: tick stays 0.
  memory_.now_us = memory.now_us, memory_.scans = memory.scans;
  memory_.spindle_since.fill(memory.scans);
  auto& kept = memory_.registers;
  kept.b = memory.registers.b, kept.c = memory.registers.c;
  kept.k = memory.registers.k, kept.p = memory.registers.p;
  for (const auto& address : structured_.retained_registers())
    store(kept, address, plc::load(memory.registers, address));
  for (std::uint32_t i = 0; i < memory.forces.count; ++i)
    if (memory.forces.values[i].permanent != 0) force(memory.forces.values[i]);
  // Programs with an error lose nothing: the corrected ones find their variables.
  if (!loaded_) {
    memory_.program = memory.program;
    return;
  }
  if (!structured_.fits(memory.program)) drop_forces_of_variables();
  structured_.power_up(memory.program, memory_.program);
}

void PlcCore::adopt(const PlcState& state) {
  memory_ = state.memory;
  view_ = state.view;
  structured_.restore(memory_.program);
}

void PlcCore::press_reset() {
  view_.changed = view_.changed || has_program_fault();
  memory_.program.fault = {};
  input(reset_button_, 1);
}

void PlcCore::input(Address address, std::int64_t value) {
  const auto before = plc::load(memory_.registers, address);
  store(memory_.registers, address, value);
  view_.changed = view_.changed || plc::load(memory_.registers, address) != before;
}

void PlcCore::set_channel(const idl::channel::ChannelState& state) {
  if (state.channel >= channel_count) return;
  using idl::channel::Mode;
  using idl::channel::RunState;
  const auto& s = channel_symbols_[state.channel];
  input(s.running, state.state == RunState::RUNNING);
  input(s.held, state.state == RunState::HELD || state.state == RunState::HOLDING);
  input(s.idle, state.state == RunState::IDLE);
  input(s.homed, state.homed);
  input(s.rtcp, state.rtcp);
  input(s.mode_auto, state.mode == Mode::AUTO);
  input(s.mode_mdi, state.mode == Mode::MDI);
  input(s.mode_jog, state.mode == Mode::JOG);
  input(s.mode_ref, state.mode == Mode::REF);
  input(s.feed_override, percent(state.feed_override));
  input(s.rapid_override, percent(state.rapid_override));
  input(s.spindle_override, percent(state.spindle_override));
  input(s.tool, state.tool);
  if (state.channel < milling_tool_.size()) input(milling_tool_[state.channel], state.tool);
  auto& view = view_.channels[state.channel];
  if (view.seen && state.reset_count > view.resets) input(s.reset, 1);
  view.seen = true;
  view.resets = state.reset_count;
}

void PlcCore::set_request(const idl::channel::AuxiliaryRequest& request) {
  if (request.channel >= channel_count) return;
  auto& h = memory_.handshakes[request.channel];
  if (request.kind == AuxiliaryKind::NO_AUXILIARY) {
    if (h.state == HandshakeState::waiting || h.state == HandshakeState::strobe)
      h.state = HandshakeState::none;
    view_.changed = true;
    return;
  }
  const bool known = h.state != HandshakeState::none && h.number == request.number &&
                     h.kind == request.kind && h.code == request.code && h.cycle == request.cycle;
  if (known) {
    if (h.state == HandshakeState::done) done_.push_back({request.channel, h.number, h.failed != 0});
    return;
  }
  const bool has_angle = request.kind == AuxiliaryKind::M && request.has_value;
  const bool surface = request.kind == AuxiliaryKind::S && request.surface;
  const bool sets_signal =
      request.kind == AuxiliaryKind::E && request.has_value && canonical::is_macro_output(request.code);
  h = {HandshakeState::waiting,
       request.number,
       request.kind,
       request.code,
       request.value,
       request.cycle,
       0,
       has_angle || surface || sets_signal ? 1u : 0u};
  // Not with the strobe: the handshake, which older files have, has no place for them.
  if (surface) {
    const auto& s = channel_symbols_[request.channel];
    store(memory_.registers, s.s_limit, std::llround(std::floor(std::clamp(request.limit, 0.0, 65535.0))));
    store(memory_.registers, s.s_radius, std::llround(std::clamp(request.radius * 10, 0.0, 65535.0)));
  }
  view_.stopped_waiting = false;
  view_.changed = true;
}

void PlcCore::set_feedback(const idl::stream::Feedback& feedback) {
  view_.drive_seen = true;
  view_.changed = view_.changed || waits_for_standstill();
  view_.executed = std::max(view_.executed, feedback.first + feedback.count);
  for (auto& channel : view_.channels) channel.active = false;
  for (const auto& echo : feedback.channels)
    if (echo.channel < channel_count) view_.channels[echo.channel].active = echo.active;
  take_spindles(feedback);
  if (feedback.press_number != 0) press_emergency_stop({feedback.press_client, feedback.press_number});
  input(drive_present_, 1);
  input(probe_contact_, feedback.skip_inputs & 1);
  input(drives_on_, !feedback.enabled.empty() && std::all_of(feedback.enabled.begin(), feedback.enabled.end(),
                                                             [](std::uint8_t on) { return on != 0; }));
  actuate_switches(feedback.position);
  if (configured()) check_spindles();
}

void PlcCore::set_alarms(bool any, bool stops) {
  input(alarm_active_, any);
  input(alarm_stops_, stops);
}

// A request that is sent again, or that the drive still holds, is no second press.
void PlcCore::press_emergency_stop(const View::Press& press) {
  auto& taken = view_.presses;
  if (press.number != 0 && std::find(taken.begin(), taken.end(), press) != taken.end()) return;
  std::copy_backward(taken.begin(), taken.end() - 1, taken.end());
  taken.front() = press;
  view_.press_acted = false;
  input(emergency_button_, 1);
}

bool PlcCore::at_standstill(std::size_t channel) const {
  if (!virtual_time_ || view_.stopped_waiting) return true;
  return view_.drive_seen && !view_.channels[channel].active &&
         view_.executed >= memory_.handshakes[channel].cycle;
}

bool PlcCore::waits_for_standstill() const {
  for (std::size_t c = 0; c < channel_count; ++c)
    if (memory_.handshakes[c].state == HandshakeState::waiting && !at_standstill(c)) return true;
  return false;
}

bool PlcCore::waits_for_run() const {
  for (std::size_t c = 0; c < channel_count; ++c)
    if (memory_.handshakes[c].state == HandshakeState::waiting && at_standstill(c)) return continues_main();
  return false;
}

void PlcCore::give_up_waiting() {
  view_.stopped_waiting = true;
  view_.changed = true;
}

void PlcCore::set_strobes(bool present) {
  auto& r = memory_.registers;
  for (std::size_t c = 0; c < channel_count; ++c) {
    auto& h = memory_.handshakes[c];
    const auto& s = channel_symbols_[c];
    // A strobe rises after the answer to the one before has fallen, and never in scans for past ticks: the
    // times after it would count from then. Nor within a run of the main task that is spread over scans: its
    // end would answer a function that its beginning has not seen.
    if (present && !continues_main() && h.state == HandshakeState::waiting && plc::load(r, s.fin) == 0 &&
        at_standstill(c)) {
      h.state = HandshakeState::strobe;
      if (h.kind == AuxiliaryKind::M) {
        store(r, s.m_code, h.code);
        store(r, s.m_angle, h.has_value != 0 ? hundredths(h.value) : no_angle);
      }
      if (h.kind == AuxiliaryKind::S) {
        const double surface = h.has_value != 0 ? std::clamp(h.value * 10, 1.0, 65535.0) : 0;
        store(r, s.s_value, std::llround(std::clamp(h.value, 0.0, 65535.0)));
        store(r, s.s_surface_speed, std::llround(surface));
      }
      if (h.kind == AuxiliaryKind::T) store(r, s.t_code, h.code);
      if (h.kind == AuxiliaryKind::E) begin_order(h, s);
    }
    const bool strobe = h.state == HandshakeState::strobe;
    store(r, s.m_strobe, strobe && h.kind == AuxiliaryKind::M);
    store(r, s.s_strobe, strobe && h.kind == AuxiliaryKind::S);
    store(r, s.t_strobe, strobe && h.kind == AuxiliaryKind::T);
    store(r, s.e_strobe, strobe && h.kind == AuxiliaryKind::E && !h.is_signal());
  }
}

void PlcCore::finish() {
  for (std::size_t c = 0; c < channel_count; ++c) {
    auto& h = memory_.handshakes[c];
    const auto& s = channel_symbols_[c];
    if (h.state != HandshakeState::strobe) continue;
    const auto failed = failure(h, s);
    if (!failed) continue;
    h.failed = *failed ? 1u : 0u;
    if (h.is_signal()) read_signal(h, s);
    h.state = HandshakeState::done;
    done_.push_back({static_cast<std::uint16_t>(c), h.number, h.failed != 0});
  }
}

void PlcCore::scan(bool main, bool present) {
  auto& r = memory_.registers;
  set_strobes(present);
  apply_forces();
  if (times_ != nullptr) times_->begin_scan();
  run_task(TaskName::simulation);
  run_task(TaskName::fast);
  if (main) run_task(TaskName::main);
  if (times_ != nullptr) times_->end_scan();
  check_spindles();
  finish();
  if (main && !continues_main()) {  // the main task has read them
    store(r, reset_button_, 0);
    for (const auto& s : channel_symbols_) store(r, s.reset, 0);
  }
  apply_forces();
  if (trace_ != nullptr) trace_->after_scan(memory_);
  if (orders_ != nullptr) orders_->after_scan(memory_.registers, memory_.now_us);
}

void PlcCore::run_task(TaskName task) {
  if (has_program_fault() || !structured_.has(task)) return;
  if (times_ != nullptr) times_->begin_task();
  structured_.run(task, memory_.registers, memory_.program, memory_.scans, main_part_);
  if (times_ != nullptr) times_->end_task(task, structured_.statements());
  apply_forces();
}

std::array<std::uint64_t, 3> PlcCore::statement_budgets() const {
  std::array<std::uint64_t, 3> budgets{};
  for (const auto task : {TaskName::fast, TaskName::main, TaskName::simulation})
    if (structured_.has(task))
      budgets[static_cast<std::size_t>(task)] =
          static_cast<std::uint64_t>(task == TaskName::main ? main_part_ : StructuredText::most_statements);
  return budgets;
}

void PlcCore::settle() {
  for (int i = 0; i < most_settling; ++i) {
    const auto before = memory_.registers;
    if (memory_.program.cells > 0) settling_.assign(memory_.program);
    scan(true, true);
    if (memory_.registers == before && memory_.program == settling_) break;
  }
  structured_.set_run(memory_.program);
}

void PlcCore::advance(std::uint64_t tick) {
  if (!loaded_ || !configured()) return;
  if (tick < memory_.tick || memory_.tick == 0) memory_.tick = tick;
  memory_.now_us += (tick - memory_.tick) * period_us_;
  memory_.tick = tick;
  const auto now = memory_.now_us / 1000;
  if (now - memory_.scans > most_catch_up) memory_.scans = now - most_catch_up;
  // A timer of a task that runs in every scan has ended for that task after these scans, not for the others.
  const bool ended = structured_.timer_due(now);
  while (memory_.scans < now) {
    ++memory_.scans;
    scan(memory_.scans % main_period == 0 || continues_main(), false);
  }
  if (view_.changed || ended || structured_.timer_due(now)) settle();
  view_.changed = waits_for_run();
  view_.press_acted = view_.press_acted || emergency_stop();
  unscanned_.reset();
}

Registers PlcCore::rescanned() const {
  PlcCore copy = *this;
  copy.scan_unseen();
  if (loaded_ && configured()) copy.settle();
  return copy.memory_.registers;
}

bool PlcCore::emergency_stop() const {
  return !loaded_ || has_program_fault() || plc::load(memory_.registers, emergency_stop_) != 0;
}

bool PlcCore::external_reset() const {
  return loaded_ && !has_program_fault() && plc::load(memory_.registers, external_reset_) != 0;
}

idl::plc::Outputs PlcCore::outputs() const {
  const auto& r = memory_.registers;
  idl::plc::Outputs outputs;
  outputs.tick = memory_.tick;
  outputs.emergency_stop = emergency_stop();
  for (const auto& press : view_.presses)
    if (view_.press_acted && press.number != 0) outputs.presses.push_back({press.client, press.number});
  outputs.feed_hold = plc::load(r, feed_hold_) != 0;
  outputs.probe_on = plc::load(r, probe_on_) != 0;
  outputs.axis_enable = axis_exists_;
  const bool enable = !outputs.emergency_stop && plc::load(r, axes_enable_) != 0;
  for (std::size_t a = 0; a < outputs.axis_enable.size(); ++a)
    if (!enable || (a < axis_inhibit_.size() && plc::load(r, axis_inhibit_[a]) != 0))
      outputs.axis_enable[a] = 0;
  constexpr std::uint8_t slave_is_off = 2;
  for (std::size_t a = 0; a < std::min(outputs.axis_enable.size(), slave_off_.size()); ++a)
    if (plc::load(r, slave_off_[a]) != 0) outputs.axis_enable[a] |= slave_is_off;
  for (const auto address : coolant_)
    outputs.coolant.push_back(!outputs.emergency_stop && plc::load(r, address) != 0 ? 1 : 0);
  set_spindles(outputs);
  bool moves = false;
  for (std::size_t s = 0; s < spindles_; ++s) moves = moves || spindle_moves(s);
  set_control(outputs);
  outputs.run_until_tick = memory_.tick;
  if (period_us_ > 0) {
    auto until = structured_.next_timer_end(memory_.scans);
    if (continues_main()) until = std::min(until.value_or(~std::uint64_t{0}), memory_.scans + 1);
    if (moves) until = std::min(until.value_or(~std::uint64_t{0}), memory_.scans + main_period);
    if (until) outputs.run_until_tick += (*until * 1000 - memory_.now_us + period_us_ - 1) / period_us_;
  }
  return outputs;
}

idl::plc::Image PlcCore::image() const {
  const auto& r = memory_.registers;
  idl::plc::Image image;
  image.scan = memory_.scans;
  image.x.assign(r.x.begin(), r.x.end());
  image.y.assign(r.y.begin(), r.y.end());
  image.f.assign(r.f.begin(), r.f.end());
  image.g.assign(r.g.begin(), r.g.end());
  image.r.assign(r.r.begin(), r.r.end());
  image.b.assign(r.b.begin(), r.b.end());
  image.w.assign(r.w.begin(), r.w.end());
  image.d.assign(r.d.begin(), r.d.end());
  image.t.assign(r.t.begin(), r.t.end());
  image.c.assign(r.c.begin(), r.c.end());
  image.k.assign(r.k.begin(), r.k.end());
  image.p.assign(r.p.begin(), r.p.end());
  return image;
}

std::vector<idl::plc::AuxiliaryDone> PlcCore::take_done() {
  auto result = done_;
  done_.clear();  // keeps its memory: a scan allocates nothing
  return result;
}

std::vector<idl::plc::AuxiliaryDone> PlcCore::all_done() const {
  std::vector<idl::plc::AuxiliaryDone> result;
  for (std::size_t c = 0; c < channel_count; ++c)
    if (memory_.handshakes[c].state == HandshakeState::done)
      result.push_back(
          {static_cast<std::uint16_t>(c), memory_.handshakes[c].number, memory_.handshakes[c].failed != 0});
  return result;
}

}  // namespace trunnion::plc
