// The part of BlockExecutor that makes moves: straight lines, arcs and curves.
#include <bit>
#include <cmath>
#include <numbers>

#include "language/arc_geometry.hpp"
#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

/// A move shorter than this (mm, degrees) on every axis is rounding, not motion.
constexpr double no_distance = 1e-9;
constexpr std::uint32_t most_turns = 9999;
constexpr double curve_start_tolerance = 0.001;  // mm

}  // namespace

Fault BlockExecutor::find_axes(const Block& block, std::uint32_t& axes) const {
  axes = 0;
  if ((block.letters & axis_bits) == 0) return {};
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (!block.has(axis_letters[axis])) continue;
    if (((channel_axes_ >> axis) & 1u) == 0)
      return {AlarmNumber::axis_absent, block.offset(axis_letters[axis])};
    axes |= 1u << axis;
  }
  return {};
}

double BlockExecutor::axis_word(const Block& block, std::size_t axis) const {
  const double word = block.value(axis_letters[axis]);
  if (is_rotary(axis)) return word;
  return word * length_scale() * (diameter_ && axis == X ? 0.5 : 1.0);
}

AxisValues BlockExecutor::programmed_target(const Block& block, std::uint32_t axes) {
  AxisValues target = program_position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = axis_word(block, axis);
    target[axis] = modal_.absolute ? word : target[axis] + word;
  }
  if (modal_.polar) apply_polar(block, axes, target);
  return target;
}

// The radius is about the program's zero, or about the position when it is an incremental word; the angle is
// in the plane from its first axis, or from the last angle.
void BlockExecutor::apply_polar(const Block& block, std::uint32_t axes, AxisValues& target) {
  const PlaneAxes plane = plane_axes(modal_.plane);
  const bool radius = ((axes >> plane.first) & 1u) != 0;
  const bool angle = ((axes >> plane.second) & 1u) != 0;
  if (!radius && !angle) return;
  if (radius) {
    polar_radius_ = axis_word(block, plane.first);
    polar_centre_ = {};
    if (!modal_.absolute) polar_centre_ = {program_position_[plane.first], program_position_[plane.second]};
  }
  if (angle) {
    const double word = block.value(axis_letters[plane.second]);
    polar_angle_ = std::fmod(modal_.absolute ? word : polar_angle_ + word, 360.0);
  }
  const double radians = polar_angle_ * (std::numbers::pi / 180.0);
  target[plane.first] = polar_centre_[0] + polar_radius_ * std::cos(radians);
  target[plane.second] = polar_centre_[1] + polar_radius_ * std::sin(radians);
}

Fault BlockExecutor::move(const Block& block, CommandQueue& out) {
  constexpr std::uint32_t arc_bits = letter_bits("IJKR");
  constexpr std::uint32_t vector_bits = letter_bits("IJK");
  const bool arc = modal_.motion == 2 || modal_.motion == 3;
  const bool vector = modal_.tool_vector;
  const std::uint32_t moving =
      block.letters & (axis_bits | (arc ? arc_bits : 0u) | (vector ? vector_bits : 0u));
  if (moving == 0) return {};
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  used_ |= block.letters & axis_bits;
  const std::uint16_t at = block.offsets[static_cast<std::size_t>(std::countr_zero(moving))];
  if (modal_.motion != 0) {
    if (const Fault fault = check_feed(block, at)) return fault;
  }
  AxisValues target = programmed_target(block, axes);
  const CommandKind kind = arc                  ? CommandKind::arc
                           : modal_.motion == 1 ? CommandKind::line
                                                : CommandKind::rapid;
  std::optional<Vector3> direction;
  std::uint16_t vector_at = 0;
  if (vector)
    if (const Fault fault = read_tool_vector(block, direction, vector_at)) return fault;
  Command made;
  if (arc)
    if (const Fault fault = find_arc(block, target, at, made.arc)) return fault;
  if (direction && compensation_.active())
    if (const Fault fault = point_tool(*direction, vector_at, target)) return fault;
  if (direction && !compensation_.active()) {
    made.kind = kind;
    to_command_frame(made);
    return lead_tool(kind, made.arc, *direction, vector_at, command_from_program(target), out);
  }
  return arc ? move_on_arc(made.arc, target, out) : move_straight(kind, target, out);
}

