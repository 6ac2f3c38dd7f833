// SPDX-License-Identifier: Apache-2.0
#include "language/tool_vector_motion.hpp"

#include <cmath>
#include <cstdio>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

AxisValues point_on_line(const AxisValues& start, const AxisValues& target, double share) {
  AxisValues point = start;
  for (std::size_t axis = 0; axis < axis_count; ++axis) point[axis] += share * (target[axis] - start[axis]);
  return point;
}

// Names the nearest direction in reach: of a swing in the workpiece frame, of words as they would be written.
Fault refuse_direction(BlockContext& context, AlarmNumber number, const Vector3& nearest, std::uint16_t at) {
  if (nearest == Vector3{}) return {number, at};
  const ProgramState& state = context.state;
  const bool as_words = state.modal.tool_vector && !state.swing_due;
  Vector3 words = as_words ? state.frame().turned_back(nearest) : nearest;
  for (double& word : words) {
    if (std::abs(word) < 5e-7) word = 0;
  }
  context.detail.number = number;
  std::snprintf(context.detail.text.data(), context.detail.text.size(), "nearest I%.6f J%.6f K%.6f", words[0],
                words[1], words[2]);
  return {number, at};
}

}  // namespace

Fault refuse_orientation(BlockContext& context, const Vector3& direction, std::uint16_t at) {
  const auto nearest = context.environment.nearest_direction(direction, context.state.position);
  if (!nearest) return {AlarmNumber::orientation_travel, at};
  return refuse_direction(context, AlarmNumber::orientation_impossible, *nearest, at);
}

Fault ToolVectorMotion::read(std::optional<Vector3>& direction, std::uint16_t& at) {
  constexpr std::uint32_t vector_words = letter_bits("IJK");
  const bool arc = state_.modal.motion == 2 || state_.modal.motion == 3;
  for (const char letter : {'A', 'B', 'C'}) {
    if (words_.has(letter)) return {AlarmNumber::tool_vector_needed, words_.offset(letter)};
  }
  // Without R the letters of an arc are its centre, and the tool keeps its direction.
  if ((words_.letters() & vector_words) == 0 || (arc && !words_.has('R'))) return {};
  Vector3 words{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = static_cast<char>('I' + i);
    if (!words_.has(letter)) continue;
    words_.use(letter);
    at = words_.offset(letter);
    words[i] = words_.value(letter);
  }
  constexpr double no_length = 1e-9;
  const double size = std::hypot(words[0], words[1], words[2]);
  if (!(size > no_length)) return {AlarmNumber::tool_vector_zero, at};
  for (double& word : words) word /= size;
  direction = state_.frame().turned(words);
  return {};
}

Fault ToolVectorMotion::point(const Vector3& direction, std::uint16_t at, AxisValues& target) {
  // The words of the rotary axes are those of the drawing, whatever the setting error.
  const Vector3 drawn = turned_back(state_.frame().setting_error().matrix, direction);
  const auto turned = environment_.orient(drawn, state_.position, RotaryChoice::continuous);
  if (!turned) return refuse_orientation(context_, direction, at);
  const AxisValues& offset = state_.frame().total_offset();
  for (const Axis axis : {A, B, C, U, V, W}) target[axis] = (*turned)[axis] - offset[axis];
  return {};
}

// The tip goes its line or arc and the tool over the great circle: in pieces in which the axes go in
// proportion.
Fault ToolVectorMotion::lead(CommandKind kind, const Arc& arc, const Vector3& direction, std::uint16_t at,
                             const AxisValues& end) {
  const VectorPath path = environment_.vector_path(state_.position, direction);
  switch (path.fault) {
    case VectorPath::Fault::none:
      break;
    case VectorPath::Fault::opposite:
      return {AlarmNumber::tool_vector_opposite, at};
    case VectorPath::Fault::end:
      return refuse_direction(context_, AlarmNumber::orientation_impossible, path.nearest, at);
    case VectorPath::Fault::between:
      return refuse_direction(context_, AlarmNumber::tool_vector_between, path.nearest, at);
    case VectorPath::Fault::travel:
      return {AlarmNumber::tool_vector_travel, at};
    case VectorPath::Fault::pole:
      return {AlarmNumber::tool_vector_pole, at};
  }
  Command whole;
  whole.kind = kind;
  whole.arc = arc;
  whole.target = end;
  whole.modal = state_.modal;
  if (const auto breach = environment_.vector_breach(state_.position, whole, direction)) {
    FaultDetail& detail = context_.detail;
    detail.number = AlarmNumber::tool_vector_travel;
    std::snprintf(detail.text.data(), detail.text.size(), "%c would go to %.4f", axis_letters[breach->axis],
                  breach->position);
    return {AlarmNumber::tool_vector_travel, at};
  }
  move_ = {kind, state_.position, end, arc, direction, path.turns_first ? 0u : 1u, path.pieces};
  context_.activity = Activity::vector;
  return next_piece();
}

Fault ToolVectorMotion::next_piece() {
  const Move& move = move_;
  const std::uint32_t piece = move_.piece++;
  const double share = static_cast<double>(piece) / move.pieces;
  const bool last = piece == move.pieces, arc = move.kind == CommandKind::arc && piece > 0;
  AxisValues target = last  ? move.end
                      : arc ? point_on_arc(move.start, move.end, move.arc, share)
                            : point_on_line(move.start, move.end, share);
  const AxisValues turned = environment_.on_vector_path(move.start, move.direction, share);
  // U V W may turn the tool or be linear axes that the block moves.
  for (const Axis axis : {A, B, C, U, V, W})
    if (is_rotary(axis) || turned[axis] != move.start[axis]) target[axis] = turned[axis];
  if (last) context_.activity = Activity::none;
  bool linear = false;
  if (!output_.moves_to(target, linear) && !arc) return {};
  state_.locate(target);
  Command& made = output_.push(arc                               ? CommandKind::arc
                               : move.kind == CommandKind::rapid ? CommandKind::rapid
                                                                 : CommandKind::line);
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
    made.modal.feed /= words_.length_scale();
  return {};
}

}  // namespace trunnion::language
