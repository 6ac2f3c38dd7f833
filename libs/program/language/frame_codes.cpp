// SPDX-License-Identifier: Apache-2.0
#include "language/frame_codes.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr double smallest_factor = 1e-3;
constexpr double largest_factor = 1e3;

}  // namespace

// As on Fanuc G54 P1 is G54.1 P1.
Fault FrameCodes::set_first_work_offset(std::uint16_t at) {
  return numbers_offset() ? set_additional_work_offset(at) : set_work_offset(at, 0);
}

bool FrameCodes::numbers_offset() const {
  constexpr std::uint32_t takers = group_bit(Group::one_block) | group_bit(Group::smoothing) |
                                   group_bit(Group::scaling) | group_bit(Group::rotation);
  const GCodes& g = words_.g();
  if (!words_.has('P') || (g.present() & takers) != 0) return false;
  if (g.is(Group::path_control, 640) || g.is(Group::motion, 62)) return false;
  const bool ends_cycle = g.is(Group::cycle, 800) || g.has(Group::motion);
  const bool cycle = (g.has(Group::cycle) || state_.modal.cycle != 80) && !ends_cycle;
  const MCodes& m = words_.m();
  for (std::size_t i = 0; i < m.count; ++i) {
    const MAction action = m.codes[i].action;
    if (action == MAction::call || action == MAction::go_back) return false;
  }
  return !cycle;
}

Fault FrameCodes::set_work_offset(std::uint16_t at, std::uint8_t index) {
  if (index == state_.modal.work_offset) return {};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  state_.modal.work_offset = index;
  state_.change_frame().set_work_offset(context_.tables.workpiece_zero(index));
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_additional_work_offset(std::uint16_t at) {
  if (words_.work_offset() != 0)
    return set_work_offset(at, static_cast<std::uint8_t>(5 + words_.work_offset()));
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  if (Fault fault = words_.whole_number('P', 1, work_offset_count - 6, number)) {
    if (fault.number == AlarmNumber::value_range) fault.detail = additional_work_offsets;
    return fault;
  }
  return set_work_offset(at, static_cast<std::uint8_t>(5 + number));
}

Fault FrameCodes::clear_scaling(std::uint16_t) {
  state_.modal.scaled = false;
  state_.change_frame().clear_scaling();
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_scaling(std::uint16_t at) {
  state_.modal.scaled = true;
  Vector3 centre{state_.program_position[X], state_.program_position[Y], state_.program_position[Z]};
  Vector3 factors{1, 1, 1};
  const bool each = (words_.letters() & letter_bits("IJK")) != 0;
  if (!each && !words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char letter = axis_letters[axis];
    if (words_.has(letter)) {
      words_.use(letter);
      centre[axis] = words_.axis(axis);
    }
    const char factor = each ? static_cast<char>('I' + axis) : 'P';
    if (!words_.has(factor)) continue;
    words_.use(factor);
    factors[axis] = words_.value(factor) * environment_.scaling_unit();
    const double size = std::abs(factors[axis]);
    if (size < smallest_factor || size > largest_factor) {
      return {AlarmNumber::factor_range, words_.offset(factor)};
    }
  }
  state_.change_frame().set_scaling(centre, factors);
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_mirror(std::uint16_t at, bool on) {
  if (!on && (words_.letters() & axis_bits) == 0) {
    state_.change_frame().clear_mirror();
  } else {
    std::uint32_t axes = 0;
    if (const Fault fault = words_.take_axes(at, axes)) return fault;
    for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
      if (((axes >> axis) & 1u) != 0) state_.change_frame().set_mirror(axis, on, words_.axis(axis));
    }
  }
  state_.modal.mirrored = state_.frame().mirrored();
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_rotation(std::uint16_t at) {
  const char angle = words_.has('R') ? 'R' : 'P';
  if (!words_.has(angle)) return {AlarmNumber::missing_word, at, "needs R"};
  words_.use(angle);
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  Vector3 centre{state_.program_position[X], state_.program_position[Y], state_.program_position[Z]};
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const char letter = axis_letters[axis];
    if (!words_.has(letter)) continue;
    words_.use(letter);
    centre[axis] = words_.axis(axis);
  }
  double degrees = words_.value(angle);
  if (!state_.modal.absolute && state_.modal.rotated) degrees += state_.frame().rotation();
  state_.change_frame().set_rotation(state_.modal.plane, centre, std::fmod(degrees, 360.0));
  state_.modal.rotated = true;
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_local_offset(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  ProgramFrame& frame = state_.change_frame();
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = words_.axis(axis);
    frame.set_local(axis, state_.modal.absolute ? word : frame.local()[axis] + word);
  }
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::shift_coordinates(std::uint16_t at) {
  if ((words_.letters() & axis_bits) == 0) {
    return words_.has('S') ? Fault{} : Fault{AlarmNumber::missing_word, at, "needs an axis or S"};
  }
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (!state_.frame().plain() || state_.modal.polar) return {AlarmNumber::frame_shift, at};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  ProgramFrame& frame = state_.change_frame();
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    frame.set_shift(axis, frame.shift()[axis] + state_.program_position[axis] - words_.axis(axis));
  }
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::clear_shift(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0 && words_.axis(axis) != 0)
      return {AlarmNumber::value_range, words_.offset(axis_letters[axis])};
  }
  ProgramFrame& frame = state_.change_frame();
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) {
    if (axes != 0 && ((axes >> axis) & 1u) == 0) continue;
    frame.set_local(axis, 0);
    frame.set_shift(axis, 0);
  }
  if (axes != 0) words_.use_axes();
  state_.locate(state_.position);
  return {};
}

Fault FrameCodes::set_setting_error(std::uint16_t at) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 0, setting_error_count, number)) return fault;
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (state_.modal.plane_only) return {AlarmNumber::tip_control_needed, at};
  const auto row = static_cast<std::uint8_t>(number);
  state_.set_setting_error(row, row == 0 ? AxisValues{} : context_.tables.setting_error(row));
  return {};
}

// X Y Z are one corner of the box and I J K the opposite one, machine coordinates.
Fault FrameCodes::set_zone(std::uint16_t at) {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  StrokeZone zone;
  zone.active = true;
  zone.outside = environment_.zone_forbids_outside();
  bool bounded = false;
  for (std::size_t axis = 0; axis < zone.low.size(); ++axis) {
    const char letter = axis_letters[axis], opposite = static_cast<char>('I' + axis);
    if (!words_.has(letter) && !words_.has(opposite)) continue;
    for (const char needed : {letter, opposite})
      if (!words_.has(needed)) return {AlarmNumber::missing_word, at, needs(needed)};
    const double a = words_.along(letter, axis), b = words_.along(opposite, axis);
    if (a == b) return {AlarmNumber::value_range, words_.offset(letter), "the zone has no extent"};
    zone.low[axis] = std::min(a, b);
    zone.high[axis] = std::max(a, b);
    zone.bounded[axis] = bounded = true;
  }
  if (!bounded) return {AlarmNumber::missing_word, at, "needs X I, Y J or Z K"};
  state_.change_frame().set_zone(zone);
  return {};
}

Fault FrameCodes::clear_zone(std::uint16_t) {
  if (state_.frame().zone().active) state_.change_frame().set_zone({});
  return {};
}

}  // namespace trunnion::language
