// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_tools.hpp"

#include <cmath>

namespace trunnion::language {
namespace {

constexpr std::uint8_t fixture_system = 8;  // G59.3, as ModalState::work_offset

}  // namespace

Fault LinuxcncTools::check_side(std::uint16_t at) const {
  if (state_.modal.plane == Plane::yz)
    return {AlarmNumber::linuxcnc_function_missing, at, "cutter compensation in G19"};
  return output_.compensating() ? Fault{AlarmNumber::compensation_active, at, "G40 first"} : Fault{};
}

Fault LinuxcncTools::set_side(std::uint16_t at, CutterSide side) {
  if (const Fault fault = check_side(at)) return fault;
  std::uint32_t number = 0;
  if (words_.has('D')) {
    if (const Fault fault = words_.whole_number('D', 0, highest_tool, number)) return fault;
    at = words_.offset('D');
  }
  return tools_.compensate_with(at, side,
                                number != 0 ? static_cast<std::uint16_t>(number) : state_.modal.tool);
}

Fault LinuxcncTools::set_diameter_side(std::uint16_t at, CutterSide side) {
  if (const Fault fault = check_side(at)) return fault;
  if (!words_.has('D')) return {AlarmNumber::missing_word, at, needs('D')};
  if (words_.has('L')) {
    std::uint32_t orientation = 0;
    if (const Fault fault = words_.whole_number('L', 0, 9, orientation)) return fault;
    if (orientation != 0)
      return {AlarmNumber::linuxcnc_function_missing, words_.offset('L'), "orientation of a lathe tool"};
  }
  tools_.compensate_by(side, words_.length('D') / 2);
  return {};
}

Fault LinuxcncTools::length_of(std::uint16_t at, std::uint32_t number, double& length) const {
  length = 0;
  if (number == 0) return {};
  const auto tool = context_.tables.tool(static_cast<std::uint16_t>(number));
  if (!tool) return {AlarmNumber::tool_length_unknown, at};
  length = tool->length + tool->length_wear;
  return {};
}

Fault LinuxcncTools::set_length(std::uint16_t at) {
  std::uint32_t number = 0;
  if (words_.has('H')) {
    at = words_.offset('H');
    if (const Fault fault = words_.whole_number('H', 0, highest_tool, number)) return fault;
  }
  if (number == 0) number = state_.modal.tool;
  double length = 0;
  if (const Fault fault = length_of(at, number, length)) return fault;
  return tools_.put_length(at, static_cast<std::uint16_t>(number), length);
}

Fault LinuxcncTools::length_by_words(std::uint16_t at, double& length) {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0 && axis != Z && words_.axis(axis) != 0)
      return {AlarmNumber::linuxcnc_function_missing, words_.offset(axis_letters[axis]),
              "tool offsets beside Z"};
  length = ((axes >> Z) & 1u) != 0 ? words_.axis(Z) : 0;
  return {};
}

Fault LinuxcncTools::set_length_by_words(std::uint16_t at) {
  double length = 0;
  if (const Fault fault = length_by_words(at, length)) return fault;
  return tools_.put_length(at, 0, words_.has('Z') ? length : state_.modal.tool_length);
}

Fault LinuxcncTools::add_length(std::uint16_t at) {
  double length = 0;
  if (words_.has('H')) {
    std::uint32_t number = 0;
    if (const Fault fault = words_.whole_number('H', 1, highest_tool, number)) return fault;
    if (const Fault fault = length_of(words_.offset('H'), number, length)) return fault;
  } else if (const Fault fault = length_by_words(at, length)) {
    return fault;
  }
  const ModalState& modal = state_.modal;
  return tools_.put_length(at, modal.length_offset, modal.tool_length + length);
}

Fault LinuxcncTools::change_table(std::uint16_t at) {
  if (!words_.has('L')) return {AlarmNumber::missing_word, at, needs('L')};
  std::uint32_t l = 0;
  if (const Fault fault = words_.whole_number('L', 0, 20, l)) return fault;
  switch (l) {
    case 1:
    case 10:
    case 11:
      return change_tool(at, l);
    case 2:
      return frames_.set_offset(at);
    case 20:
      return frames_.set_place(at);
    case 0:
      return {AlarmNumber::linuxcnc_function_missing, at, "G10 L0: the tool table is always current"};
    default:
      return {AlarmNumber::value_range, words_.offset('L')};
  }
}

// L10 and L11: Z gets the coordinate of the word when the tool is used, in the active system or in G59.3
// without a shift. Wear stays as it is, so the length takes the rest.
Fault LinuxcncTools::change_tool(std::uint16_t at, std::uint32_t l) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 1, highest_tool, number)) return fault;
  const auto tool = context_.tables.tool(static_cast<std::uint16_t>(number));
  if (!tool) return {AlarmNumber::tool_undefined, words_.offset('P')};
  const bool axes = (words_.letters() & axis_bits) != 0;
  double z = 0;
  if (axes) {
    if (const Fault fault = length_by_words(at, z)) return fault;
  }
  const auto entry = static_cast<std::uint16_t>(number);
  if (words_.has('Z')) {
    const double offset = l == 10   ? state_.frame().total_offset()[Z]
                          : l == 11 ? context_.tables.workpiece_zero(fixture_system)[Z]
                                    : 0;
    const double length = l == 1 ? z : state_.position[Z] - offset - z;
    if (const Fault fault = tables_.set_tool(Table::tool_length, entry, length - tool->length_wear, at))
      return fault;
  }
  if (!words_.has('R')) return {};
  const double wear = environment_.cutter_settings().wear_sign * tool->radius_wear;
  return tables_.set_tool(Table::tool_radius, entry, words_.length('R') - wear, at);
}

}  // namespace trunnion::language
