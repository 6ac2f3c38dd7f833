// SPDX-License-Identifier: Apache-2.0
#include "language/control_variables.hpp"

#include <cmath>

#include "canonical/macro_signal.hpp"
#include "language/arithmetic.hpp"
#include "language/decimal.hpp"

namespace trunnion::language {
namespace {

constexpr double millimetres_per_inch = 25.4;
constexpr double highest_message = 9999;
constexpr std::uint32_t offsets_apart = 20;  // numbers from one work offset to the next
constexpr std::uint32_t basic_offsets = 6;   // G54 .. G59

using canonical::SpindleValue;

constexpr std::uint32_t spindle_variables = 4801;  // of the first value; those of the next are 10 behind
constexpr std::uint32_t values_apart = 10;

constexpr std::uint32_t single_block_variable = 3003;
constexpr double most_parts = 4294967295.0;
constexpr std::uint32_t first_modal = 4001;
constexpr std::uint32_t modal_apart = 200;  // from #4001 to #4201

/// As those of the table of variables.
constexpr VariableRange external_offset_range{5201, 5209, VariableKind::external_work_offset, true, ""};
constexpr VariableRange basic_offsets_range{5221, 5329, VariableKind::work_offset, true, ""};

bool is_work_offset(VariableKind kind) {
  return kind == VariableKind::external_work_offset || kind == VariableKind::work_offset ||
         kind == VariableKind::extended_work_offset;
}

bool is_spindle_order(VariableKind kind) {
  return kind == VariableKind::spindle || kind == VariableKind::spindle_integral ||
         kind == VariableKind::spindle_angle;
}

std::uint8_t work_offset_index(VariableKind kind, std::uint32_t index) {
  if (kind == VariableKind::external_work_offset) return external_work_offset;
  return static_cast<std::uint8_t>(index / offsets_apart +
                                   (kind == VariableKind::extended_work_offset ? basic_offsets : 0));
}

Table table_of(VariableKind kind) {
  switch (kind) {
    case VariableKind::length:
      return Table::tool_length;
    case VariableKind::length_wear:
      return Table::tool_length_wear;
    case VariableKind::radius:
      return Table::tool_radius;
    case VariableKind::radius_wear:
      return Table::tool_radius_wear;
    default:
      return Table::none;
  }
}

}  // namespace

void ControlVariables::start() {
  milliseconds_zero_ = hours_zero_ = 0;
  sequence_number_ = 0;
  program_number_ = 0;
  modal_macro_ = needs_answer_ = false;
  answer_ = 0;
  request_count_ = programmed_count_ = 0;
}

void ControlVariables::give_value(double value) {
  needs_value_ = false;
  if (values_ < value_.size()) value_[values_++] = value;
}

// In the order in which the line reads them: it is the same each time.
AlarmNumber ControlVariables::live_value(std::uint32_t number, double& result) const {
  if (values_read_ < values_) {
    result = value_[values_read_++];
    return AlarmNumber::none;
  }
  if (values_ == value_.size()) return AlarmNumber::too_many_codes;
  wanted_ = number;
  return value_pending;
}

double ControlVariables::in_program_units(std::uint32_t axis, double value) const {
  return executor_.modal().metric || is_rotary(axis) ? value : value / millimetres_per_inch;
}

double ControlVariables::to_machine_units(std::uint32_t axis, double value) const {
  return executor_.modal().metric || is_rotary(axis) ? value : value * millimetres_per_inch;
}

AlarmNumber ControlVariables::modal(std::uint32_t number, double& result) const {
  const ModalState& modal = executor_.modal();
  switch (number) {
    case 4001:
      result = modal.motion;
      break;
    case 4002:
      result = modal.plane == Plane::xy ? 17 : modal.plane == Plane::zx ? 18 : 19;
      break;
    case 4003:
      result = modal.absolute ? 90 : 91;
      break;
    case 4005:
      result = modal.feed_mode == FeedMode::inverse_time ? 93
               : modal.feed_mode == FeedMode::per_minute ? 94
                                                         : 95;
      break;
    case 4006:
      result = modal.metric ? 21 : 20;
      break;
    case 4007:
      result = modal.cutter_side == CutterSide::off ? 40 : modal.cutter_side == CutterSide::left ? 41 : 42;
      break;
    case 4008:
      result = modal.tip_control() ? (modal.tool_vector ? 43.5 : 43.4) : modal.length_offset != 0 ? 43 : 49;
      break;
    case 4009:
      result = modal.cycle;
      break;
    case 4010:
      result = modal.return_to_initial ? 98 : 99;
      break;
    case 4011:
      result = modal.scaled ? 51 : 50;
      break;
    case 4012:
      result = modal_macro_ ? 66 : 67;
      break;
    case 4013:
      result = modal.spindle_mode == SpindleMode::surface ? 96 : 97;
      break;
    case 4014:
      result = modal.work_offset < basic_offsets ? 54 + modal.work_offset : 54.1;
      break;
    case 4015:
      result = modal.path_control == PathControl::exact_stop ? 61 : 64;
      break;
    case 4016:
      result = modal.tilt.active ? 68.2 : modal.rotated ? 68 : 69;
      break;
    case 4018:
      result = modal.polar ? 16 : 15;
      break;
    case 4022:
      result = modal.mirrored ? 51.1 : 50.1;
      break;
    case 4030:
      result = modal.absolute_centres ? 90.1 : 91.1;
      break;
    case 4033:
      result = executor_.frame().setting_error().number;
      break;
    case 4107:
      result = modal.radius_offset;
      break;
    case 4109:
      result = modal.feed_mode == FeedMode::inverse_time ? modal.feed : in_program_units(X, modal.feed);
      break;
    case 4111:
      result = modal.length_offset;
      break;
    case 4114:
      result = sequence_number_;
      break;
    case 4115:
      result = program_number_;
      break;
    case 4119:
      result = modal.spindle_mode == SpindleMode::surface ? modal.surface_speed : modal.spindle_speed;
      break;
    case 4120:
      result = modal.selected_tool;
      break;
    case 4130:
      result = modal.work_offset < basic_offsets ? 0 : modal.work_offset - basic_offsets + 1;
      break;
    default:
      return AlarmNumber::variable_unknown;
  }
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::homed(std::uint32_t axis, double& result) const {
  result = 1;
  if (((executor_.homed() >> axis) & 1u) != 0) return AlarmNumber::none;
  if (!homed_) return AlarmNumber::homed_unknown;
  result = (*homed_ >> axis) & 1u;
  return AlarmNumber::none;
}

// #2500 is X of the external offset, #2501 of G54, #2502 of G55 and #2601 Y of G54.
std::optional<ControlVariables::OffsetPlace> ControlVariables::offset_of_axis(const VariableRange& range,
                                                                              std::uint32_t index) const {
  constexpr std::uint32_t first = 2500, axes_apart = 100, axes = 3;
  const std::uint32_t number = range.first + index;
  if (number < first || number >= first + axes * axes_apart || !environment_.offsets_by_axis())
    return std::nullopt;
  const std::uint32_t offset = (number - first) % axes_apart, axis = (number - first) / axes_apart;
  if (offset == 0) return OffsetPlace{&external_offset_range, axis};
  if (offset > basic_offsets) return std::nullopt;
  return OffsetPlace{&basic_offsets_range, (offset - 1) * offsets_apart + axis};
}

AlarmNumber ControlVariables::read_parameter(std::uint32_t number, double& value) const {
  const auto parameter = environment_.parameter(number);
  if (!parameter) return AlarmNumber::parameter_unavailable;
  value = *parameter;
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::read(const VariableRange& range, std::uint32_t index, Value& value) const {
  if (const auto offset = offset_of_axis(range, index)) return read(*offset->range, offset->index, value);
  double result = 0;
  value = Value{};  // vacant where there is nothing, so that a program can ask
  switch (range.kind) {
    case VariableKind::length:
    case VariableKind::length_wear:
    case VariableKind::radius:
    case VariableKind::radius_wear: {
      const auto tool = executor_.tables().tool(static_cast<std::uint16_t>(index + 1));
      if (!tool) return AlarmNumber::none;
      result = in_program_units(X, range.kind == VariableKind::length        ? tool->length
                                   : range.kind == VariableKind::length_wear ? tool->length_wear
                                   : range.kind == VariableKind::radius      ? tool->radius.value_or(0)
                                                                             : tool->radius_wear) *
               tool_scale(range.kind);
      break;
    }
    case VariableKind::time_milliseconds:
      result = time_.milliseconds - milliseconds_zero_;
      break;
    case VariableKind::time_hours:
      result = time_.hours - hours_zero_;
      break;
    case VariableKind::cycle:
      result = answer_;
      break;
    case VariableKind::date:
      result = time_.date;
      break;
    case VariableKind::time_of_day:
      result = time_.time_of_day;
      break;
    case VariableKind::modal: {
      const std::uint32_t apart = range.first == first_modal ? 0 : modal_apart;
      if (const AlarmNumber alarm = modal(range.first + index - apart, result); alarm != AlarmNumber::none)
        return alarm;
      break;
    }
    case VariableKind::suppression: {
      const std::uint8_t suppressed = executor_.modal().suppressed;
      result = range.first == single_block_variable ? suppressed & canonical::no_single_block
                                                    : suppressed >> canonical::path_suppression;
      break;
    }
    case VariableKind::mirror:
      result = executor_.frame().mirrored_axes();
      break;
    case VariableKind::parts:
      result = parts_;
      break;
    case VariableKind::macro_signal:
      if (const AlarmNumber alarm = live_value(range.first + index, result); alarm != AlarmNumber::none)
        return alarm;
      break;
    case VariableKind::cutter_radius:
      if (!executor_.cutter_radius()) return AlarmNumber::none;
      result = in_program_units(X, *executor_.cutter_radius());
      break;
    case VariableKind::homed:
      if (const AlarmNumber alarm = homed(index, result); alarm != AlarmNumber::none) return alarm;
      break;
    case VariableKind::tool_time:
      if (!tool_times_) return AlarmNumber::variable_unknown;
      break;
    case VariableKind::block_end:
      result = in_program_units(index, executor_.program_position()[index]);
      break;
    case VariableKind::work_position:
      result = in_program_units(index, executor_.workpiece_position()[index]);
      break;
    case VariableKind::machine_position:
      if (((environment_.axes() >> index) & 1u) == 0) return AlarmNumber::none;
      result = in_program_units(index, executor_.machine_position()[index]);
      break;
    case VariableKind::spindle: {
      const auto which = static_cast<SpindleValue>((range.first - spindle_variables) / values_apart);
      if (const AlarmNumber alarm = spindle_value(which, index, result); alarm != AlarmNumber::none)
        return alarm;
      break;
    }
    case VariableKind::skip_position:
      result = in_program_units(index, skip_position_[index]);
      break;
    case VariableKind::active_length:
      result = index == Z ? in_program_units(Z, executor_.modal().tool_length) : 0;
      break;
    case VariableKind::external_work_offset:
    case VariableKind::work_offset:
    case VariableKind::extended_work_offset: {
      const std::uint32_t axis = index % offsets_apart;
      if (axis >= axis_count) return AlarmNumber::variable_unknown;
      result =
          in_program_units(axis, executor_.tables().work_offset(work_offset_index(range.kind, index))[axis]);
      break;
    }
    default:
      return AlarmNumber::variable_unknown;
  }
  value = Value::of(result);
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::write(const VariableRange& range, std::uint32_t index, Value value) {
  if (const auto offset = offset_of_axis(range, index))
    return ask(*offset->range, offset->index, value.number);
  switch (range.kind) {
    case VariableKind::alarm:
      return AlarmNumber::program_alarm;
    case VariableKind::message:
    case VariableKind::cycle:
    case VariableKind::parts:
      return ask(range, index, nearly_whole(value.number));
    case VariableKind::time_milliseconds:
      milliseconds_zero_ = time_.milliseconds - value.number;
      return AlarmNumber::none;
    case VariableKind::time_hours:
      hours_zero_ = time_.hours - value.number;
      return AlarmNumber::none;
    case VariableKind::spindle:
    case VariableKind::spindle_integral:
    case VariableKind::spindle_angle:
      return order(range, index, nearly_whole(value.number));
    case VariableKind::suppression:
      return suppress(range.first, nearly_whole(value.number));
    case VariableKind::macro_signal:
      return set_signal(range.first + index, nearly_whole(value.number));
    default:
      return ask(range, index, value.number);
  }
}

AlarmNumber ControlVariables::ask(const VariableRange& range, std::uint32_t index, double value) {
  const bool message = range.kind == VariableKind::message || range.kind == VariableKind::cycle;
  const bool parts = range.kind == VariableKind::parts;
  const double lowest = message || parts || range.kind == VariableKind::radius ? 0 : -largest_number;
  const double highest = message ? highest_message : parts ? most_parts : largest_number;
  if (!(value >= lowest && value <= highest) || (parts && value != std::floor(value)))
    return AlarmNumber::variable_value;
  if (is_work_offset(range.kind) && index % offsets_apart >= axis_count) return AlarmNumber::variable_unknown;
  if (request_count_ == requests_.size()) return AlarmNumber::too_many_codes;
  requests_[request_count_++] = {range.kind, index, value};
  return AlarmNumber::none;
}

// As the external parameters of the NUM dialect.
AlarmNumber ControlVariables::order(const VariableRange& range, std::uint32_t index, double value) {
  if (request_count_ == requests_.size()) return AlarmNumber::too_many_codes;
  Request request{range.kind, canonical::order_angle, value};
  if (range.kind == VariableKind::spindle) {
    request.index = canonical::order_master + index;
    request.value = value == 0 ? -1 : canonical::master_address + value - 1;
    if (const Fault fault = check_master(index, request.value)) return fault.number;
  } else if (range.kind == VariableKind::spindle_integral) {
    if (value != 0 && value != 1 && value != 2) return AlarmNumber::variable_value;
    request.index = canonical::order_integral + index;
    request.value = value == 2 ? -1 : value;
  } else if (std::abs(value) > largest_added_angle) {
    return AlarmNumber::variable_value;
  }
  requests_[request_count_++] = request;
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::suppress(std::uint32_t number, double value) {
  constexpr double completion = 2, everything = 7;
  const bool single_block = number == single_block_variable;
  if (single_block && (value == completion || value == completion + 1)) return AlarmNumber::completion_waited;
  if (!(value >= 0 && value <= (single_block ? 1 : everything)) || value != std::floor(value))
    return AlarmNumber::variable_value;
  if (request_count_ == requests_.size()) return AlarmNumber::too_many_codes;
  requests_[request_count_++] = {VariableKind::suppression, number, value};
  return AlarmNumber::none;
}

// A word may be written with its highest signal as the sign, as Fanuc controls count it.
AlarmNumber ControlVariables::set_signal(std::uint32_t number, double value) {
  const bool word = canonical::is_macro_word(number);
  const double lowest = word ? -32768 : 0, highest = word ? 65535 : 1;
  if (!(value >= lowest && value <= highest) || value != std::floor(value))
    return AlarmNumber::variable_value;
  if (request_count_ == requests_.size()) return AlarmNumber::too_many_codes;
  requests_[request_count_++] = {VariableKind::macro_signal, number, value};
  return AlarmNumber::none;
}

Fault ControlVariables::carry_out(std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  for (std::size_t i = 0; i < request_count_; ++i) {
    const Request& request = requests_[i];
    Fault fault;
    if (request.kind == VariableKind::external) {
      fault = carry_out_external(request, program, line, out);
    } else if (is_spindle_order(request.kind) || request.kind == VariableKind::macro_signal) {
      fault = executor_.order_spindle(request.index, request.value, program, line, out);
    } else if (request.kind == VariableKind::message) {
      fault = executor_.message(static_cast<std::uint32_t>(request.value), program, line, out);
    } else if (request.kind == VariableKind::cycle) {
      fault = executor_.call_cycle(static_cast<std::uint32_t>(request.value), program, line, out);
      needs_answer_ = !fault;
    } else if (request.kind == VariableKind::suppression) {
      executor_.suppress(request.index == single_block_variable, static_cast<std::uint8_t>(request.value));
    } else if (request.kind == VariableKind::parts) {
      parts_ = request.value;
      fault = executor_.write_parts(request.value, program, line, out);
    } else if (is_work_offset(request.kind)) {
      const std::uint32_t axis = request.index % offsets_apart;
      fault = executor_.write_work_offset(work_offset_index(request.kind, request.index), axis,
                                          to_machine_units(axis, request.value), program, line, out);
    } else {
      fault = executor_.write_tool(table_of(request.kind), static_cast<std::uint16_t>(request.index + 1),
                                   to_machine_units(X, request.value) / tool_scale(request.kind), program,
                                   line, out);
    }
    if (fault) {
      request_count_ = 0;
      return fault;
    }
  }
  request_count_ = 0;
  return {};
}

}  // namespace trunnion::language