Fault BlockExecutor::check_feed(const Block& block, std::uint16_t at) const {
  const bool given = modal_.feed_mode == FeedMode::inverse_time ? block.has('F') : modal_.feed > 0;
  return given ? Fault{} : Fault{AlarmNumber::feed_missing, at};
}

bool BlockExecutor::moves_to(const AxisValues& command, bool& linear) const {
  linear = false;
  bool rotary = false;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    const bool moves = std::abs(command[axis] - position_[axis]) > no_distance;
    (is_rotary(axis) ? rotary : linear) |= moves;
  }
  return linear || rotary;
}

Fault BlockExecutor::move_straight(CommandKind kind, const AxisValues& program, CommandQueue& out) {
  const AxisValues target = command_from_program(program);
  bool linear = false;
  const bool moves = moves_to(target, linear);
  if (compensation_.active()) {
    if (!moves) {
      program_position_ = program;
      return {};
    }
    Command command;
    command.kind = kind;
    return push_move(command, program);
  }
  program_position_ = program;
  if (!moves) return {};
  position_ = target;
  Command& command = push(kind, out);
  command.chord = kind == CommandKind::line && curve_.active() && !curve_.at_end();
  if (command.chord) command.modal.path_control = PathControl::continuous;
  if (kind == CommandKind::skip) command.number = skip_input_;
  if (kind == CommandKind::tap) {
    command.value = lead_;
    command.number = tapping_axis_;
  }
  if (kind != CommandKind::rapid && !linear && modal_.feed_mode != FeedMode::inverse_time) {
    command.modal.feed /= length_scale();
  }
  return {};
}

Fault BlockExecutor::move_straight_in_command_frame(CommandKind kind, const AxisValues& command,
                                                    CommandQueue& out) {
  bool linear = false;
  if (!moves_to(command, linear)) return {};
  locate(command);
  Command& made = push(kind, out);
  if (kind == CommandKind::line && !linear && modal_.feed_mode != FeedMode::inverse_time) {
    made.modal.feed /= length_scale();
  }
  return {};
}

// Held moves are in contour coordinates until the compensation lets go of them.
Fault BlockExecutor::push_move(const Command& move, const AxisValues& program) {
  if (modal_.transformation == Transformation::rtcp) {
    for (const Axis axis : {A, B, C}) {
      if (std::abs(program[axis] - program_position_[axis]) > no_distance) {
        return {AlarmNumber::compensation_rotary, 0};
      }
    }
  }
  const AxisValues start = frame_.contour_from_program(program_position_);
  moves_ = true;
  Command command = move;
  command.program = program_;
  command.line = line_;
  command.target = frame_.contour_from_program(program);
  command.modal = command_modal();
  position_ = command_from_program(program);
  program_position_ = program;
  return {compensation_.add(command, start, frame_.flips(modal_.plane)), 0};
}

Fault BlockExecutor::set_turns(const Block& block, const AxisValues& target, std::uint16_t at, Arc& arc) {
  const std::uint8_t normal = plane_axes(arc.plane).normal;
  const char lead_letter = static_cast<char>('I' + normal);
  if (!block.has(lead_letter)) return {};
  // The third centre letter is the lead of a helix: how far it goes in a turn, hence how many turns.
  const double height = std::abs(target[normal] - program_position_[normal]);
  if (height < no_distance || (modal_.tool_vector && block.has('R'))) return {};
  const double lead = std::abs(length_word(block, lead_letter));
  if (block.has('L')) return {};
  if (!(lead > 0) || height / lead > most_turns) return {AlarmNumber::value_range, at};
  const double turns = std::round(height / lead - arc.sweep / 360);
  if (turns > 0) arc.sweep += 360 * turns;
  return {};
}

