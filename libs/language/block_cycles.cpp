// The part of BlockExecutor that drills, taps and bores: canned cycles and hole patterns.
#include <bit>
#include <cmath>

#include "language/block_executor.hpp"
#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr double smallest_peck = 0.001;  // mm
constexpr double longest_dwell = 99999.999;
constexpr std::uint32_t most_holes = 9999;
constexpr std::uint32_t spindle_stop = 5;  // M5

constexpr bool is_tapping(std::uint8_t cycle) { return cycle == 74 || cycle == 84; }
constexpr bool is_shifting(std::uint8_t cycle) { return cycle == 76 || cycle == 87; }

}  // namespace

// Words of a cycle stay until the next cycle code; X Y Z R of a block drill a hole with them.
Fault BlockExecutor::run_cycle(const Block& block, const Codes& codes, CommandQueue& out) {
  const bool named = codes.has(Group::cycle);
  const std::uint32_t place_words = axis_bits | Block::bit('R');
  const bool drills = (block.letters & place_words) != 0;
  if (!named && !drills) return {};
  const std::uint16_t at =
      named ? codes.offset(Group::cycle)
            : block.offsets[static_cast<std::size_t>(std::countr_zero(block.letters & place_words))];
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (const Fault fault = read_cycle_words(block, codes)) return fault;

  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  used_ |= block.letters & axis_bits;
  std::uint32_t repeats = 1;
  const bool repeats_by_k = block.has('K') && (used_ & Block::bit('K')) == 0;
  if (repeats_by_k && block.has('L')) return {AlarmNumber::cycle_repeats, block.offset('L')};
  for (const char letter : {'K', 'L'}) {
    if (!block.has(letter) || (used_ & Block::bit(letter)) != 0) continue;
    if (const Fault fault = whole_number(block, letter, 0, most_holes, repeats)) return fault;
  }
  if (!drills || repeats == 0) return {};
  if (const Fault fault = check_cycle(at)) return fault;

  const PlaneAxes plane = plane_axes(modal_.plane);
  const std::uint32_t placed = axes & ~(1u << plane.normal);
  const AxisValues before = program_position_;
  const AxisValues target = programmed_target(block, placed);
  const HolePattern::Point first{target[plane.first], target[plane.second]};
  HolePattern::Point step{};
  if (!modal_.absolute) step = {first[0] - before[plane.first], first[1] - before[plane.second]};
  pattern_.line(first, step, repeats);
  if (modal_.polar && !modal_.absolute && repeats > 1) {
    // An incremental radius moves the centre with every hole, so it has no repetition.
    if (((placed >> plane.first) & 1u) != 0) return {AlarmNumber::cycle_repeats, at};
    const double angle = ((placed >> plane.second) & 1u) != 0 ? block.value(axis_letters[plane.second]) : 0;
    pattern_.circle(polar_centre_, polar_radius_, polar_angle_, angle, repeats);
    polar_angle_ = std::fmod(polar_angle_ + angle * (repeats - 1), 360.0);
  }
  // Other axes (a table) turn with the first positioning.
  if (const Fault fault = move_straight(CommandKind::rapid, target, out)) return fault;
  return begin_holes(out);
}

Fault BlockExecutor::read_cycle_words(const Block& block, const Codes& codes) {
  const std::uint8_t normal = plane_axes(modal_.plane).normal;
  if (codes.has(Group::cycle)) {
    const double initial = cycle_.initial;
    cycle_ = HoleParameters{};
    cycle_.initial = initial;
    shift_ = {};
    tapping_axis_ = 0;
    cycle_.cycle = modal_.cycle;
    cycle_has_depth_ = cycle_has_r_ = false;
    const CycleSettings settings = environment_.cycle_settings();
    cycle_.retract = settings.retract;
    cycle_.clearance = settings.clearance;
  }
  if (block.has('R')) {
    const double word = length_word(block, 'R');
    cycle_.r = modal_.absolute ? word : cycle_.initial + word;
    cycle_has_r_ = true;
  }
  const char depth = axis_letters[normal];
  if (block.has(depth)) {
    const double word = axis_word(block, normal);
    cycle_.z = modal_.absolute ? word : cycle_.r + word;
    cycle_has_depth_ = true;
  }
  // P and Q may belong to a modal code of the block: G54.1 P, G64 P, G5.1 Q.
  const auto has = [&](char letter) { return block.has(letter) && (used_ & Block::bit(letter)) == 0; };
  if (has('P')) {
    use('P');
    cycle_.dwell = block.value('P') / 1000;
    if (cycle_.dwell < 0 || cycle_.dwell > longest_dwell) {
      return {AlarmNumber::value_range, block.offset('P')};
    }
  }
  if (has('Q')) {
    const double q = std::abs(length_word(block, 'Q'));
    if (is_shifting(modal_.cycle)) {
      const int axis = environment_.cycle_settings().shift_axis;
      shift_ = {};
      shift_[std::abs(axis) == 2 ? 1 : 0] = axis < 0 ? -q : q;
    } else {
      if (q < smallest_peck) return {AlarmNumber::cycle_peck_missing, block.offset('Q')};
      cycle_.peck = q;
    }
  }
  const PlaneAxes plane = plane_axes(modal_.plane);
  const char first = static_cast<char>('I' + plane.first), second = static_cast<char>('I' + plane.second);
  if (is_shifting(modal_.cycle) && (block.letters & (Block::bit(first) | Block::bit(second))) != 0) {
    shift_ = {length_word(block, first), length_word(block, second)};
  }
  if (is_tapping(modal_.cycle) && block.has('J')) {
    if (const Fault fault = whole_number(block, 'J', 1, 6, tapping_axis_)) return fault;
    // An axis of its own under that letter is not the spindle.
    const unsigned letter = A + tapping_axis_ - 1;
    if (((channel_axes_ >> letter) & 1u) != 0) return {AlarmNumber::value_range, block.offset('J')};
  }
  return {};
}

