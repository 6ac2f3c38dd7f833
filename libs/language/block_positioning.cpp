// The part of BlockExecutor that dwells and positions without the modal motion code.
#include <cmath>

#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double longest_dwell = 99999.999;  // seconds
constexpr std::uint32_t highest_skip_input = 4;

}  // namespace

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

Fault BlockExecutor::take_axes(const Block& block, std::uint16_t at, std::uint32_t& axes) {
  if (const Fault fault = find_axes(block, axes)) return fault;
  if (axes == 0) return {AlarmNumber::missing_word, at};
  used_ |= block.letters & axis_bits;
  return {};
}

Fault BlockExecutor::return_to_reference(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  AxisValues reference{};
  if (codes.code(Group::one_block) == 280) {
    reference = environment_.reference_position();
  } else {
    std::uint32_t number = 2;
    if (block.has('P')) {
      if (const Fault fault = whole_number(block, 'P', 2, 4, number)) return fault;
    }
    const auto found = environment_.numbered_reference(static_cast<std::uint8_t>(number));
    if (!found) return {AlarmNumber::reference_undefined, block.has('P') ? block.offset('P') : at};
    reference = *found;
  }
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  const AxisValues over = programmed_target(block, axes);
  if (const Fault fault = move_straight(CommandKind::rapid, over, out)) return fault;
  intermediate_ = over;
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) target[axis] = reference[axis];
  }
  return move_straight_in_command_frame(CommandKind::rapid, target, out);
}

Fault BlockExecutor::return_from_reference(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (!intermediate_) return {AlarmNumber::intermediate_missing, at};
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  AxisValues over = program_position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) over[axis] = (*intermediate_)[axis];
  }
  if (const Fault fault = move_straight(CommandKind::rapid, over, out)) return fault;
  return move_straight(CommandKind::rapid, programmed_target(block, axes), out);
}

Fault BlockExecutor::move_in_machine_coordinates(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  if (modal_.motion > 1) return {AlarmNumber::machine_coordinates_motion, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  AxisValues target = position_;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) target[axis] = axis_word(block, axis);
  }
  if (modal_.motion == 1) {
    if (const Fault fault = check_feed(block, at)) return fault;
  }
  return move_straight_in_command_frame(modal_.motion == 1 ? CommandKind::line : CommandKind::rapid, target,
                                        out);
}

// Every axis named arrives from its own side, so that its backlash is taken up the same way each time.
Fault BlockExecutor::approach_from_one_side(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (modal_.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  const AxisValues target = command_from_program(programmed_target(block, axes));
  const AxisValues last_way = environment_.approach();
  AxisValues before = target;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) before[axis] -= last_way[axis];
  }
  if (const Fault fault = move_straight_in_command_frame(CommandKind::rapid, before, out)) return fault;
  return move_straight_in_command_frame(CommandKind::rapid, target, out);
}

Fault BlockExecutor::move_until_skip(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  std::uint32_t input = 1;
  if (block.has('L')) {
    if (const Fault fault = whole_number(block, 'L', 1, highest_skip_input, input)) return fault;
  }
  std::uint32_t axes = 0;
  if (const Fault fault = take_axes(block, at, axes)) return fault;
  if (const Fault fault = check_feed(block, at)) return fault;
  skip_input_ = input;
  const std::uint32_t sequence = sequence_;
  const Fault fault = move_straight(CommandKind::skip, programmed_target(block, axes), out);
  if (fault || sequence == sequence_) return fault;  // without a way there is nothing to wait for
  needs_position_ = true;
  return {};
}

}  // namespace trunnion::language