// With G43.5 and R the letters I J K are the tool's.
Fault BlockExecutor::find_arc(const Block& block, const AxisValues& target, std::uint16_t at, Arc& arc) {
  const bool vector = modal_.tool_vector && block.has('R');
  arc.plane = modal_.plane;
  arc.clockwise = modal_.motion == 2;
  const PlaneAxes plane = plane_axes(modal_.plane);
  if (!frame_.keeps_circles(modal_.plane)) return {AlarmNumber::arc_scaled_unequally, at};
  std::array<double, 3> centre_offset{};
  bool centre = false;
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const char letter = static_cast<char>('I' + axis);
    if (!block.has(letter) || vector) continue;
    at = block.offset(letter);
    centre_offset[axis] = length_word(block, letter);
    centre = true;
  }
  std::uint32_t turns = 1;
  if (block.has('L')) {
    if (const Fault fault = whole_number(block, 'L', 1, most_turns, turns)) return fault;
  }
  AlarmNumber number = AlarmNumber::none;
  if (block.has('R')) {
    at = block.offset('R');
    const double radius = length_word(block, 'R');
    if (centre) return {AlarmNumber::arc_centre_and_radius, at};
    number = arc_from_radius(program_position_, target, radius, turns, radius_deviation_, arc);
  } else {
    if (!centre) return {AlarmNumber::arc_centre_missing, at};
    number = arc_from_centre(program_position_, target, centre_offset, turns, radius_deviation_, arc);
  }
  if (number != AlarmNumber::none) return {number, at};
  if (const Fault fault = set_turns(block, target, at, arc)) return fault;

  const AxisValues middle{arc.centre[0], arc.centre[1], arc.centre[2], 0, 0, 0, 0, 0, 0};
  const AxisValues contour_centre = frame_.contour_from_program(middle);
  arc.centre = {contour_centre[X], contour_centre[Y], contour_centre[Z]};
  if (frame_.flips(modal_.plane)) arc.clockwise = !arc.clockwise;
  return {};
}

Fault BlockExecutor::move_on_arc(const Arc& arc, const AxisValues& target, CommandQueue& out) {
  Command command;
  command.kind = CommandKind::arc;
  command.arc = arc;
  if (compensation_.active()) return push_move(command, target);
  const AxisValues end = command_from_program(target);
  to_command_frame(command);
  position_ = end;
  program_position_ = target;
  push(CommandKind::arc, out).arc = command.arc;
  return {};
}

Fault BlockExecutor::start_curve(const Block& block, const Codes& codes) {
  constexpr std::uint32_t curve_words = letter_bits("KR") | axis_bits;
  const bool named = codes.is(Group::motion, 62);
  if (!named && (block.letters & curve_words) == 0) return {};
  const std::uint16_t at =
      named ? codes.offset(Group::motion)
            : block.offsets[static_cast<std::size_t>(std::countr_zero(block.letters & curve_words))];
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (modal_.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  if (const Fault fault = check_feed(block, at)) return fault;
  std::uint32_t order = NurbsCurve::most_order;
  if (block.has('P')) {
    if (const Fault fault = whole_number(block, 'P', 2, NurbsCurve::most_order, order)) return fault;
  }
  control_point_ = {program_position_[X], program_position_[Y], program_position_[Z]};
  curve_.start(order, environment_.curve_tolerance());
  // The curve begins where the tool is, so the first point may be left out.
  Fault fault = add_curve_block(block);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool here = std::abs(control_point_[axis] - program_position_[axis]) <= curve_start_tolerance;
    if (!fault && !here) fault = {AlarmNumber::curve_start, at};
  }
  if (fault) curve_.stop();
  return fault;
}

Fault BlockExecutor::continue_curve(const Block& block) {
  if (const Fault fault = add_curve_block(block)) {
    curve_.stop();
    return fault;
  }
  activity_ = Activity::curve;
  return {};
}

Fault BlockExecutor::add_curve_block(const Block& block) {
  const std::uint16_t at =
      block.offsets[static_cast<std::size_t>(std::countr_zero(block.letters | 1u << 25))];
  if (!block.has('K')) return {AlarmNumber::curve_words, at};
  use('K');
  const double knot = block.value('K');
  constexpr std::uint32_t other_axes = letter_bits("ABCUVW");
  if ((block.letters & other_axes) != 0) return {AlarmNumber::curve_words, at};
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  const bool first = activity_ == Activity::none && !curve_.has_points();
  if (axes == 0 && !block.has('R') && !first) return {curve_.add(knot), block.offset('K')};
  NurbsCurve::ControlPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = axis_word(block, axis);
    control_point_[axis] = modal_.absolute ? word : control_point_[axis] + word;
  }
  used_ |= block.letters & axis_bits;
  point.point = control_point_;
  if (block.has('R')) {
    use('R');
    point.weight = block.value('R');
    if (!(point.weight > 0)) return {AlarmNumber::value_range, block.offset('R')};
  }
  return {curve_.add(knot, point), block.offset('K')};
}

}  // namespace trunnion::language