Fault BlockExecutor::check_cycle(std::uint16_t at) const {
  if (!cycle_has_depth_ || !cycle_has_r_) return {AlarmNumber::cycle_depth_missing, at};
  if (modal_.feed_mode == FeedMode::inverse_time) return {AlarmNumber::cycle_inverse_time, at};
  const bool pecks = modal_.cycle == 73 || modal_.cycle == 83;
  if (pecks && !(cycle_.peck > 0)) return {AlarmNumber::cycle_peck_missing, at};
  if (is_shifting(modal_.cycle) && shift_[0] == 0 && shift_[1] == 0) {
    return {AlarmNumber::cycle_shift_missing, at};
  }
  if (modal_.cycle == 87 && !modal_.return_to_initial) return {AlarmNumber::cycle_return_level, at};
  if (!(modal_.feed > 0)) {
    return {is_tapping(modal_.cycle) ? AlarmNumber::cycle_lead_missing : AlarmNumber::feed_missing, at};
  }
  const bool speed = modal_.spindle_mode == SpindleMode::speed && modal_.spindle_speed > 0;
  if (is_tapping(modal_.cycle) && !speed) {
    return {AlarmNumber::cycle_lead_missing, at};
  }
  return {};
}

Fault BlockExecutor::run_pattern(const Block& block, const Codes& codes, CommandQueue& out) {
  const std::uint16_t at = codes.offset(Group::one_block);
  const std::uint16_t code = codes.code(Group::one_block);
  if (modal_.cycle == 80) return {AlarmNumber::pattern_without_cycle, at};
  if (const Fault fault = refuse_in_compensation(at)) return fault;
  if (const Fault fault = check_cycle(at)) return fault;
  for (const char letter : {'I', 'J', 'K'}) {
    if (!block.has(letter)) return {AlarmNumber::missing_word, at};
  }
  const PlaneAxes plane = plane_axes(modal_.plane);
  std::uint32_t axes = 0;
  if (const Fault fault = find_axes(block, axes)) return fault;
  const std::uint32_t in_plane = axes & (1u << plane.first | 1u << plane.second);
  used_ |= letter_bits("IJ");
  for (const std::uint8_t axis : {plane.first, plane.second}) use(axis_letters[axis]);
  const AxisValues place = programmed_target(block, in_plane);
  const HolePattern::Point point{place[plane.first], place[plane.second]};
  const double i = length_word(block, 'I');
  const double j = block.value('J');
  std::uint32_t count = 0;
  bool clockwise = false;
  {
    use('K');
    const double k = block.value('K');
    if (k != std::floor(k)) return {AlarmNumber::not_an_integer, block.offset('K')};
    clockwise = k < 0;
    if (k == 0 || std::abs(k) > most_holes || (clockwise && code != 700 && code != 710)) {
      return {AlarmNumber::value_range, block.offset('K')};
    }
    count = static_cast<std::uint32_t>(std::abs(k));
  }
  if (code == 700) {
    const double step = 360.0 / count;
    pattern_.circle(point, i, j, clockwise ? -step : step, count);
  } else if (code == 710) {
    if (!block.has('P')) return {AlarmNumber::missing_word, at};
    use('P');
    pattern_.circle(point, i, j, clockwise ? -block.value('P') : block.value('P'), count);
  } else if (code == 780) {
    const double angle = j / degrees_per_radian;
    pattern_.line(point, {i * std::cos(angle), i * std::sin(angle)}, count);
  } else {
    if (!block.has('P')) return {AlarmNumber::missing_word, at};
    std::uint32_t columns = 0;
    if (const Fault fault = whole_number(block, 'P', 1, most_holes, columns)) return fault;
    pattern_.grid(point, i, columns, j * length_scale(), count);
  }
  return begin_holes(out);
}

