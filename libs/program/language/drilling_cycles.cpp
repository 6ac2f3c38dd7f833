// SPDX-License-Identifier: Apache-2.0
#include "language/drilling_cycles.hpp"

#include <cmath>
#include <cstdio>

#include "language/arc_geometry.hpp"

namespace trunnion::language {
namespace {

constexpr double smallest_peck = 0.001;  // mm
constexpr std::uint32_t most_holes = 9999;
constexpr std::uint32_t spindle_stop = 5;  // M5

}  // namespace

void DrillingCycles::reset() {
  pattern_.clear();
  hole_.stop();
}

// Words of a cycle stay until G80 or a motion code; X Y Z R of a block drill a hole with them.
Fault DrillingCycles::run() {
  const bool named = words_.g().has(Group::cycle);
  const std::uint32_t place_words = axis_bits | Block::bit('R');
  const bool drills = (words_.letters() & place_words) != 0;
  if (!named && !drills) return {};
  const std::uint16_t at = named ? words_.g().offset(Group::cycle) : words_.offset_of_any(place_words);
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (const Fault fault = read_cycle_words()) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  words_.use_axes();
  std::uint32_t repeats = 1;
  if (const Fault fault = read_repeats(repeats)) return fault;
  if (!drills || repeats == 0) return {};
  if (const Fault fault = check_cycle(at)) return fault;
  AxisValues target{};
  if (const Fault fault = place_holes(at, axes, repeats, target)) return fault;
  // Other axes (a table) turn with the first positioning.
  if (const Fault fault = rapid_to(target)) return fault;
  return begin_holes();
}

Fault DrillingCycles::read_repeats(std::uint32_t& repeats) {
  const bool repeats_by_k = !words_.haas() && words_.has('K') && !words_.used('K');
  if (repeats_by_k && words_.has('L')) return {AlarmNumber::cycle_repeats, words_.offset('L')};
  for (const char letter : {'K', 'L'}) {
    if (!words_.has(letter) || words_.used(letter) || (letter == 'K' && !repeats_by_k)) continue;
    // On other controls K is the lead.
    if (is_tapping(state_.modal.cycle) && words_.value(letter) != std::floor(words_.value(letter)))
      return {AlarmNumber::not_an_integer, words_.offset(letter), "K and L are repetitions, the lead is F"};
    if (const Fault fault = words_.whole_number(letter, 0, most_holes, repeats)) return fault;
  }
  return {};
}

Fault DrillingCycles::place_holes(std::uint16_t at, std::uint32_t axes, std::uint32_t repeats,
                                  AxisValues& target) {
  const ModalState& modal = state_.modal;
  const PlaneAxes plane = plane_axes(modal.plane);
  const std::uint32_t placed = axes & ~(1u << plane.normal);
  const AxisValues before = state_.program_position;
  target = programmed_target(placed);
  const HolePattern::Point first{target[plane.first], target[plane.second]};
  HolePattern::Point step{};
  if (!modal.absolute) step = {first[0] - before[plane.first], first[1] - before[plane.second]};
  pattern_.line(first, step, repeats);
  if (!modal.polar || modal.absolute || repeats <= 1) return {};
  // An incremental radius moves the centre with every hole, so it has no repetition.
  if (((placed >> plane.first) & 1u) != 0) return {AlarmNumber::cycle_repeats, at};
  const double angle = ((placed >> plane.second) & 1u) != 0 ? words_.value(axis_letters[plane.second]) : 0;
  ProgramSettings& polar = state_.change_settings();
  pattern_.circle(polar.polar_centre, polar.polar_radius, polar.polar_angle, angle, repeats);
  polar.polar_angle = std::fmod(polar.polar_angle + angle * (repeats - 1), 360.0);
  return {};
}

Fault DrillingCycles::read_cycle_words() {
  CycleWords& words = state_.change_settings().cycle;
  HoleParameters& hole = words.hole;
  const ModalState& modal = state_.modal;
  constexpr std::uint8_t back_boring = 87;
  if (words_.haas() && !words.has_r && modal.cycle != back_boring) hole.r = hole.initial, words.has_r = true;
  if (words_.has('R')) {
    const double word = words_.length('R');
    hole.r = modal.absolute ? word : hole.initial + word;
    words.has_r = true;
  }
  const std::uint8_t normal = plane_axes(modal.plane).normal;
  if (words_.has(axis_letters[normal])) {
    const double word = words_.axis(normal);
    hole.z = modal.absolute ? word : hole.r + word;
    words.has_depth = true;
  }
  if (const Fault fault = read_settings(words)) return fault;
  if (words_.haas()) return read_haas_words(words);
  return is_tapping(modal.cycle) && words_.has('J') ? read_tapping_axis(words) : Fault{};
}

// P and Q may belong to a modal code of the block: G54.1 P, G64 P, G5.1 Q.
Fault DrillingCycles::read_settings(CycleWords& words) {
  const bool shifts = is_shifting(state_.modal.cycle);
  if (words_.has('P') && !words_.used('P')) {
    if (const Fault fault = words_.dwell(longest_dwell, words.hole.dwell)) return fault;
  }
  if (words_.has('Q') && !words_.used('Q')) {
    const double q = std::abs(words_.length('Q'));
    if (shifts) {
      const int axis = environment_.cycle_settings().shift_axis;
      words.shift = {};
      words.shift[std::abs(axis) == 2 ? 1 : 0] = axis < 0 ? -q : q;
    } else {
      if (q > 0 && q < smallest_peck) return {AlarmNumber::cycle_peck_missing, words_.offset('Q')};
      words.hole.peck = q;
      words.has_q = true;
    }
  }
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  const char first = static_cast<char>('I' + plane.first), second = static_cast<char>('I' + plane.second);
  if (shifts && (words_.has(first) || words_.has(second))) {
    words.shift = {words_.length(first), words_.length(second)};
  }
  return {};
}

// J names the letter under which the channel has the spindle as an axis.
Fault DrillingCycles::read_tapping_axis(CycleWords& words) {
  if (const Fault fault = words_.whole_number('J', 1, 6, words.tapping_axis)) return fault;
  const std::uint32_t axis = A + words.tapping_axis - 1;
  if (((environment_.spindle_axes() >> axis) & 1u) != 0) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::value_range;
  std::snprintf(detail.text.data(), detail.text.size(), "%c: 04c%03u must be -2", axis_letters[axis],
                axis + 1);
  return {detail.number, words_.offset('J')};
}

Fault DrillingCycles::check_cycle(std::uint16_t at) const {
  const ModalState& modal = state_.modal;
  const CycleWords& words = state_.settings().cycle;
  if (!words.has_depth || !words.has_r) return {AlarmNumber::cycle_depth_missing, at};
  if (modal.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  if (const Fault fault = check_pecks(at)) return fault;
  if (is_shifting(modal.cycle) && words.shift[0] == 0 && words.shift[1] == 0) {
    return {AlarmNumber::cycle_shift_missing, at};
  }
  if (is_shifting(modal.cycle) && !words_.has_function(m_code(19)))
    return {AlarmNumber::unknown_m, at, "needs M19"};
  if (const Fault fault = check_levels(at)) return fault;
  if (modal.cycle == 87 && !modal.return_to_initial) return {AlarmNumber::cycle_return_level, at};
  const bool tapping = is_tapping(modal.cycle);
  if (tapping && !(modal.feed > 0)) return {AlarmNumber::cycle_lead_missing, at};
  if (const Fault fault = check_feed(at)) return fault;
  const bool speed = modal.spindle_mode == SpindleMode::speed && modal.spindle_speed > 0;
  if (tapping && !speed) return {AlarmNumber::cycle_lead_missing, at};
  return {};
}

// Fanuc refuses G73 and G83 without Q and with Q0 (alarm PS0045), and posts send Q0 for a hole without pecks.
Fault DrillingCycles::check_pecks(std::uint16_t at) const {
  const CycleWords& words = state_.settings().cycle;
  if (!is_pecking(state_.modal.cycle) || words.hole.peck > 0) return {};
  const OneStroke rule = environment_.cycle_settings().one_stroke;
  const bool allowed = rule == OneStroke::always || (rule == OneStroke::by_zero && words.has_q);
  return allowed ? Fault{} : Fault{AlarmNumber::cycle_peck_missing, at};
}

// In the plane that the spindle is square to, the tool drills from R down to the depth, in back boring (G87)
// up. In the other planes an angle head may point either way. A mirror of Z exchanges the two in the
// program's numbers. Equal levels leave nothing to drill: the rapid to R would reach the bottom.
Fault DrillingCycles::check_levels(std::uint16_t at) const {
  const HoleParameters& hole = state_.settings().cycle.hole;
  bool good = hole.z != hole.r;
  if (good && state_.modal.plane == Plane::xy) {
    AxisValues r = state_.program_position, depth = r;
    r[Z] = hole.r;
    depth[Z] = hole.z;
    const double upwards =
        state_.frame().contour_from_program(depth)[Z] - state_.frame().contour_from_program(r)[Z];
    good = state_.modal.cycle == 87 ? upwards > 0 : upwards < 0;
  }
  if (good) return {};
  FaultDetail& detail = context_.detail;
  detail.number = AlarmNumber::cycle_level_side;
  std::snprintf(detail.text.data(), detail.text.size(), "R %.3f mm, depth %.3f mm", hole.r, hole.z);
  return {detail.number, words_.has('R') ? words_.offset('R') : at};
}

Fault DrillingCycles::read_pattern(std::uint16_t at, bool may_turn, Pattern& pattern) {
  if (state_.modal.cycle == 80) return {AlarmNumber::pattern_without_cycle, at};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (words_.haas() && words_.g().has(Group::cycle)) {
    if (const Fault fault = read_cycle_words()) return fault;
    words_.use(axis_letters[plane_axes(state_.modal.plane).normal]);
  }
  if (const Fault fault = check_cycle(at)) return fault;
  const char count = words_.haas() ? 'L' : 'K';
  for (const char letter : {'I', 'J', count}) {
    if (!words_.has(letter)) return {AlarmNumber::missing_word, at, needs(letter)};
    words_.use(letter);
  }
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  std::uint32_t axes = 0;
  if (const Fault fault = words_.find_axes(axes)) return fault;
  const std::uint32_t in_plane = axes & (1u << plane.first | 1u << plane.second);
  for (const std::uint8_t axis : {plane.first, plane.second}) words_.use(axis_letters[axis]);
  const AxisValues place = programmed_target(in_plane);
  pattern.point = {place[plane.first], place[plane.second]};
  pattern.i = words_.length('I');
  pattern.j = words_.value('J');
  const double k = words_.value(count);
  if (k != std::floor(k)) return {AlarmNumber::not_an_integer, words_.offset(count)};
  pattern.clockwise = k < 0;
  if (k == 0 || std::abs(k) > most_holes || (pattern.clockwise && !may_turn)) {
    return {AlarmNumber::value_range, words_.offset(count)};
  }
  pattern.count = static_cast<std::uint32_t>(std::abs(k));
  return {};
}

Fault DrillingCycles::drill_circle(std::uint16_t at) {
  Pattern p;
  if (const Fault fault = read_pattern(at, true, p)) return fault;
  const double step = 360.0 / p.count;
  pattern_.circle(p.point, p.i, p.j, p.clockwise ? -step : step, p.count);
  return begin_holes();
}

Fault DrillingCycles::drill_arc(std::uint16_t at) {
  Pattern p;
  if (const Fault fault = read_pattern(at, true, p)) return fault;
  const char angle = words_.haas() ? 'K' : 'P';
  if (!words_.has(angle)) return {AlarmNumber::missing_word, at, needs(angle)};
  words_.use(angle);
  pattern_.circle(p.point, p.i, p.j, p.clockwise ? -words_.value(angle) : words_.value(angle), p.count);
  return begin_holes();
}

Fault DrillingCycles::drill_line(std::uint16_t at) {
  Pattern p;
  if (const Fault fault = read_pattern(at, false, p)) return fault;
  const double angle = p.j / degrees_per_radian;
  pattern_.line(p.point, {p.i * std::cos(angle), p.i * std::sin(angle)}, p.count);
  return begin_holes();
}

Fault DrillingCycles::drill_grid(std::uint16_t at) {
  Pattern p;
  if (const Fault fault = read_pattern(at, false, p)) return fault;
  if (!words_.has('P')) return {AlarmNumber::missing_word, at, needs('P')};
  std::uint32_t columns = 0;
  if (const Fault fault = words_.whole_number('P', 1, most_holes, columns)) return fault;
  pattern_.grid(p.point, p.i, columns, p.j * words_.length_scale(), p.count);
  return begin_holes();
}

Fault DrillingCycles::begin_holes() {
  if (const Fault fault = check_retract()) return fault;
  ModalState& modal = state_.modal;
  HoleParameters& hole = state_.change_settings().cycle.hole;
  const CycleSettings settings = environment_.cycle_settings();
  hole.cycle = modal.cycle;
  if (!hole.linuxcnc) {
    hole.retract = settings.retract;
    hole.clearance = settings.clearance;
  }
  hole.return_to_initial = modal.return_to_initial;
  hole.restart = modal.spindle_direction == SpindleDirection::ccw ? 4 : 3;
  lead_ = modal.feed_mode == FeedMode::per_revolution ? modal.feed
          : modal.spindle_speed > 0                   ? modal.feed / modal.spindle_speed
                                                      : 0;
  if (modal.cycle == 74) lead_ = -lead_;
  if (is_tapping(modal.cycle) && modal.spindle_direction != SpindleDirection::stopped) {
    state_.parked = modal.spindle_direction;
    modal.spindle_direction = SpindleDirection::stopped;
    output_.push(CommandKind::auxiliary).number = spindle_stop;
  }
  context_.activity = Activity::holes;
  hole_.stop();
  return next_step();
}

void DrillingCycles::restart_spindle() {
  if (state_.parked == SpindleDirection::stopped || is_tapping(state_.modal.cycle)) return;
  bool commanded = false;
  const MCodes& m = words_.m();
  for (std::size_t i = 0; i < m.count; ++i) commanded |= m.codes[i].group == MGroup::spindle;
  if (!commanded) {
    state_.modal.spindle_direction = state_.parked;
    output_.push(CommandKind::auxiliary).number = state_.parked == SpindleDirection::cw ? 3 : 4;
  }
  state_.parked = SpindleDirection::stopped;
}

Fault DrillingCycles::next_step() {
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  constexpr int most_steps = 1000;  // steps without motion make no command; the thread must come back
  for (int i = 0; i < most_steps && output_.queue_empty(); ++i) {
    HoleStep next;
    if (hole_.next(next)) {
      if (const Fault fault = step(next)) return fault;
      continue;
    }
    if (!pattern_.next(place_)) {
      context_.activity = Activity::none;
      return {};
    }
    AxisValues target = state_.program_position;
    target[plane.first] = place_[0];
    target[plane.second] = place_[1];
    if (const Fault fault = rapid_to(target)) return fault;
    hole_.start(state_.settings().cycle.hole);
  }
  return {};
}

Fault DrillingCycles::step(const HoleStep& step) {
  const PlaneAxes plane = plane_axes(state_.modal.plane);
  AxisValues target = state_.program_position;
  switch (step.kind) {
    case HoleStep::Kind::rapid:
      target[plane.normal] = step.value;
      return rapid_to(target);
    case HoleStep::Kind::feed:
      target[plane.normal] = step.value;
      return output_.move_straight({CommandKind::line}, target);
    case HoleStep::Kind::tap: {
      target[plane.normal] = step.value;
      StraightMove stroke{CommandKind::tap};
      stroke.number = state_.settings().cycle.tapping_axis;
      stroke.value = lead_;
      stroke.hole_speed = retract_speed();
      if (step.number != 0) stroke.spindle_speed = stroke.hole_speed;
      return output_.move_straight(stroke, target);
    }
    case HoleStep::Kind::shift:
    case HoleStep::Kind::unshift: {
      const std::array<double, 2>& shift = state_.settings().cycle.shift;
      const double by = step.kind == HoleStep::Kind::shift ? 1 : 0;
      target[plane.first] = place_[0] + by * shift[0];
      target[plane.second] = place_[1] + by * shift[1];
      return rapid_to(target);
    }
    case HoleStep::Kind::dwell:
      output_.push(CommandKind::dwell).dwell_seconds = step.value;
      return {};
    case HoleStep::Kind::auxiliary:
      break;
  }
  if (step.number == 3 || step.number == 4) {
    state_.modal.spindle_direction = step.number == 3 ? SpindleDirection::cw : SpindleDirection::ccw;
  } else if (step.number != 0) {
    state_.modal.spindle_direction = SpindleDirection::stopped;
  }
  output_.push(CommandKind::auxiliary).number = step.number;
  return {};
}

}  // namespace trunnion::language
