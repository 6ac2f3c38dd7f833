// SPDX-License-Identifier: Apache-2.0
#include "language/control_variables.hpp"

#include <cmath>

#include "language/arithmetic.hpp"
#include "language/decimal.hpp"
#include "language/letters.hpp"
#include "language/num_parameters.hpp"

namespace trunnion::language {
namespace {

constexpr double millimetres_per_inch = 25.4;
constexpr double highest_message = 9999;
constexpr std::uint32_t offsets_apart = 20;  // numbers from one work offset to the next
constexpr std::uint32_t basic_offsets = 6;   // G54 .. G59

using canonical::SpindleValue;

constexpr double largest_added_angle = 360;        // deg, of EC
constexpr std::uint32_t spindle_variables = 4801;  // of the first value; those of the next are 10 behind
constexpr std::uint32_t values_apart = 10;
constexpr std::uint32_t num_spindles = 4;       // B1 to B4
constexpr std::uint32_t speed_control = 91024;  // E91024, of B1
constexpr std::uint32_t unhomed_axis = 91100;   // E91100, of X
constexpr double parts_of_turn = 65536;         // unit of E90310 and E95224
constexpr double steps_of_turn = 100000;        // unit of E90100

constexpr std::array spindle_names = {"spindle 1", "spindle 2", "spindle 3", "spindle 4",
                                      "spindle 5", "spindle 6", "spindle 7", "spindle 8"};

/// External parameters that the drive knows, first to first + 3.
struct LiveParameter {
  std::uint32_t first;
  SpindleValue value;
};
constexpr std::array live_parameters = {
    LiveParameter{90100, SpindleValue::angle},        LiveParameter{90124, SpindleValue::positioned},
    LiveParameter{90200, SpindleValue::reference},    LiveParameter{91124, SpindleValue::homed},
    LiveParameter{93524, SpindleValue::synchronized}, LiveParameter{94124, SpindleValue::master},
    LiveParameter{95224, SpindleValue::error},
};

bool of_spindles(std::uint32_t number, std::uint32_t first) {
  return number >= first && number - first < num_spindles;
}

/// A value of a spindle in the unit of its external parameter.
double external_unit(SpindleValue value, double result) {
  switch (value) {
    case SpindleValue::homed:
      return 1 - result;
    case SpindleValue::master:
      return result == 0 ? -1 : canonical::master_address + result - 1;
    case SpindleValue::error:
      return std::round(result * parts_of_turn / 360);
    case SpindleValue::angle:
      return std::floor(result * steps_of_turn / 360);
    case SpindleValue::reference:
    case SpindleValue::synchronized:
    case SpindleValue::positioned:
      break;
  }
  return result;
}

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
AlarmNumber ControlVariables::spindle_value(SpindleValue value, std::uint32_t spindle, double& result) const {
  if (values_read_ < values_) {
    result = value_[values_read_++];
    return AlarmNumber::none;
  }
  if (values_ == value_.size()) return AlarmNumber::too_many_codes;
  wanted_ = canonical::read_number(value, spindle);
  return value_pending;
}

AlarmNumber ControlVariables::live_parameter(std::uint32_t number, double& value) const {
  for (const LiveParameter& live : live_parameters) {
    if (!of_spindles(number, live.first)) continue;
    const AlarmNumber alarm = spindle_value(live.value, number - live.first, value);
    if (alarm == AlarmNumber::none) value = external_unit(live.value, value);
    return alarm;
  }
  return AlarmNumber::num_parameter_unavailable;
}

// An axis that the channel does not have would be waited for without end.
AlarmNumber ControlVariables::not_homed(std::uint32_t address, double& value) const {
  const auto axis = static_cast<std::uint32_t>(axis_letters.find(addressed_axes[address]));
  if (((environment_.axes() >> axis) & 1u) == 0) return AlarmNumber::num_parameter_unavailable;
  const AlarmNumber alarm = homed(axis, value);
  value = 1 - value;
  return alarm;
}

// What the program has written is read again, although the machine takes some of it at a reset only.
AlarmNumber ControlVariables::read_external(std::uint32_t number, double& value) const {
  if (number >= unhomed_axis && number - unhomed_axis < addressed_axes.size())
    return not_homed(number - unhomed_axis, value);
  const AlarmNumber alarm = live_parameter(number, value);
  if (alarm != AlarmNumber::num_parameter_unavailable) return alarm;
  for (std::size_t i = request_count_; i-- > 0;) {
    if (requests_[i].kind != VariableKind::external || requests_[i].index != number) continue;
    value = requests_[i].value;
    return AlarmNumber::none;
  }
  for (std::size_t i = 0; i < programmed_count_; ++i) {
    if (programmed_[i].number != number) continue;
    value = programmed_[i].value;
    return AlarmNumber::none;
  }
  if (number >= speed_control && number - speed_control < num_spindles) {
    value = 0;
    return AlarmNumber::none;
  }
  const auto machine = environment_.external_parameter(number);
  if (!machine) return alarm;
  value = *machine;
  return AlarmNumber::none;
}

// Both have passed their index marks.
Fault ControlVariables::check_master(std::uint32_t slave, double address) const {
  if (address == -1) return {};
  const double master = address - canonical::master_address;
  if (!(master >= 0 && master < canonical::most_spindles) || master != std::floor(master) || master == slave)
    return {AlarmNumber::variable_value, 0, "another spindle"};
  for (const std::uint32_t spindle : {static_cast<std::uint32_t>(master), slave}) {
    double homed = 0;
    const AlarmNumber alarm = spindle_value(SpindleValue::homed, spindle, homed);
    if (alarm != AlarmNumber::none) return {alarm, 0};
    if (homed != 0) continue;
    unmarked_ = spindle_names[spindle];
    return {AlarmNumber::spindle_without_mark, 0};
  }
  return {};
}

Fault ControlVariables::write_external(std::uint32_t number, double value) {
  if (number == canonical::order_angle) {
    if (std::abs(value) > largest_added_angle)
      return {AlarmNumber::value_range, 0, "the angle is -360 to 360 deg"};
  } else if (of_spindles(number, speed_control)) {
    return value == 0 ? Fault{} : Fault{AlarmNumber::variable_value, 0, "0: speed control"};
  } else if (of_spindles(number, canonical::order_master)) {
    if (const Fault fault = check_master(number - canonical::order_master, value)) return fault;
  } else if (of_spindles(number, canonical::order_integral)) {
    if (!environment_.external_parameter(number)) return {AlarmNumber::num_parameter_unavailable, 0};
  } else if (environment_.external_changes(number, value).count == 0) {
    return {AlarmNumber::num_parameter_unavailable, 0};
  }
  if (request_count_ == requests_.size()) return {AlarmNumber::too_many_codes, 0};
  requests_[request_count_++] = {VariableKind::external, number, value};
  return {};
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

AlarmNumber ControlVariables::read(const VariableRange& range, std::uint32_t index, Value& value) const {
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
    case VariableKind::modal:
      if (const AlarmNumber alarm = modal(range.first + index, result); alarm != AlarmNumber::none)
        return alarm;
      break;
    case VariableKind::cutter_radius:
      if (!executor_.cutter_radius()) return AlarmNumber::none;
      result = in_program_units(X, *executor_.cutter_radius());
      break;
    case VariableKind::homed:
      if (const AlarmNumber alarm = homed(index, result); alarm != AlarmNumber::none) return alarm;
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
  switch (range.kind) {
    case VariableKind::alarm:
      return AlarmNumber::program_alarm;
    case VariableKind::message:
    case VariableKind::cycle:
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
    default:
      return ask(range, index, value.number);
  }
}

AlarmNumber ControlVariables::ask(const VariableRange& range, std::uint32_t index, double value) {
  const bool message = range.kind == VariableKind::message || range.kind == VariableKind::cycle;
  const double lowest = message || range.kind == VariableKind::radius ? 0 : -largest_number;
  if (!(value >= lowest && value <= (message ? highest_message : largest_number)))
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

Fault ControlVariables::carry_out(std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  for (std::size_t i = 0; i < request_count_; ++i) {
    const Request& request = requests_[i];
    Fault fault;
    if (request.kind == VariableKind::external) {
      fault = carry_out_external(request, program, line, out);
    } else if (is_spindle_order(request.kind)) {
      fault = executor_.order_spindle(request.index, request.value, program, line, out);
    } else if (request.kind == VariableKind::message) {
      fault = executor_.message(static_cast<std::uint32_t>(request.value), program, line, out);
    } else if (request.kind == VariableKind::cycle) {
      fault = executor_.call_cycle(static_cast<std::uint32_t>(request.value), program, line, out);
      needs_answer_ = !fault;
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

// The integral action is an order for the PLC, and its time a parameter: written when the program gives
// another one than before.
Fault ControlVariables::carry_out_external(const Request& request, std::uint32_t program, std::uint32_t line,
                                           CommandQueue& out) {
  const bool integral = of_spindles(request.index, canonical::order_integral);
  const bool of_plc = integral || request.index == canonical::order_angle ||
                      of_spindles(request.index, canonical::order_master);
  Programmed* before = nullptr;
  for (std::size_t i = 0; i < programmed_count_; ++i)
    if (programmed_[i].number == request.index) before = &programmed_[i];
  ParameterChanges changes;
  const bool same_time = before != nullptr && std::abs(before->value) == std::abs(request.value);
  if (!integral)
    changes = environment_.external_changes(request.index, request.value);
  else if (request.value != 0 && !same_time)
    changes = environment_.external_changes(request.index, std::abs(request.value));
  for (std::size_t i = 0; i < changes.count; ++i) {
    if (const Fault fault =
            executor_.write_parameter(changes.list[i].number, changes.list[i].value, program, line, out))
      return fault;
  }
  if (of_plc) {
    if (const Fault fault = executor_.order_spindle(request.index, request.value, program, line, out))
      return fault;
  }
  if (before != nullptr)
    before->value = request.value;
  else if (programmed_count_ < programmed_.size())
    programmed_[programmed_count_++] = {request.index, request.value};
  return {};
}

}  // namespace trunnion::language
