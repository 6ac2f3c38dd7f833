// SPDX-License-Identifier: Apache-2.0
#include "language/tilted_planes.hpp"

#include <cmath>

#include "language/rotation_matrix.hpp"
#include "language/tool_vector_motion.hpp"

namespace trunnion::language {
namespace {

constexpr double no_length = 1e-9;                                  // mm
constexpr std::uint8_t prefers_positive = 3, prefers_negative = 4;  // P

Vector3 difference(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double norm(const Vector3& a) { return std::hypot(a[0], a[1], a[2]); }
Vector3 product(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 divided(const Vector3& a, double by) { return {a[0] / by, a[1] / by, a[2] / by}; }

/// Origin, a point on +X, a point with positive Y. False when they lie on a line.
bool tilt_from_points(const std::array<Vector3, 3>& points, Tilt& tilt) {
  const Vector3 along = difference(points[1], points[0]);
  if (!(norm(along) > no_length)) return false;
  const Vector3 x = divided(along, norm(along));
  const Vector3 across = product(x, difference(points[2], points[0]));
  if (!(norm(across) > no_length)) return false;
  const Vector3 z = divided(across, norm(across));
  const Vector3 y = product(z, x);
  tilt.origin = points[0];
  tilt.matrix = {x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]};
  return true;
}

}  // namespace

Fault TiltedPlanes::check() const {
  const GCodes& g = words_.g();
  const bool swing =
      g.is(Group::one_block, 531) || g.is(Group::one_block, 532) || g.is(Group::one_block, 536);
  const bool tilts_further = g.is(Group::rotation, 684);
  if (state_.swing_due && !(swing && words_.single_code()) && !tilts_further) {
    return {AlarmNumber::tilt_swing_missing, words_.first_offset()};
  }
  if (swing && !state_.swing_due) return {AlarmNumber::tilt_swing_misplaced, g.offset(Group::one_block)};
  return {};
}

Fault TiltedPlanes::tilt_to_stored_plane(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (!words_.has('Q')) return {AlarmNumber::missing_word, at, needs('Q')};
  std::uint32_t index = 0;
  if (const Fault fault = words_.whole_number('Q', 1, 20, index)) return fault;
  const auto points = environment_.plane_points(static_cast<std::uint8_t>(index));
  Tilt tilt;
  if (!points || !tilt_from_points(*points, tilt)) return {AlarmNumber::tilt_points, words_.offset('Q')};
  return apply(tilt);
}

Fault TiltedPlanes::tilt_by_angles(std::uint16_t at, bool turned_axes) {
  Tilt tilt;
  bool by_p = false;
  if (const Fault fault = read_angles(at, turned_axes, tilt, by_p)) return fault;
  return apply(tilt, by_p);
}

Fault TiltedPlanes::tilt_in_plane(std::uint16_t at) {
  const Tilt& plane = state_.modal.tilt;
  if (!plane.active) return {AlarmNumber::tilt_missing, at};
  Tilt tilt;
  bool by_p = false;
  if (const Fault fault = read_angles(at, true, tilt, by_p)) return fault;
  const Vector3 origin = state_.frame().turned_by_tilt(tilt.origin);
  for (std::size_t i = 0; i < origin.size(); ++i) tilt.origin[i] = plane.origin[i] + origin[i];
  tilt.matrix = multiplied(plane.matrix, tilt.matrix);
  return apply(tilt, by_p);
}

Fault TiltedPlanes::read_angles(std::uint16_t at, bool turned_axes, Tilt& tilt, bool& by_p) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'K'}) {
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
    words_.use(letter);
  }
  by_p = turned_axes && environment_.plane_angles_by_p();
  if (by_p && words_.has('P')) {
    std::uint32_t kind = 0;
    if (const Fault fault = words_.whole_number('P', 0, 1, kind)) return fault;
    turned_axes = kind == 0;
  }
  tilt.origin = {words_.axis(X), words_.axis(Y), words_.axis(Z)};
  const double i = words_.value('I');
  const double j = words_.value('J');
  const double k = words_.value('K');
  tilt.matrix = turned_axes ? multiplied(multiplied(rotation(2, i), rotation(0, j)), rotation(2, k))
                            : roll_pitch_yaw(i, j, k);
  return {};
}

Fault TiltedPlanes::apply(const Tilt& tilt, bool angles_by_p) {
  std::uint32_t solution = 0;
  if (words_.has('P') && !angles_by_p) {
    if (const Fault fault = words_.whole_number('P', 0, prefers_negative, solution)) return fault;
  }
  // Without tool tip control nothing turns the tool to the workpiece as it stands.
  if (state_.modal.transformation == Transformation::none && state_.frame().setting_error().number != 0)
    return {AlarmNumber::tip_control_needed, words_.g().offset(Group::rotation)};
  state_.swing_due = true;
  // The length, now or from a later G43, acts along the tool in the plane.
  if (state_.modal.transformation == Transformation::none) {
    state_.position = environment_.tip_from_machine(state_.position, state_.modal.tool_length);
    state_.modal.transformation = Transformation::rtcp;
    state_.modal.plane_only = true;
  }
  // G68 of before was in another plane.
  ProgramFrame& frame = state_.change_frame();
  frame.clear_rotation();
  state_.modal.rotated = false;
  state_.modal.tilt = tilt;
  state_.modal.tilt.active = true;
  state_.modal.tilt.solution = static_cast<std::uint8_t>(solution);
  frame.set_tilt(state_.modal.tilt);
  state_.locate(state_.position);
  output_.push(CommandKind::transformation);
  return {};
}

