// SPDX-License-Identifier: Apache-2.0
#include "language/curve_motion.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::language {
namespace {

constexpr double start_tolerance = 0.001;  // mm

}  // namespace

Fault CurveMotion::check() const {
  if (!curve_.active() || !words_.has_codes()) return {};
  return {AlarmNumber::curve_incomplete, words_.first_offset()};
}

Fault CurveMotion::begin() {
  constexpr std::uint32_t curve_words = letter_bits("KR") | axis_bits;
  const bool named = words_.g().is(Group::motion, 62);
  if (!named && (words_.letters() & curve_words) == 0) return {};
  const std::uint16_t at = named ? words_.g().offset(Group::motion) : words_.offset_of_any(curve_words);
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (state_.modal.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  if (const Fault fault = check_feed(at)) return fault;
  std::uint32_t order = NurbsCurve::most_order;
  if (words_.has('P')) {
    if (const Fault fault = words_.whole_number('P', 2, NurbsCurve::most_order, order)) return fault;
  }
  const AxisValues& start = state_.program_position;
  control_point_ = {start[X], start[Y], start[Z]};
  curve_.start(order, environment_.curve_tolerance());
  // The curve begins where the tool is, so the first point may be left out.
  Fault fault = read_block();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool here = std::abs(control_point_[axis] - start[axis]) <= start_tolerance;
    if (!fault && !here) fault = {AlarmNumber::curve_start, at};
  }
  if (fault) curve_.stop();
  return fault;
}

Fault CurveMotion::add_block() {
  if (const Fault fault = read_block()) {
    curve_.stop();
    return fault;
  }
  context_.activity = Activity::curve;
  return {};
}

Fault CurveMotion::next_chord() {
  Vector3 end{};
  if (!curve_.next(end)) {
    context_.activity = Activity::none;
    return {};
  }
  AxisValues target = state_.program_position;
  std::copy(end.begin(), end.end(), target.begin());
  StraightMove move{CommandKind::line};
  move.chord = curve_.active() && !curve_.at_end();
  return output_.move_straight(move, target);
}

Fault CurveMotion::read_block() {
  const std::uint32_t letters = words_.letters();
  const std::uint16_t at = letters != 0 ? words_.offset_of_any(letters) : words_.first_offset();
  if (!words_.has('K')) return {AlarmNumber::curve_words, at};
  words_.use('K');
  const double knot = words_.value('K');
  constexpr std::uint32_t other_axes = letter_bits("ABCUVW");
  if ((letters & other_axes) != 0) return {AlarmNumber::curve_words, at};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  const bool first = context_.activity == Activity::none && !curve_.has_points();
  if (axes == 0 && !words_.has('R') && !first) return {curve_.add(knot), words_.offset('K')};
  NurbsCurve::ControlPoint point;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    const double word = words_.axis(axis);
    control_point_[axis] = state_.modal.absolute ? word : control_point_[axis] + word;
  }
  words_.use_axes();
  point.point = control_point_;
  if (words_.has('R')) {
    words_.use('R');
    point.weight = words_.value('R');
    if (!(point.weight > 0)) return {AlarmNumber::value_range, words_.offset('R')};
  }
  return {curve_.add(knot, point), words_.offset('K')};
}

}  // namespace trunnion::language
