// SPDX-License-Identifier: Apache-2.0
#include "language/control_variables.hpp"

#include <cmath>

#include "language/arithmetic.hpp"
#include "language/decimal.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double millimetres_per_inch = 25.4;
constexpr double highest_message = 9999;
constexpr std::uint32_t offsets_apart = 20;  // numbers from one work offset to the next
constexpr std::uint32_t basic_offsets = 6;   // G54 .. G59

bool is_work_offset(VariableKind kind) {
  return kind == VariableKind::work_offset || kind == VariableKind::extended_work_offset;
}

std::uint8_t work_offset_index(VariableKind kind, std::uint32_t index) {
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
  request_.reset();
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

AlarmNumber ControlVariables::read(const VariableRange& range, std::uint32_t index, Value& value) const {
  double result = 0;
  switch (range.kind) {
    case VariableKind::length:
    case VariableKind::length_wear:
    case VariableKind::radius:
    case VariableKind::radius_wear: {
      const auto tool = executor_.tables().tool(static_cast<std::uint16_t>(index + 1));
      value = Value{};
      if (!tool) return AlarmNumber::none;  // vacant, so that a program can ask
      result = in_program_units(X, range.kind == VariableKind::length        ? tool->length
                                   : range.kind == VariableKind::length_wear ? tool->length_wear
                                   : range.kind == VariableKind::radius      ? tool->radius.value_or(0)
                                                                             : tool->radius_wear);
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
    case VariableKind::block_end:
      result = in_program_units(index, executor_.program_position()[index]);
      break;
    case VariableKind::work_position:
      result = in_program_units(index, executor_.workpiece_position()[index]);
      break;
    case VariableKind::machine_position:
      result = in_program_units(index, executor_.machine_position()[index]);
      break;
    case VariableKind::skip_position:
      result = in_program_units(index, skip_position_[index]);
      break;
    case VariableKind::active_length:
      result = index == Z ? in_program_units(Z, executor_.modal().tool_length) : 0;
      break;
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
  request_ = Request{range.kind, index, value};
  return AlarmNumber::none;
}

Fault ControlVariables::carry_out(std::uint32_t program, std::uint32_t line, CommandQueue& out) {
  if (!request_) return {};
  const Request request = *request_;
  request_.reset();
  if (request.kind == VariableKind::message)
    return executor_.message(static_cast<std::uint32_t>(request.value), program, line, out);
  if (request.kind == VariableKind::cycle) {
    const auto fault = executor_.call_cycle(static_cast<std::uint32_t>(request.value), program, line, out);
    needs_answer_ = !fault;
    return fault;
  }
  if (is_work_offset(request.kind)) {
    const std::uint32_t axis = request.index % offsets_apart;
    return executor_.write_work_offset(work_offset_index(request.kind, request.index), axis,
                                       to_machine_units(axis, request.value), program, line, out);
  }
  return executor_.write_tool(table_of(request.kind), static_cast<std::uint16_t>(request.index + 1),
                              to_machine_units(X, request.value), program, line, out);
}

}  // namespace trunnion::language