Fault TiltedPlanes::clear_rotation(std::uint16_t at) {
  if (state_.modal.tilt.active) {
    if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  }
  ProgramFrame& frame = state_.change_frame();
  frame.clear_rotation();
  state_.modal.rotated = false;
  if (state_.modal.tilt.active) {
    state_.modal.tilt = {};
    frame.set_tilt(state_.modal.tilt);
    if (state_.modal.plane_only) {
      state_.position = state_.machine_position(environment_);
      state_.modal.transformation = Transformation::none;
      state_.modal.plane_only = false;
    }
    state_.locate(state_.position);
    output_.push(CommandKind::transformation);
  }
  state_.locate(state_.position);
  return {};
}

// What P3 and P4 prefer may be out of travel: then the other solution is taken (SINUMERIK 828D operating
// manual, 08/2018, 10.6, "Direction").
std::optional<AxisValues> TiltedPlanes::rotary_axes(const Vector3& direction) const {
  const std::uint8_t solution = state_.modal.tilt.solution;
  const bool prefers = solution >= prefers_positive;
  const auto choice = static_cast<RotaryChoice>(prefers ? solution - 2 : solution);
  const auto turned = environment_.orient(direction, state_.position, choice);
  return turned || !prefers ? turned
                            : environment_.orient(direction, state_.position, RotaryChoice::shortest);
}

// check() has seen to it that the block is due and alone.
Fault TiltedPlanes::swing(std::uint16_t at, bool keep_tip) {
  if (keep_tip && state_.modal.plane_only) return {AlarmNumber::tip_control_needed, at};
  const Vector3 direction = state_.frame().turned({0, 0, 1});
  const auto turned = rotary_axes(direction);
  if (!turned) return refuse_orientation(context_, direction, at);
  state_.swing_due = false;
  AxisValues target = state_.position;
  for (const Axis axis : {A, B, C, U, V, W}) target[axis] = (*turned)[axis];
  const double feed = state_.modal.feed;
  const FeedMode mode = state_.modal.feed_mode;
  if (!(feed > 0) || mode != FeedMode::per_minute) {
    state_.modal.feed = environment_.default_feed();
    state_.modal.feed_mode = FeedMode::per_minute;
  }
  const Fault fault =
      keep_tip ? output_.move_straight_in_command_frame(CommandKind::line, target) : swing_at_rest(target);
  state_.modal.feed = feed;
  state_.modal.feed_mode = mode;
  return fault;
}

// The linear axes are at rest in machine coordinates, so these are what the move is given in.
Fault TiltedPlanes::swing_at_rest(AxisValues target) {
  const Transformation transformation = state_.modal.transformation;
  const AxisValues machine = state_.machine_position(environment_);
  for (const Axis axis : {X, Y, Z}) target[axis] = machine[axis];
  state_.modal.transformation = Transformation::none;
  state_.locate(machine);
  output_.push(CommandKind::transformation);
  const Fault fault = output_.move_straight_in_command_frame(CommandKind::line, target);
  state_.modal.transformation = transformation;
  state_.locate(environment_.tip_from_machine(target, state_.modal.tool_length));
  output_.push(CommandKind::transformation);
  return fault;
}

// From the tip to the spindle: where the tip would be with a tool shorter by 1 mm.
Vector3 TiltedPlanes::tool_direction() const {
  const AxisValues machine = state_.machine_position(environment_);
  const AxisValues tip = environment_.tip_from_machine(machine, 1);
  const AxisValues gauge = environment_.tip_from_machine(machine, 0);
  const Vector3 direction{gauge[X] - tip[X], gauge[Y] - tip[Y], gauge[Z] - tip[Z]};
  return divided(direction, norm(direction));
}

Fault TiltedPlanes::move_along_tool(std::uint16_t at) {
  if (state_.modal.transformation != Transformation::rtcp) return {AlarmNumber::tip_control_needed, at};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (!words_.has('L')) return {AlarmNumber::missing_word, at, needs('L')};
  if (const Fault fault = check_feed(at)) return fault;
  const double distance = words_.length('L');
  const Vector3 direction = tool_direction();
  AxisValues target = state_.position;
  for (std::size_t axis = 0; axis < 3; ++axis) target[axis] += distance * direction[axis];
  return output_.move_straight_in_command_frame(CommandKind::line, target);
}

}  // namespace trunnion::language