Fault BlockExecutor::begin_holes(CommandQueue& out) {
  cycle_.return_to_initial = modal_.return_to_initial;
  cycle_.restart = modal_.spindle_direction == SpindleDirection::ccw ? 4 : 3;
  lead_ = modal_.feed_mode == FeedMode::per_revolution ? modal_.feed
          : modal_.spindle_speed > 0                   ? modal_.feed / modal_.spindle_speed
                                                       : 0;
  if (modal_.cycle == 74) lead_ = -lead_;
  if (is_tapping(modal_.cycle) && modal_.spindle_direction != SpindleDirection::stopped) {
    parked_ = modal_.spindle_direction;
    modal_.spindle_direction = SpindleDirection::stopped;
    push(CommandKind::auxiliary, out).number = spindle_stop;
  }
  activity_ = Activity::holes;
  hole_.stop();
  return next_hole_step(out);
}

// Tapping couples the spindle, which must stand for that. When another code has ended the cycle it turns
// again as before, unless the program has said otherwise meanwhile.
void BlockExecutor::turn_spindle_again(const MCodes& codes, CommandQueue& out) {
  if (parked_ == SpindleDirection::stopped || is_tapping(modal_.cycle)) return;
  bool ordered = false;
  for (std::size_t i = 0; i < codes.count; ++i) ordered |= codes.codes[i].group == MGroup::spindle;
  if (!ordered) {
    modal_.spindle_direction = parked_;
    push(CommandKind::auxiliary, out).number = parked_ == SpindleDirection::cw ? 3 : 4;
  }
  parked_ = SpindleDirection::stopped;
}

// Steps until one of them makes a command, or all holes are done.
Fault BlockExecutor::next_hole_step(CommandQueue& out) {
  const PlaneAxes plane = plane_axes(modal_.plane);
  constexpr int most_steps = 1000;  // steps without a way make no command; the thread must come back
  for (int i = 0; i < most_steps && out.empty(); ++i) {
    HoleStep step;
    if (hole_.next(step)) {
      if (const Fault fault = hole_step(step, out)) return fault;
      continue;
    }
    if (!pattern_.next(hole_place_)) {
      activity_ = Activity::none;
      return {};
    }
    AxisValues target = program_position_;
    target[plane.first] = hole_place_[0];
    target[plane.second] = hole_place_[1];
    if (const Fault fault = move_straight(CommandKind::rapid, target, out)) return fault;
    hole_.start(cycle_);
  }
  return {};
}

Fault BlockExecutor::hole_step(const HoleStep& step, CommandQueue& out) {
  const PlaneAxes plane = plane_axes(modal_.plane);
  AxisValues target = program_position_;
  switch (step.kind) {
    case HoleStep::Kind::rapid:
      target[plane.normal] = step.value;
      return move_straight(CommandKind::rapid, target, out);
    case HoleStep::Kind::feed:
      target[plane.normal] = step.value;
      return move_straight(CommandKind::line, target, out);
    case HoleStep::Kind::tap:
      target[plane.normal] = step.value;
      return move_straight(CommandKind::tap, target, out);
    case HoleStep::Kind::shift:
    case HoleStep::Kind::unshift: {
      const double by = step.kind == HoleStep::Kind::shift ? 1 : 0;
      target[plane.first] = hole_place_[0] + by * shift_[0];
      target[plane.second] = hole_place_[1] + by * shift_[1];
      return move_straight(CommandKind::rapid, target, out);
    }
    case HoleStep::Kind::dwell:
      push(CommandKind::dwell, out).dwell_seconds = step.value;
      return {};
    case HoleStep::Kind::auxiliary:
      break;
  }
  if (step.number == 3 || step.number == 4) {
    modal_.spindle_direction = step.number == 3 ? SpindleDirection::cw : SpindleDirection::ccw;
  } else if (step.number != 0) {
    modal_.spindle_direction = SpindleDirection::stopped;
  }
  push(CommandKind::auxiliary, out).number = step.number;
  return {};
}

}  // namespace trunnion::language
