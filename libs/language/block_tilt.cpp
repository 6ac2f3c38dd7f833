// The part of BlockExecutor that tilts the plane and swings the tool to it.
#include <cmath>
#include <numbers>

#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

using Matrix3 = std::array<double, 9>;

constexpr double no_length = 1e-9;  // mm

Vector3 difference(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double norm(const Vector3& a) { return std::hypot(a[0], a[1], a[2]); }
Vector3 product(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 divided(const Vector3& a, double by) { return {a[0] / by, a[1] / by, a[2] / by}; }

Matrix3 multiplied(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t k = 0; k < 3; ++k) c[3 * row + column] += a[3 * row + k] * b[3 * k + column];
    }
  }
  return c;
}

/// Right-handed rotation about X, Y or Z (0, 1, 2).
Matrix3 rotation(std::size_t axis, double degrees) {
  const double angle = std::remainder(degrees, 360.0) * (std::numbers::pi / 180.0);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  if (axis == 0) return {1, 0, 0, 0, c, -s, 0, s, c};
  if (axis == 1) return {c, 0, s, 0, 1, 0, -s, 0, c};
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

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

Fault BlockExecutor::set_tilt(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::rotation);
  const std::uint16_t code = codes.code(Group::rotation);
  if (modal_.transformation != Transformation::rtcp) return {AlarmNumber::tip_control_needed, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  Tilt tilt;
  tilt.active = true;
  if (code == 681) {
    if (!block.has('Q')) return {AlarmNumber::missing_word, at};
    std::uint32_t index = 0;
    if (const Fault fault = whole_number(block, 'Q', 1, 20, index)) return fault;
    const auto points = environment_.plane_points(static_cast<std::uint8_t>(index));
    if (!points || !tilt_from_points(*points, tilt)) return {AlarmNumber::tilt_points, block.offset('Q')};
  } else {
    for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'K'}) {
      if (!block.has(letter)) return {AlarmNumber::missing_word, at};
      use(letter);
    }
    tilt.origin = {axis_word(block, X), axis_word(block, Y), axis_word(block, Z)};
    const double i = block.value('I');
    const double j = block.value('J');
    const double k = block.value('K');
    tilt.matrix = code == 682 ? multiplied(multiplied(rotation(2, i), rotation(0, j)), rotation(2, k))
                              : multiplied(multiplied(rotation(2, k), rotation(1, j)), rotation(0, i));
  }
  std::uint32_t choice = 0;
  if (block.has('P')) {
    if (const Fault fault = whole_number(block, 'P', 0, 2, choice)) return fault;
  }
  swing_choice_ = static_cast<RotaryChoice>(choice);
  swing_due_ = true;
  // G68 of before was in another plane.
  frame_.clear_rotation();
  modal_.rotated = false;
  modal_.tilt = tilt;
  frame_.set_tilt(tilt);
  locate(position_);
  push(CommandKind::transformation, out);
  return {};
}

// check_context() has seen to it that the block is due and alone.
Fault BlockExecutor::swing(const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  const Vector3 direction = frame_.turned_by_tilt({0, 0, 1});
  const auto turned = environment_.orient(direction, position_, swing_choice_);
  if (!turned) return refuse_orientation(direction, at);
  swing_due_ = false;
  AxisValues target = position_;
  for (const Axis axis : {A, B, C, U, V, W}) target[axis] = (*turned)[axis];
  const double feed = modal_.feed;
  const FeedMode mode = modal_.feed_mode;
  if (!(feed > 0) || mode != FeedMode::per_minute) {
    modal_.feed = environment_.default_feed();
    modal_.feed_mode = FeedMode::per_minute;
  }
  Fault fault;
  if (codes.is(Group::one_block, 532)) {
    fault = move_straight_in_command_frame(CommandKind::line, target, out);
  } else {
    // The linear axes stand still in machine coordinates, so these are what the move is given in.
    const Transformation transformation = modal_.transformation;
    const AxisValues machine = machine_position();
    for (const Axis axis : {X, Y, Z}) target[axis] = machine[axis];
    modal_.transformation = Transformation::none;
    locate(machine);
    push(CommandKind::transformation, out);
    fault = move_straight_in_command_frame(CommandKind::line, target, out);
    modal_.transformation = transformation;
    locate(environment_.tip_from_machine(target, modal_.tool_length));
    push(CommandKind::transformation, out);
  }
  modal_.feed = feed;
  modal_.feed_mode = mode;
  return fault;
}

// From the tip to the spindle: where the tip would be with a tool shorter by 1 mm.
Vector3 BlockExecutor::tool_direction() const {
  const AxisValues machine = machine_position();
  const AxisValues tip = environment_.tip_from_machine(machine, 1);
  const AxisValues gauge = environment_.tip_from_machine(machine, 0);
  const Vector3 direction{gauge[X] - tip[X], gauge[Y] - tip[Y], gauge[Z] - tip[Z]};
  return divided(direction, norm(direction));
}

Fault BlockExecutor::move_along_tool(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation != Transformation::rtcp) return {AlarmNumber::tip_control_needed, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (!block.has('L')) return {AlarmNumber::missing_word, at};
  if (const Fault fault = check_feed(block, at)) return fault;
  const double distance = length_word(block, 'L');
  const Vector3 direction = tool_direction();
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < 3; ++axis) target[axis] += distance * direction[axis];
  return move_straight_in_command_frame(CommandKind::line, target, out);
}

}  // namespace trunnion::language
