// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_frames.hpp"

#include <cmath>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t last_system = 9;
constexpr std::uint8_t second_reference = 2;

/// X and Y turned by `degrees`, anticlockwise.
AxisValues turned_about_z(const AxisValues& point, double degrees) {
  if (degrees == 0) return point;
  const double cosine = std::cos(degrees / degrees_per_radian), sine = std::sin(degrees / degrees_per_radian);
  AxisValues turned = point;
  turned[X] = cosine * point[X] - sine * point[Y];
  turned[Y] = sine * point[X] + cosine * point[Y];
  return turned;
}

}  // namespace

Fault LinuxcncFrames::select(std::uint16_t at, std::uint8_t index) {
  if (const Fault fault = frames_.set_work_offset(at, index)) return fault;
  update();
  return {};
}

Fault LinuxcncFrames::begin_shift(std::uint16_t at, std::uint32_t& axes, LinuxcncFrame& frame) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  frame = state_.settings().linuxcnc;
  if (!frame.shifted) frame.shift = {};
  frame.shifted = true;
  return {};
}

Fault LinuxcncFrames::put_shift(const LinuxcncFrame& frame) {
  state_.change_settings().linuxcnc = frame;
  update();
  return {};
}

Fault LinuxcncFrames::set_local(std::uint16_t at) {
  std::uint32_t axes = 0;
  LinuxcncFrame frame;
  if (const Fault fault = begin_shift(at, axes, frame)) return fault;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0) frame.shift[axis] = words_.axis(axis);
  return put_shift(frame);
}

// The position gets the coordinates of the words, in G91, too.
Fault LinuxcncFrames::shift(std::uint16_t at) {
  std::uint32_t axes = 0;
  LinuxcncFrame frame;
  if (const Fault fault = begin_shift(at, axes, frame)) return fault;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0) frame.shift[axis] += state_.program_position[axis] - words_.axis(axis);
  return put_shift(frame);
}

Fault LinuxcncFrames::clear_shift(std::uint16_t at) {
  if (const Fault fault = suspend_shift(at)) return fault;
  state_.change_settings().linuxcnc.shift = {};
  return {};
}

Fault LinuxcncFrames::suspend_shift(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  state_.change_settings().linuxcnc.shifted = false;
  update();
  return {};
}

// LinuxCNC would take what another program has left; here there is nothing of it.
Fault LinuxcncFrames::resume_shift(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  LinuxcncFrame& frame = state_.change_settings().linuxcnc;
  if (frame.shift == AxisValues{}) return {AlarmNumber::linuxcnc_shift_missing, at};
  frame.shifted = true;
  update();
  return {};
}

void LinuxcncFrames::update() {
  ModalState& modal = state_.modal;
  const LinuxcncFrame own = state_.settings().linuxcnc;
  const double degrees = modal.work_offset < own.rotations.size() ? own.rotations[modal.work_offset] : 0;
  ProgramFrame& frame = state_.change_frame();
  const AxisValues shift = own.shifted ? turned_about_z(own.shift, degrees) : AxisValues{};
  for (std::uint8_t axis = 0; axis < axis_count; ++axis) frame.set_shift(axis, shift[axis]);
  modal.rotated = degrees != 0;
  if (modal.rotated)
    frame.set_rotation(Plane::xy, {}, degrees);
  else
    frame.clear_rotation();
  state_.locate(state_.position);
}

Fault LinuxcncFrames::read_system(std::uint16_t at, std::uint8_t& index) {
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t number = 0;
  if (const Fault fault = words_.whole_number('P', 0, last_system, number)) return fault;
  index = number == 0 ? state_.modal.work_offset : static_cast<std::uint8_t>(number - 1);
  return index == state_.modal.work_offset ? output_.refuse_in_compensation(at) : Fault{};
}

// Tables hold radii, so a diameter means nothing here; nor does G91.
Fault LinuxcncFrames::set_offset(std::uint16_t at) {
  std::uint8_t index = 0;
  if (const Fault fault = read_system(at, index)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  AxisValues values = context_.tables.work_offset(index);
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0)
      values[axis] = words_.value(axis_letters[axis]) * (is_rotary(axis) ? 1.0 : words_.length_scale());
  if (words_.has('R')) {
    words_.use('R');
    LinuxcncFrame& frame = state_.change_settings().linuxcnc;
    if (index < frame.rotations.size()) frame.rotations[index] = std::fmod(words_.value('R'), 360.0);
  }
  if (axes != 0) tables_.store_work_offset(index, values);
  update();
  return {};
}

// The position would have the coordinates of the words in that system, and keep its others.
Fault LinuxcncFrames::set_place(std::uint16_t at) {
  std::uint8_t index = 0;
  if (const Fault fault = read_system(at, index)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  const LinuxcncFrame own = state_.settings().linuxcnc;
  const double degrees = index < own.rotations.size() ? own.rotations[index] : 0;
  const AxisValues shift = own.shifted ? own.shift : AxisValues{};
  const AxisValues offset = context_.tables.work_offset(index);
  const AxisValues zero = context_.tables.workpiece_zero(index);
  // Without the tool length, which is no part of the systems.
  const AxisValues contour = state_.frame().contour_from_program(state_.program_position);
  AxisValues machine = state_.frame().command_from_contour(contour);
  AxisValues place{};
  for (std::size_t axis = 0; axis < axis_count; ++axis) place[axis] = machine[axis] - zero[axis];
  place = turned_about_z(place, -degrees);
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    place[axis] -= shift[axis];
    if (((axes >> axis) & 1u) != 0) place[axis] = words_.axis(axis);
    place[axis] += shift[axis];
  }
  place = turned_about_z(place, degrees);
  AxisValues values = offset;
  // The others stay bit for bit, but for the second of two that turn.
  const bool turns = degrees != 0 && (axes & 3u) != 0;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0 || (turns && axis <= Y))
      values[axis] = machine[axis] - place[axis] - (zero[axis] - offset[axis]);
  tables_.store_work_offset(index, values);
  update();
  return {};
}

Fault LinuxcncFrames::go_to_first(std::uint16_t at) { return go_to(at, environment_.reference_position()); }

Fault LinuxcncFrames::go_to_second(std::uint16_t at) {
  const auto reference = environment_.numbered_reference(second_reference);
  return reference ? go_to(at, *reference) : Fault{AlarmNumber::reference_undefined, at};
}

// Without words all axes go straight there, else those that are named over the point given.
Fault LinuxcncFrames::go_to(std::uint16_t at, const AxisValues& reference) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  if (axes != 0) {
    const AxisValues over = programmed_target(axes);
    if (const Fault fault = output_.move_straight({CommandKind::rapid}, over)) return fault;
  } else {
    axes = environment_.axes();
  }
  AxisValues target = state_.position;
  for (std::size_t axis = 0; axis < axis_count; ++axis)
    if (((axes >> axis) & 1u) != 0) target[axis] = absolute_target(axis, reference[axis], target[axis]);
  return output_.move_straight_in_command_frame(CommandKind::rapid, target);
}

Fault LinuxcncFrames::check_end(std::uint16_t at) const {
  for (const double degrees : state_.settings().linuxcnc.rotations)
    if (degrees != 0) return {AlarmNumber::linuxcnc_rotation, at};
  return {};
}

}  // namespace trunnion::language
