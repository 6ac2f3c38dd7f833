// Lines with a tool vector (G43.5).
#include <cmath>

#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double no_length = 1e-9;

}  // namespace

Fault BlockExecutor::read_tool_vector(const Block& block, std::optional<Vector3>& direction,
                                      std::uint16_t& at) {
  constexpr std::uint32_t vector_words = letter_bits("IJK");
  for (const char letter : {'A', 'B', 'C'}) {
    if (block.has(letter)) return {AlarmNumber::tool_vector_needed, block.offset(letter)};
  }
  if ((block.letters & vector_words) == 0) return {};
  Vector3 words{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = static_cast<char>('I' + i);
    if (!block.has(letter)) continue;
    use(letter);
    at = block.offset(letter);
    words[i] = block.value(letter);
  }
  const double size = std::hypot(words[0], words[1], words[2]);
  if (!(size > no_length)) return {AlarmNumber::tool_vector_zero, at};
  for (double& word : words) word /= size;
  direction = frame_.turned_by_tilt(words);
  return {};
}

Fault BlockExecutor::point_tool(const Vector3& direction, std::uint16_t at, AxisValues& target) const {
  const auto turned = environment_.orient(direction, position_, RotaryChoice::continuous);
  if (!turned) return {AlarmNumber::orientation_impossible, at};
  const AxisValues& offset = frame_.total_offset();
  for (const Axis axis : {A, B, C, U, V, W}) target[axis] = (*turned)[axis] - offset[axis];
  return {};
}

// The tip goes straight and the tool over the great circle: the axes in pieces, each a little straight line.
Fault BlockExecutor::lead_tool(const Vector3& direction, std::uint16_t at, const AxisValues& program,
                               CommandQueue& out) {
  const VectorWay way = environment_.vector_way(position_, direction);
  switch (way.fault) {
    case VectorWay::Fault::none:
      break;
    case VectorWay::Fault::opposite:
      return {AlarmNumber::tool_vector_opposite, at};
    case VectorWay::Fault::end:
      return {AlarmNumber::orientation_impossible, at};
    case VectorWay::Fault::on_the_way:
      return {AlarmNumber::tool_vector_way, at};
  }
  if (way.pieces == 1 && !way.turns_first) {
    AxisValues target = program;
    const AxisValues turned = environment_.on_vector_way(position_, direction, 1);
    const AxisValues& offset = frame_.total_offset();
    for (const Axis axis : {A, B, C, U, V, W}) target[axis] = turned[axis] - offset[axis];
    return move_straight(CommandKind::line, target, out);
  }
  vector_line_ = {position_, command_from_program(program), direction, way.turns_first ? 0u : 1u, way.pieces};
  activity_ = Activity::vector;
  return {};
}

Fault BlockExecutor::next_vector_piece(CommandQueue& out) {
  VectorLine& line = vector_line_;
  const double share = static_cast<double>(line.piece) / line.pieces;
  const bool last = line.piece == line.pieces;
  AxisValues target = environment_.on_vector_way(line.start, line.direction, share);
  for (const Axis axis : {X, Y, Z})
    target[axis] = last ? line.end[axis] : line.start[axis] + share * (line.end[axis] - line.start[axis]);
  ++line.piece;
  if (last) activity_ = Activity::none;
  bool linear = false;
  if (!moves_to(target, linear)) return {};
  locate(target);
  Command& made = push(CommandKind::line, out);
  made.chord = true;
  if (!last) made.modal.path_control = PathControl::continuous;
  if (made.modal.feed_mode == FeedMode::inverse_time)
    made.modal.feed *= line.pieces;
  else if (!linear)
    made.modal.feed /= length_scale();
  return {};
}

}  // namespace trunnion::language
