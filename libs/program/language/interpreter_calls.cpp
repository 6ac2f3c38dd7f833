// SPDX-License-Identifier: Apache-2.0
// The part of Interpreter that calls subprograms, macros and cycles and comes back from them.
#include <cmath>

#include "language/interpreter.hpp"
#include "language/num_parameters.hpp"

namespace trunnion::language {

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
  read_arguments(block_, call.kind, executor_.modal().absolute, arguments_);
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

Interpreter::State Interpreter::call(const Call& call, std::string_view line) {
  if (depth_ == max_nesting) return fail({AlarmNumber::nesting_too_deep, call.offset}, line);
  call_ = call;
  called_ = call.number;
  after_call_ = reader_.position();
  call_line_ = line_;
  const bool cycle = call.kind == CallKind::cycle;
  TextSource* const caller = levels_[depth_].source;
  for (const Found& known : found_) {
    if (known.caller == caller && known.number == call.number && known.name == call.name &&
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
  if (search_.source == nullptr) return fail(not_found_);
  reader_.seek(*search_.source, {});
  return State::searching;
}

Interpreter::State Interpreter::found(TextSource& source, std::uint32_t program, TextPosition top) {
  Found& entry = found_[next_found_];
  next_found_ = (next_found_ + 1) % found_.size();
  const std::uint32_t repetitions = call_.number == called_ ? 0 : call_.repetitions;
  entry = {levels_[depth_].source,
           called_,
           repetitions,
           call_.kind == CallKind::cycle,
           &source,
           program,
           top,
           call_.name};
  return enter(entry);
}

Interpreter::State Interpreter::enter(const Found& target) {
  levels_[depth_].resume = after_call_;
  CallLevel& level = levels_[++depth_];
  level.source = target.source;
  level.program = target.program;
  level.top = target.top;
  level.call_line = call_line_;
  level.remaining = (target.repetitions != 0 && !call_.counted ? target.repetitions : call_.repetitions) - 1;
  level.started = false;
  level.own_variables = call_.kind != CallKind::subprogram;
  level.modal = call_.kind == CallKind::modal_macro || call_.kind == CallKind::block_macro;
  level.sub = call_.name;
  level.defined = false;
  level.open.clear();
  kept_modes_[depth_].valid = kept_modes_[depth_].returns = false;
  if (level.own_variables) variables_.enter(arguments_);
  variables_.names().enter();
  if (level.modal) level.modal_above = modal_calls_.enter();
  reader_.seek(*level.source, level.top);
  return State::running;
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
    reader_.seek(*level.source, level.top);
    return State::running;
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
  reader_.seek(*caller.source, caller.resume);
  if (!flow.to_label) return State::running;
  const auto* const known =
      jumps_.find(caller.source, caller.resume.offset, key(Purpose::label, flow.subprogram));
  return known != nullptr ? arrive(*known) : search(Purpose::label, flow.subprogram, caller.resume);
}

}  // namespace trunnion::language
