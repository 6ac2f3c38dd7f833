#include "language/control_variables.hpp"

#include <cmath>

#include "language/expression.hpp"

namespace trunnion::language {
namespace {

constexpr double millimetres_per_inch = 25.4;
constexpr double highest_message = 9999;

constexpr bool is_rotary(std::uint32_t axis) { return axis == A || axis == B || axis == C; }

}  // namespace

void ControlVariables::start() {
  milliseconds_zero_ = hours_zero_ = 0;
  sequence_number_ = 0;
  program_number_ = 0;
  modal_macro_ = false;
  message_waits_ = false;
}

double ControlVariables::in_program_units(std::uint32_t axis, double value) const {
  return executor_.modal().metric || is_rotary(axis) ? value : value / millimetres_per_inch;
}

AxisValues ControlVariables::work_position() const {
  const ModalState& modal = executor_.modal();
  const AxisValues offset = environment_.work_offset(modal.work_offset);
  AxisValues position = executor_.position();
  for (std::size_t axis = 0; axis < axis_count; ++axis) position[axis] -= offset[axis];
  if (modal.transformation == Transformation::none) position[Z] -= modal.tool_length;
  return position;
}

AlarmNumber ControlVariables::modal(std::uint32_t number, double& result) const {
  const ModalState& modal = executor_.modal();
  const double inch = modal.metric ? 1 : millimetres_per_inch;
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
    case 4008:
      result = modal.transformation == Transformation::rtcp ? 43.4 : modal.length_offset != 0 ? 43 : 49;
      break;
    case 4012:
      result = modal_macro_ ? 66 : 67;
      break;
    case 4014:
      result = 54 + modal.work_offset;
      break;
    case 4015:
      result = modal.path_control == PathControl::exact_stop ? 61 : 64;
      break;
    case 4109:
      result = modal.feed_mode == FeedMode::inverse_time ? modal.feed : modal.feed / inch;
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
      result = modal.spindle_speed;
      break;
    case 4120:
      result = modal.selected_tool;
      break;
    default:
      return AlarmNumber::variable_unknown;
  }
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::read(const VariableRange& range, std::uint32_t index, Value& value) const {
  double result = 0;
  switch (range.kind) {
    case VariableKind::length: {
      const auto length = environment_.tool_length(static_cast<std::uint16_t>(index + 1));
      if (!length) return AlarmNumber::tool_length_unknown;
      result = in_program_units(Z, *length);
      break;
    }
    case VariableKind::time_milliseconds:
      result = time_.milliseconds - milliseconds_zero_;
      break;
    case VariableKind::time_hours:
      result = time_.hours - hours_zero_;
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
    case VariableKind::work_position:
      result = in_program_units(index, work_position()[index]);
      break;
    case VariableKind::machine_position: {
      const ModalState& modal = executor_.modal();
      const AxisValues position = modal.transformation == Transformation::rtcp
                                      ? environment_.machine_from_tip(executor_.position(), modal.tool_length)
                                      : executor_.position();
      result = in_program_units(index, position[index]);
      break;
    }
    case VariableKind::active_length:
      result = index == Z ? in_program_units(Z, executor_.modal().tool_length) : 0;
      break;
    case VariableKind::work_offset:
      if (index % 20 >= axis_count) return AlarmNumber::variable_unknown;
      result = in_program_units(index % 20,
                                environment_.work_offset(static_cast<std::uint8_t>(index / 20))[index % 20]);
      break;
    default:
      return AlarmNumber::variable_unknown;
  }
  value = Value::of(result);
  return AlarmNumber::none;
}

AlarmNumber ControlVariables::write(const VariableRange& range, std::uint32_t, Value value) {
  switch (range.kind) {
    case VariableKind::alarm:
      return AlarmNumber::program_alarm;
    case VariableKind::message: {
      const double number = nearly_whole(value.number);
      if (!(number >= 0 && number <= highest_message)) return AlarmNumber::variable_value;
      message_waits_ = true;
      message_ = static_cast<std::uint32_t>(number);
      return AlarmNumber::none;
    }
    case VariableKind::time_milliseconds:
      milliseconds_zero_ = time_.milliseconds - value.number;
      return AlarmNumber::none;
    case VariableKind::time_hours:
      hours_zero_ = time_.hours - value.number;
      return AlarmNumber::none;
    default:
      return AlarmNumber::variable_read_only;
  }
}

bool ControlVariables::take_message(std::uint32_t& number) {
  const bool waits = message_waits_;
  message_waits_ = false;
  number = message_;
  return waits;
}

}  // namespace trunnion::language
