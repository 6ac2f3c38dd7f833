// The part of BlockExecutor that makes moves and dwells.
#include <bit>
#include <cmath>

#include "language/arc_geometry.hpp"
#include "language/block_executor.hpp"

namespace trunnion::language {
namespace {

/// A move shorter than this (mm, degrees) on every axis is rounding, not motion.
constexpr double no_distance = 1e-9;
constexpr double longest_dwell = 99999.999;  // seconds
constexpr std::uint32_t most_turns = 9999;

constexpr std::uint32_t letter_bits(const char* letters) {
  std::uint32_t bits = 0;
  for (; *letters != '\0'; ++letters) bits |= Block::bit(*letters);
  return bits;
}
constexpr std::uint32_t axis_bits = letter_bits(axis_letters);

constexpr bool is_rotary(std::size_t axis) { return axis == A || axis == B || axis == C; }

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

AxisValues BlockExecutor::programmed_target(const Block& block, std::uint32_t axes) const {
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = block.value(axis_letters[axis]) * (is_rotary(axis) ? 1.0 : length_scale());
    if (!modal_.absolute) {
      target[axis] += word;
      continue;
    }
    target[axis] = word + work_offset_[axis];
    if (axis == Z && modal_.transformation == Transformation::none) target[axis] += modal_.tool_length;
  }
  return target;
}

Fault BlockExecutor::move_or_dwell(const Block& block, const Codes& codes, CommandQueue& out) {
  if (!codes.has(Group::one_block)) return move(block, out);
  switch (codes.code(Group::one_block)) {
    case 40:
      return dwell(block, codes, out);
    case 280:
      return return_to_reference(block, codes, out);
    default:
      return move_in_machine_coordinates(block, codes, out);
  }
}

Fault BlockExecutor::dwell(const Block& block, const Codes& codes, CommandQueue& out) {
  double seconds = 0;
  char found = '\0';
  for (const char letter : {'P', 'X', 'U'}) {
    // The first one is the time; a second one is left over and reported as such.
    if (!block.has(letter) || found != '\0') continue;
    found = letter;
    use(letter);
    seconds = letter == 'P' ? block.value(letter) / 1000 : block.value(letter);
  }
  if (found == '\0') return {AlarmNumber::missing_word, codes.offset(Group::one_block)};
  if (seconds < 0 || seconds > longest_dwell) return {AlarmNumber::value_range, block.offset(found)};
  push(CommandKind::dwell, out).dwell_seconds = seconds;
  return {};
}

Fault BlockExecutor::return_to_reference(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  if (axes == 0) return {AlarmNumber::missing_word, at};
  used_ |= block.letters & axis_bits;
  move_straight(CommandKind::rapid, programmed_target(block, axes), out);
  const AxisValues reference = environment_.reference_position();
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) target[axis] = reference[axis];
  }
  move_straight(CommandKind::rapid, target, out);
  return {};
}

Fault BlockExecutor::move_in_machine_coordinates(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  if (modal_.motion > 1) return {AlarmNumber::machine_coordinates_motion, at};
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  if (axes == 0) return {AlarmNumber::missing_word, at};
  used_ |= block.letters & axis_bits;
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    target[axis] = block.value(axis_letters[axis]) * (is_rotary(axis) ? 1.0 : length_scale());
  }
  if (modal_.motion == 1) {
    if (const Fault fault = check_feed(block, at)) return fault;
  }
  move_straight(modal_.motion == 1 ? CommandKind::line : CommandKind::rapid, target, out);
  return {};
}

Fault BlockExecutor::move(const Block& block, CommandQueue& out) {
  constexpr std::uint32_t arc_bits = letter_bits("IJKR");
  const bool arc = modal_.motion == 2 || modal_.motion == 3;
  const std::uint32_t moving = block.letters & (arc ? axis_bits | arc_bits : axis_bits);
  if (moving == 0) return {};
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  used_ |= block.letters & axis_bits;
  const std::uint16_t at = block.offsets[static_cast<std::size_t>(std::countr_zero(moving))];
  if (modal_.motion > 3) return {AlarmNumber::motion_missing, at};
  if (modal_.motion != 0) {
    if (const Fault fault = check_feed(block, at)) return fault;
  }
  const AxisValues target = programmed_target(block, axes);
  if (arc) return move_on_arc(block, target, at, out);
  move_straight(modal_.motion == 1 ? CommandKind::line : CommandKind::rapid, target, out);
  return {};
}

Fault BlockExecutor::check_feed(const Block& block, std::uint16_t at) const {
  const bool given = modal_.feed_mode == FeedMode::inverse_time ? block.has('F') : modal_.feed > 0;
  return given ? Fault{} : Fault{AlarmNumber::feed_missing, at};
}

void BlockExecutor::move_straight(CommandKind kind, const AxisValues& target, CommandQueue& out) {
  bool linear = false;
  bool rotary = false;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    const bool moves = std::abs(target[axis] - position_[axis]) > no_distance;
    (is_rotary(axis) ? rotary : linear) |= moves;
  }
  if (!linear && !rotary) return;
  position_ = target;
  Command& command = push(kind, out);
  if (kind == CommandKind::line && !linear && modal_.feed_mode != FeedMode::inverse_time) {
    command.modal.feed /= length_scale();
  }
}

Fault BlockExecutor::move_on_arc(const Block& block, const AxisValues& target, std::uint16_t at,
                                 CommandQueue& out) {
  Arc arc;
  arc.plane = modal_.plane;
  arc.clockwise = modal_.motion == 2;
  const PlaneAxes plane = plane_axes(modal_.plane);
  std::array<double, 3> centre_offset{};
  bool centre = false;
  for (const std::uint8_t axis : {plane.first, plane.second}) {
    const char letter = static_cast<char>('I' + axis);
    if (!block.has(letter)) continue;
    use(letter);
    at = block.offset(letter);
    centre_offset[axis] = block.value(letter) * length_scale();
    centre = true;
  }
  std::uint32_t turns = 1;
  if (block.has('L')) {
    if (const Fault fault = whole_number(block, 'L', 1, most_turns, turns)) return fault;
  }
  AlarmNumber number = AlarmNumber::none;
  if (block.has('R')) {
    use('R');
    at = block.offset('R');
    if (centre) return {AlarmNumber::arc_centre_and_radius, at};
    number =
        arc_from_radius(position_, target, block.value('R') * length_scale(), turns, radius_deviation_, arc);
  } else {
    if (!centre) return {AlarmNumber::arc_centre_missing, at};
    number = arc_from_centre(position_, target, centre_offset, turns, radius_deviation_, arc);
  }
  if (number != AlarmNumber::none) return {number, at};
  position_ = target;
  push(CommandKind::arc, out).arc = arc;
  return {};
}

}  // namespace trunnion::language
