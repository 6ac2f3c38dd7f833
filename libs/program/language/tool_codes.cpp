// SPDX-License-Identifier: Apache-2.0
#include "language/tool_codes.hpp"

#include <cstdio>

namespace trunnion::language {

Fault ToolCodes::set_length(std::uint16_t at, LengthUse use) {
  Length length;
  length.off = use == LengthUse::off;
  length.vector = use == LengthUse::vector;
  length.subtract = use == LengthUse::subtracted;
  const bool tip = use == LengthUse::tip || use == LengthUse::vector;
  length.plane_only = state_.modal.plane_only && !tip;
  length.transformation = tip || length.plane_only ? Transformation::rtcp : Transformation::none;
  if (state_.modal.tilt.active && !tip && !length.plane_only) return {AlarmNumber::tilt_active, at};
  return choose_length(at, length);
}

// H alone exchanges the length that counts; H0 takes it away, and without one there is nothing to take.
Fault ToolCodes::length_word() {
  if (!words_.has('H') || words_.linuxcnc()) return {};
  const ModalState& modal = state_.modal;
  const bool on = modal.tip_control() || modal.length_offset != 0;
  if (!on && words_.value('H') != 0) return {};
  return choose_length(words_.offset('H'), {modal.transformation, modal.plane_only, modal.tool_vector,
                                            modal.tool_length < 0, false});
}

Fault ToolCodes::choose_length(std::uint16_t at, const Length& use) {
  std::uint32_t h = 0;
  double length = 0;
  if (use.off) {
    if (words_.has('H') && words_.value('H') == 0) words_.use('H');
  } else {
    if (const Fault fault = length_entry(at, h)) return fault;
    if (h != 0) {
      const auto tool = context_.tables.tool(static_cast<std::uint16_t>(h));
      if (!tool) return {AlarmNumber::tool_length_unknown, words_.has('H') ? words_.offset('H') : at};
      length = tool->length + tool->length_wear;
      if (use.subtract) length = -length;
    }
  }
  return use_length(at, use, static_cast<std::uint16_t>(h), length);
}

Fault ToolCodes::put_length(std::uint16_t at, std::uint16_t number, double length) {
  return use_length(at, {}, number, length);
}

Fault ToolCodes::use_length(std::uint16_t at, const Length& use, std::uint16_t number, double length) {
  ModalState& modal = state_.modal;
  const bool same = use.transformation == modal.transformation && use.plane_only == modal.plane_only &&
                    number == modal.length_offset && length == modal.tool_length &&
                    use.vector == modal.tool_vector;
  if (same) return {};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  // The machine is at rest while the coordinates it is described in change.
  AxisValues position = state_.machine_position(environment_);
  if (use.transformation == Transformation::rtcp) position = environment_.tip_from_machine(position, length);
  modal.transformation = use.transformation;
  modal.plane_only = use.plane_only;
  modal.tool_vector = use.vector;
  modal.length_offset = number;
  modal.tool_length = length;
  state_.locate(position);
  output_.push(CommandKind::transformation);
  return {};
}

// Without H the last one holds, as on Fanuc, while it can only be meant for the tool in the spindle.
Fault ToolCodes::length_entry(std::uint16_t at, std::uint32_t& h) {
  if (words_.has('H')) {
    if (const Fault fault = words_.whole_number('H', 0, highest_tool, h)) return fault;
    state_.length_given = true;
    state_.length_entry = static_cast<std::uint16_t>(h);
    state_.length_tool = state_.modal.tool;
    return {};
  }
  if (!state_.length_given) return {AlarmNumber::missing_word, at, needs('H')};
  h = state_.length_entry;
  if (state_.length_tool == state_.modal.tool) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::length_of_another_tool;
  std::snprintf(detail.text.data(), detail.text.size(), "H%u was for T%u, T%u is in the spindle",
                unsigned{state_.length_entry}, unsigned{state_.length_tool}, unsigned{state_.modal.tool});
  return {detail.number, at};
}

Fault ToolCodes::set_cutter_side(std::uint16_t at, CutterSide side) {
  std::uint32_t d = 0;
  if (words_.has('D')) {
    if (const Fault fault = words_.whole_number('D', 0, highest_tool, d)) return fault;
    state_.modal.radius_offset = static_cast<std::uint16_t>(d);
    at = words_.offset('D');
  }
  state_.modal.cutter_side = side;
  return compensate(at, true);
}

Fault ToolCodes::compensate_with(std::uint16_t at, CutterSide side, std::uint16_t number) {
  state_.modal.radius_offset = number;
  state_.modal.cutter_side = side;
  return compensate(at, true);
}

void ToolCodes::compensate_by(CutterSide side, double radius) {
  ModalState& modal = state_.modal;
  modal.radius_offset = 0;
  modal.cutter_side = side;
  output_.compensation().request(side, radius, modal.plane,
                                 state_.frame().contour_from_program(state_.program_position));
}

Fault ToolCodes::radius_word() {
  if (!words_.has('D') || words_.linuxcnc()) return {};
  std::uint32_t d = 0;
  if (const Fault fault = words_.whole_number('D', 0, highest_tool, d)) return fault;
  state_.modal.radius_offset = static_cast<std::uint16_t>(d);
  return compensate(words_.offset('D'), false);
}

std::optional<double> ToolCodes::cutter_radius() const {
  if (state_.modal.radius_offset == 0) return 0.0;
  const auto tool = context_.tables.tool(state_.modal.radius_offset);
  if (!tool || !tool->radius) return std::nullopt;
  return *tool->radius + environment_.cutter_settings().wear_sign * tool->radius_wear;
}

Fault ToolCodes::compensate(std::uint16_t at, bool named) {
  const ModalState& modal = state_.modal;
  double radius = 0;
  if (modal.cutter_side != CutterSide::off) {
    const auto found = cutter_radius();
    if (!found) return {AlarmNumber::radius_undefined, at};
    radius = *found;
  }
  if (modal.cutter_side == CutterSide::off && !output_.compensating()) return {};
  const AxisValues here = state_.frame().contour_from_program(state_.program_position);
  const bool ends = modal.cutter_side == CutterSide::off && named;
  output_.compensation().request(modal.cutter_side, radius, modal.plane, here);
  if (ends && modal.motion <= 1 && !modal.tool_vector) read_wall(here);
  return {};
}

// I J K of G40: the direction in which the contour would continue.
void ToolCodes::read_wall(const AxisValues& here) {
  AxisValues ahead = state_.program_position;
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  for (const std::uint8_t axis : {plane.first, plane.second})
    ahead[axis] += words_.length(static_cast<char>('I' + axis));
  const AxisValues there = state_.frame().contour_from_program(ahead);
  output_.compensation().leave_along(
      {there[plane.first] - here[plane.first], there[plane.second] - here[plane.second]});
}

}  // namespace trunnion::language
