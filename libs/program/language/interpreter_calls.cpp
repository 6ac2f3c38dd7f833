// SPDX-License-Identifier: Apache-2.0
// The part of Interpreter that calls subprograms, macros and cycles and comes back from them.
#include <cmath>

#include "language/interpreter.hpp"
#include "language/num_parameters.hpp"

namespace trunnion::language {
namespace {

/// M0, M1, M30, M98 and others of which a block has one.
bool steers_flow(double code) {
  return code >= 0 && code <= highest_m && m_code(static_cast<std::uint16_t>(code)).group == MGroup::flow;
}

}  // namespace

Interpreter::State Interpreter::call_macro(Call& call, std::string_view line) {
  if (const Fault fault = read_call(block_, call)) return fail(fault, line);
  if (call.kind == CallKind::modal_cancel || call.kind == CallKind::modal_macro ||
      call.kind == CallKind::block_macro) {
    if (call.kind == CallKind::modal_cancel) {
      modal_calls_.remove();
    } else {
      if (call.kind == CallKind::modal_macro)
        read_arguments(block_, call.kind, executor_.modal().absolute, arguments_);
      Call later = call;
      later.offset = later.program_offset = 0;  // it will be called from other lines
      if (!modal_calls_.add(later, arguments_))
        return fail({AlarmNumber::nesting_too_deep, call.offset}, line);
    }
    control_.set_modal_macro(modal_calls_.active() != nullptr);
    return State::running;
  }
  if (call.kind == CallKind::control) {
    if (const Fault fault = carry_out_beside(call)) return fail(fault, line);
  }
  read_arguments(block_, call.kind, executor_.modal().absolute, arguments_);
  if (call.kind == CallKind::control) add_settings(call);
  return this->call(call, line);
}

// G90 or G91 beside a code of the control.
Fault Interpreter::carry_out_beside(const Call& call) {
  beside_.clear();
  for (std::size_t i = 0; i < block_.g_count; ++i)
    if (block_.g[i].offset != call.offset) beside_.g[beside_.g_count++] = block_.g[i];
  Flow flow;
  return beside_.g_count == 0 ? Fault{}
                              : executor_.execute(beside_, levels_[depth_].program, line_, queue_, flow);
}

// What a macro of the control has no variables for: its code, and parameters in the units of the program.
void Interpreter::add_settings(const Call& call) {
  constexpr double tenths = 10, millimetres_per_inch = 25.4;
  auto& values = arguments_.values;
  values[10] = Value::of(call.code / tenths);
  if (call.code != length_measuring_code) return;
  const LengthMeasuring measuring = environment_.length_measuring();
  const double unit = executor_.modal().metric ? 1.0 : millimetres_per_inch;
  values[27] = Value::of(measuring.distance / unit);
  values[28] = Value::of(measuring.range / unit);
  values[29] = Value::of(measuring.feed / unit);
  values[30] = Value::of(measuring.input);
}

// Nothing when no code of the block calls by a parameter. What is beside the code of a subprogram is carried
// out before it.
std::optional<Interpreter::State> Interpreter::call_by_code(std::string_view line) {
  Call call, other;
  std::uint32_t variable = 0, further = 0;
  double value = 0, unused = 0;
  if (!take_code_call(block_, code_calls_, call, variable, value)) return std::nullopt;
  if (block_.refused && block_.refused.offset != call.offset) return fail(block_.refused, line);
  const bool absolute = executor_.modal().absolute;
  if (call.kind == CallKind::macro) {
    if (const Fault fault = read_code_call(block_, absolute, call, arguments_)) return fail(fault, line);
    return this->call(call, line);
  }
  bool alone = modal_calls_.active() == nullptr && !find_call(block_, cycle_m_codes_, other) &&
               !take_code_call(block_, code_calls_, other, further, unused);
  for (std::size_t i = 0; i < block_.m_count; ++i) alone = alone && !steers_flow(block_.m[i].value);
  if (!alone) return fail({AlarmNumber::call_not_alone, call.offset}, line);
  if (variable != 0) variables_.write(variable, Value::of(value));
  if (block_.has_more()) {
    Flow flow;
    if (const Fault fault = executor_.execute(block_, levels_[depth_].program, line_, queue_, flow))
      return fail(fault, line);
  }
  return this->call(call, line);
}

// The cycle is the program of its number, and its arguments are #1, #2 and so on.
Interpreter::State Interpreter::call_cycle(std::string_view line) {
  arguments_.clear();
  arguments_.absolute = executor_.modal().absolute;
  for (std::size_t i = 0; i < block_.argument_count; ++i) arguments_.values[i + 1] = block_.arguments[i];
  Call call;
  call.kind = CallKind::macro;
  call.number = block_.program_number;
  call.offset = call.program_offset = block_.at;
  return this->call(call, line);
}

void Interpreter::begin_call(const Call& call) {
  call_ = call;
  called_ = call.number;
  after_call_ = reader_.position();
  call_line_ = line_;
}

Interpreter::State Interpreter::call_locally(const Call& call, std::string_view line) {
  if (depth_ == max_nesting) return fail({AlarmNumber::nesting_too_deep, call.offset}, line);
  begin_call(call);
  const CallLevel& level = levels_[depth_];
  for (const Found& known : found_) {
    if (known.local && known.caller == level.source && known.number == call.number &&
        known.home.offset == level.home.offset)
      return enter(known);
  }
  return jump(Purpose::local, call.number, position_, {AlarmNumber::label_missing, call.program_offset},
              line);
}

Interpreter::State Interpreter::call(const Call& call, std::string_view line) {
  if (depth_ == max_nesting) return fail({AlarmNumber::nesting_too_deep, call.offset}, line);
  begin_call(call);
  if (call.from_label) {
    label_not_found_ = located({AlarmNumber::label_missing, call.label_offset}, line);
    not_allowed_ = located({AlarmNumber::jump_into_structure, call.label_offset}, line);
  }
  const bool cycle = call.kind == CallKind::cycle;
  TextSource* const caller = levels_[depth_].source;
  for (const Found& known : found_) {
    if (!known.local && known.caller == caller && known.number == call.number && known.name == call.name &&
        known.cycle == cycle && (known.repetitions == 0 || !call.counted))
      return enter(known);
  }
  not_found_ = located({AlarmNumber::subprogram_missing, call.program_offset}, line);
  if (call.number == rules_.homing_program)
    not_allowed_ = located({AlarmNumber::num_homing_axis, call.program_offset}, line);
  const bool subroutine = call.kind == CallKind::subroutine;
  search_.purpose = subroutine ? Purpose::sub : Purpose::program;
  search_.wanted = subroutine ? call.name : call.number;
  search_.begun = search_.in_file = false;
  search_.program = levels_[depth_].program;
  search_.source = cycle ? environment_.subprogram(ProgramName(cycle_file).view()) : caller;
  search_.dialect = dialect_name_;
  if (search_.source == nullptr) return fail(not_found_);
  if (cycle && search_.source != caller) return read_head(*search_.source, cycle_file, Heading::Then::search);
  reader_.seek(*search_.source, {});
  return State::searching;
}

Interpreter::State Interpreter::found(TextSource& source, std::uint32_t program, TextPosition top,
                                      ProgramDialect dialect) {
  Found& entry = found_[next_found_];
  next_found_ = (next_found_ + 1) % found_.size();
  const std::uint32_t repetitions = call_.number == called_ ? 0 : call_.repetitions;
  const bool cycle = call_.kind == CallKind::cycle;
  const bool local = search_.purpose == Purpose::local;
  entry = {levels_[depth_].source,
           called_,
           repetitions,
           cycle,
           local,
           &source,
           program,
           top,
           local ? levels_[depth_].home : top,
           dialect,
           call_.name};
  return enter(entry);
}

Interpreter::State Interpreter::enter(const Found& target) {
  levels_[depth_].resume = after_call_;
  CallLevel& level = levels_[++depth_];
  level.source = target.source;
  level.program = target.program;
  level.top = target.top;
  level.home = target.home;
  level.call_line = call_line_;
  level.taped = false;
  level.remaining = (target.repetitions != 0 && !call_.counted ? target.repetitions : call_.repetitions) - 1;
  level.started = false;
  level.own_variables = call_.kind != CallKind::subprogram;
  level.modal = call_.kind == CallKind::modal_macro || call_.kind == CallKind::block_macro;
  level.dialect = target.dialect;
  use_dialect(level.dialect);
  level.sub = call_.name;
  level.defined = false;
  level.open.clear();
  level.by_code = levels_[depth_ - 1].by_code || call_.by_code;
  level.from_label = call_.from_label;
  level.label = call_.label;
  kept_modes_[depth_].valid = kept_modes_[depth_].returns = false;
  if (level.own_variables) variables_.enter(arguments_);
  variables_.names().enter();
  if (level.modal) level.modal_above = modal_calls_.enter();
  return begin_program();
}

// At its top, or at the sequence number that M98 names.
Interpreter::State Interpreter::begin_program() {
  const CallLevel& level = levels_[depth_];
  reader_.seek(*level.source, level.top);
  if (!level.from_label) return State::running;
  const auto* const known = jumps_.find(level.source, level.top.offset, key(Purpose::label, level.label));
  if (known != nullptr) return arrive(*known);
  not_found_ = label_not_found_;
  const State state = search(Purpose::label, level.label, level.top);
  search_.heading = true;
  return state;
}

// A variable that was never written is 0, and 0 is an axis.
std::optional<std::size_t> Interpreter::homing_axis() const {
  Value number;
  if (variables_.read(0, number) != AlarmNumber::none || !number.given) return std::nullopt;
  const double value = number.number;
  if (value != std::floor(value) || value < 0 || value >= static_cast<double>(addressed_axes.size()))
    return std::nullopt;
  return axis_letters.find(addressed_axes[static_cast<std::size_t>(value)]);
}

Interpreter::State Interpreter::home_axis() {
  reader_.seek(*levels_[depth_].source, after_call_);
  line_ = call_line_;
  const auto axis = homing_axis();
  if (!axis) return fail(not_allowed_);
  if (const Fault fault = executor_.home_axis(*axis, levels_[depth_].program, call_line_, queue_))
    return fail(fault, {});
  return State::running;
}

Interpreter::State Interpreter::return_from_subprogram(const Flow& flow, std::string_view line) {
  CallLevel& level = levels_[depth_];
  if (depth_ == 0 && flow.to_label) {
    return jump(Purpose::label, flow.subprogram, position_, {AlarmNumber::label_missing, block_.offset('P')},
                line);
  }
  if (depth_ == 0 && !options_.repeat) {
    if (const Fault fault = executor_.end_program(0, level.program, line_, queue_)) return fail(fault, line);
    return State::done;
  }
  if (depth_ != 0) {
    if (const Fault fault = return_modes()) return fail(fault, line);
  }
  if (depth_ == 0 || level.remaining > 0) {
    if (depth_ != 0) --level.remaining;
    level.started = false;
    level.open.clear();
    if (level.own_variables) variables_.repeat();
    if (depth_ != 0) variables_.names().again();
    return begin_program();
  }
  if (level.own_variables) variables_.leave();
  variables_.names().leave();
  if (level.modal) modal_calls_.leave(level.modal_above);
  // The alarm of a label that is not there belongs to the M99 that names it.
  if (flow.to_label) {
    not_found_ = located({AlarmNumber::label_missing, block_.offset('P')}, line);
    not_allowed_ = located({AlarmNumber::jump_into_structure, block_.offset('P')}, line);
  }
  --depth_;
  const CallLevel& caller = levels_[depth_];
  use_dialect(caller.dialect);
  reader_.seek(*caller.source, caller.resume);
  if (!flow.to_label) return State::running;
  const auto* const known =
      jumps_.find(caller.source, caller.resume.offset, key(Purpose::label, flow.subprogram));
  return known != nullptr ? arrive(*known) : search(Purpose::label, flow.subprogram, caller.resume);
}

}  // namespace trunnion::language
