// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_curves.hpp"

#include "language/linuxcnc_codes.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint16_t cubic_code = 50, nurbs_code = 52, end_code = 53;  // tenths
constexpr std::uint32_t usual_order = 3;
constexpr std::uint8_t in_curve = 62;  // as ModalState::motion

}  // namespace

Fault LinuxcncCurves::check() const {
  if (!open_ || !words_.has_codes()) return {};
  const GCodes& g = words_.g();
  const std::uint32_t own = (g.is(Group::motion, own_code + nurbs_code) ? group_bit(Group::motion) : 0u) |
                            (g.is(Group::one_block, own_code + end_code) ? group_bit(Group::one_block) : 0u);
  if (words_.m().count == 0 && g.present() == own) return {};
  return {AlarmNumber::linuxcnc_curve, words_.first_offset()};
}

Fault LinuxcncCurves::check_curve(std::uint16_t at) {
  constexpr std::uint32_t curve_axes = letter_bits("XY");
  if (state_.modal.plane != Plane::xy)
    return {AlarmNumber::linuxcnc_function_missing, at, "splines outside of G17"};
  const std::uint32_t others = words_.letters() & axis_bits & ~curve_axes;
  if (others != 0) return {AlarmNumber::unused_word, words_.offset_of_any(others)};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (state_.modal.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  return check_feed(at);
}

Fault LinuxcncCurves::read_end(Place& end) {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  const AxisValues target = programmed_target(axes);
  end = {target[X], target[Y]};
  return {};
}

Fault LinuxcncCurves::cubic(std::uint16_t at) {
  if (const Fault fault = check_curve(at)) return fault;
  for (const char letter : {'P', 'Q'})
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
  const bool named = words_.has('I') || words_.has('J');
  const bool continues = state_.at_block_begin().own_motion == cubic_code;
  for (const char letter : {'I', 'J'})
    if ((named || !continues) && !words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
  const Place start{state_.program_position[X], state_.program_position[Y]};
  Place end{};
  if (const Fault fault = read_end(end)) return fault;
  const Place first =
      named ? Place{words_.length('I'), words_.length('J')} : Place{-last_leg_[0], -last_leg_[1]};
  last_leg_ = {words_.length('P'), words_.length('Q')};
  const std::array points{start, Place{start[0] + first[0], start[1] + first[1]},
                          Place{end[0] + last_leg_[0], end[1] + last_leg_[1]}, end};
  return draw(points, at);
}

Fault LinuxcncCurves::quadratic(std::uint16_t at) {
  if (const Fault fault = check_curve(at)) return fault;
  if (!words_.has('I') && !words_.has('J')) return {AlarmNumber::missing_word, at, "needs I or J"};
  const Place start{state_.program_position[X], state_.program_position[Y]};
  Place end{};
  if (const Fault fault = read_end(end)) return fault;
  const std::array points{start, Place{start[0] + words_.length('I'), start[1] + words_.length('J')}, end};
  return draw(points, at);
}

Fault LinuxcncCurves::draw(std::span<const Place> points, std::uint16_t at) {
  curve_.start(static_cast<std::uint32_t>(points.size()), environment_.curve_tolerance());
  for (const Place& place : points) {
    const NurbsCurve::ControlPoint point{{place[0], place[1], state_.program_position[Z]}, 1};
    if (const AlarmNumber alarm = curve_.add(0, point); alarm != AlarmNumber::none) return {alarm, at};
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const AlarmNumber alarm = curve_.add(1); alarm != AlarmNumber::none) return {alarm, at};
  }
  context_.activity = Activity::spline;
  return {};
}

Fault LinuxcncCurves::begin(std::uint16_t at) {
  if (const Fault fault = check_curve(at)) return fault;
  order_ = usual_order;
  if (words_.has('L')) {
    if (const Fault fault = words_.whole_number('L', usual_order, NurbsCurve::most_order, order_))
      return fault;
  }
  curve_.start(order_, environment_.curve_tolerance());
  points_ = 0;
  open_ = true;
  state_.modal.motion = in_curve;
  // Without X and Y the weight is that of the place where the tool is.
  const bool place_only = (words_.letters() & axis_bits) == 0;
  double weight = 1;
  if (place_only) {
    if (const Fault fault = read_weight(weight)) return fault;
  }
  const Place here{state_.program_position[X], state_.program_position[Y]};
  if (const Fault fault = add(here, weight, at)) return fault;
  return place_only ? Fault{} : read_point(at);
}

Fault LinuxcncCurves::add_block() {
  constexpr std::uint32_t point_words = axis_bits | letter_bits("P");
  if ((words_.letters() & point_words) == 0) return {};
  const std::uint16_t at = words_.offset_of_any(point_words);
  if (const Fault fault = check_curve(at)) return fault;
  return read_point(at);
}

// LinuxCNC counts increments from the begin of the curve.
Fault LinuxcncCurves::read_point(std::uint16_t at) {
  if (!state_.modal.absolute) return {AlarmNumber::linuxcnc_function_missing, at, "G5.2 with G91"};
  for (const char letter : {'X', 'Y'})
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
  Place place{};
  if (const Fault fault = read_end(place)) return fault;
  double weight = 1;
  if (const Fault fault = read_weight(weight)) return fault;
  return add(place, weight, at);
}

Fault LinuxcncCurves::read_weight(double& weight) {
  if (!words_.has('P')) return {};
  words_.use('P');
  weight = words_.value('P');
  return weight > 0 ? Fault{} : Fault{AlarmNumber::value_range, words_.offset('P')};
}

Fault LinuxcncCurves::add(const Place& place, double weight, std::uint16_t at) {
  const double knot = points_ < order_ ? 0u : points_ - order_ + 1;
  const NurbsCurve::ControlPoint point{{place[0], place[1], state_.program_position[Z]}, weight};
  ++points_;
  if (const AlarmNumber alarm = curve_.add(knot, point); alarm != AlarmNumber::none) return {alarm, at};
  context_.activity = Activity::spline;
  return {};
}

Fault LinuxcncCurves::close(std::uint16_t at) {
  if (!open_) return {AlarmNumber::linuxcnc_curve, at};
  if (points_ < order_) return {AlarmNumber::curve_control_points, at};
  open_ = false;
  closing_ = true;
  state_.modal.motion = 1;
  state_.own_motion = no_motion;
  context_.activity = Activity::spline;
  return {};
}

// Behind the last point each knot may bring another span.
Fault LinuxcncCurves::next_chord() {
  Vector3 end{};
  while (!curve_.next(end)) {
    if (!closing_ || !curve_.active()) {
      closing_ = false;
      context_.activity = Activity::none;
      return {};
    }
    const double knot = points_ - order_ + 1;
    if (const AlarmNumber alarm = curve_.add(knot); alarm != AlarmNumber::none) return {alarm, 0};
  }
  AxisValues target = state_.program_position;
  target[X] = end[0];
  target[Y] = end[1];
  StraightMove move{CommandKind::line};
  move.chord = curve_.active() && !curve_.at_end();
  return output_.move_straight(move, target);
}

}  // namespace trunnion::language
