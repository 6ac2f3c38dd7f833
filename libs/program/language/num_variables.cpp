// SPDX-License-Identifier: Apache-2.0
// External parameters of the NUM dialect as a program reads and writes them.
#include <algorithm>
#include <cmath>

#include "language/control_variables.hpp"
#include "language/letters.hpp"
#include "language/num_parameters.hpp"

namespace trunnion::language {
namespace {

using canonical::SpindleValue;

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

}  // namespace

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
