// Moves with a tool vector (G43.5).
#include <cmath>
#include <cstdio>

#include "language/arc_geometry.hpp"
#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double no_length = 1e-9;

AxisValues point_on_line(const AxisValues& start, const AxisValues& target, double share) {
  AxisValues point = start;
  for (std::size_t axis = 0; axis < axis_count; ++axis) point[axis] += share * (target[axis] - start[axis]);
  return point;
}

}  // namespace

Fault BlockExecutor::read_tool_vector(const Block& block, std::optional<Vector3>& direction,
                                      std::uint16_t& at) {
  constexpr std::uint32_t vector_words = letter_bits("IJK");
  const bool arc = modal_.motion == 2 || modal_.motion == 3;
  for (const char letter : {'A', 'B', 'C'}) {
    if (block.has(letter)) return {AlarmNumber::tool_vector_needed, block.offset(letter)};
  }
  // Without R the letters of an arc are its centre, and the tool keeps its direction.
  if ((block.letters & vector_words) == 0 || (arc && !block.has('R'))) return {};
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

Fault BlockExecutor::point_tool(const Vector3& direction, std::uint16_t at, AxisValues& target) {
  const auto turned = environment_.orient(direction, position_, RotaryChoice::continuous);
  if (!turned) return refuse_orientation(direction, at);
  const AxisValues& offset = frame_.total_offset();
  for (const Axis axis : {A, B, C, U, V, W}) target[axis] = (*turned)[axis] - offset[axis];
  return {};
}

Fault BlockExecutor::refuse_orientation(const Vector3& direction, std::uint16_t at) {
  const auto nearest = environment_.nearest_direction(direction, position_);
  if (!nearest) return {AlarmNumber::orientation_travel, at};
  return refuse_direction(AlarmNumber::orientation_impossible, *nearest, at);
}

// Names the nearest direction in reach: of a swing in the workpiece frame, of words as they would be written.
Fault BlockExecutor::refuse_direction(AlarmNumber number, const Vector3& nearest, std::uint16_t at) {
  if (nearest == Vector3{}) return {number, at};
  const auto& m = frame_.tilt().matrix;
  Vector3 words = nearest;
  for (std::size_t i = 0; i < 3; ++i) {
    if (modal_.tool_vector && !swing_due_)
      words[i] = m[i] * nearest[0] + m[3 + i] * nearest[1] + m[6 + i] * nearest[2];
    if (std::abs(words[i]) < 5e-7) words[i] = 0;
  }
  std::snprintf(detail_.data(), detail_.size(), "nearest I%.6f J%.6f K%.6f", words[0], words[1], words[2]);
  detail_number_ = number;
  return {number, at};
}

// The tip goes its line or arc and the tool over the great circle: in pieces in which the axes go in
// proportion.
Fault BlockExecutor::lead_tool(CommandKind kind, const Arc& arc, const Vector3& direction, std::uint16_t at,
                               const AxisValues& end, CommandQueue& out) {
  const VectorWay way = environment_.vector_way(position_, direction);
  switch (way.fault) {
    case VectorWay::Fault::none:
      break;
    case VectorWay::Fault::opposite:
      return {AlarmNumber::tool_vector_opposite, at};
    case VectorWay::Fault::end:
      return refuse_direction(AlarmNumber::orientation_impossible, way.nearest, at);
    case VectorWay::Fault::on_the_way:
      return refuse_direction(AlarmNumber::tool_vector_way, way.nearest, at);
    case VectorWay::Fault::travel:
      return {AlarmNumber::tool_vector_travel, at};
    case VectorWay::Fault::pole:
      return {AlarmNumber::tool_vector_pole, at};
  }
  Command whole;
  whole.kind = kind;
  whole.arc = arc;
  whole.target = end;
  whole.modal = modal_;
  if (const auto breach = environment_.vector_breach(position_, whole, direction)) {
    std::snprintf(detail_.data(), detail_.size(), "%c would go to %.4f", axis_letters[breach->axis],
                  breach->position);
    detail_number_ = AlarmNumber::tool_vector_travel;
    return {AlarmNumber::tool_vector_travel, at};
  }
  vector_move_ = {kind, position_, end, arc, direction, way.turns_first ? 0u : 1u, way.pieces};
  activity_ = Activity::vector;
  return next_vector_piece(out);
}

Fault BlockExecutor::next_vector_piece(CommandQueue& out) {
  const VectorMove& move = vector_move_;
  const std::uint32_t piece = vector_move_.piece++;
  const double share = static_cast<double>(piece) / move.pieces;
  const bool last = piece == move.pieces, arc = move.kind == CommandKind::arc && piece > 0;
  AxisValues target = last  ? move.end
                      : arc ? point_on_arc(move.start, move.end, move.arc, share)
                            : point_on_line(move.start, move.end, share);
  const AxisValues turned = environment_.on_vector_way(move.start, move.direction, share);
  // U V W may turn the tool or be linear axes that the block moves.
  for (const Axis axis : {A, B, C, U, V, W})
    if (is_rotary(axis) || turned[axis] != move.start[axis]) target[axis] = turned[axis];
  if (last) activity_ = Activity::none;
  bool linear = false;
  if (!moves_to(target, linear) && !arc) return {};
  locate(target);
  Command& made = push(arc                               ? CommandKind::arc
                       : move.kind == CommandKind::rapid ? CommandKind::rapid
                                                         : CommandKind::line,
                       out);
  made.chord = !last;
  if (!last) made.modal.path_control = PathControl::continuous;
  if (arc) {
    made.arc = move.arc;
    made.arc.sweep /= move.pieces;
  }
  if (made.kind == CommandKind::rapid) return {};
  if (made.modal.feed_mode == FeedMode::inverse_time)
    made.modal.feed *= move.pieces;
  else if (!linear && !arc)
    made.modal.feed /= length_scale();
  return {};
}

}  // namespace trunnion::language
