// SPDX-License-Identifier: Apache-2.0
#include "language/positioning.hpp"

#include <cmath>
#include <cstdio>

#include "language/letters.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t highest_skip_input = 4;
constexpr double reference_window = 1e-3;  // mm or degrees, by which words are rounded

}  // namespace

Fault Positioning::dwell(std::uint16_t at) {
  double seconds = 0;
  char found = '\0';
  for (const char letter : {'P', 'X', 'U'}) {
    // The first one is the time; a second one is left over and reported as such.
    if (!words_.has(letter) || found != '\0') continue;
    found = letter;
    words_.use(letter);
    seconds = words_.value(letter);
    if (letter != 'P') continue;
    if (const Fault fault = words_.dwell(longest_dwell, seconds)) return fault;
  }
  if (found == '\0') return {AlarmNumber::missing_word, at, "needs P, X or U"};
  if (seconds < 0 || seconds > longest_dwell) return {AlarmNumber::value_range, words_.offset(found)};
  output_.push(CommandKind::dwell).dwell_seconds = seconds;
  return {};
}

Fault Positioning::check_machine_coordinates(std::uint16_t at) const {
  if (state_.modal.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  return output_.refuse_in_compensation(at);
}

// The end is known before anything moves.
Fault Positioning::check_reference(std::uint16_t at) {
  if (const Fault fault = check_machine_coordinates(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  const AxisValues end = programmed_target(axes);
  const AxisValues machine = state_.command_from_program(end);
  const AxisValues reference = environment_.reference_position();
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0) continue;
    double away = machine[axis] - reference[axis];
    if (environment_.rotary_way(axis) != canonical::RotaryWay::linear) away = std::remainder(away, 360.0);
    if (std::abs(away) <= reference_window) continue;
    FaultDetail& detail = context_.detail;
    detail.number = AlarmNumber::reference_missed;
    std::snprintf(detail.text.data(), detail.text.size(), "%c would be at %.4f, not at %.4f",
                  axis_letters[axis], machine[axis], reference[axis]);
    return {detail.number, words_.offset(axis_letters[axis])};
  }
  return output_.move_straight({CommandKind::rapid}, end);
}

// D has been taken before the block acts.
Fault Positioning::find_offset(std::uint16_t at, double& offset) const {
  offset = 0;
  const std::uint16_t number = state_.modal.radius_offset;
  if (number == 0) return {};
  const auto tool = context_.tables.tool(number);
  if (!tool || !tool->radius)
    return {AlarmNumber::radius_undefined, words_.has('D') ? words_.offset('D') : at};
  offset = *tool->radius + environment_.cutter_settings().wear_sign * tool->radius_wear;
  return {};
}

// With G91 a word of 0 goes by the offset alone, and its sign says where to.
Fault Positioning::move_by_offset(std::uint16_t at, int times) {
  const ModalState& modal = state_.modal;
  if (!state_.frame().plain() || modal.polar) return {AlarmNumber::frame_shift, at};
  if (modal.motion > 1 || modal.tool_vector) return {AlarmNumber::offset_move, at};
  if (words_.has('H') && !words_.used('H'))
    return {AlarmNumber::unused_word, words_.offset('H'), "the offset of G45 to G48 is D"};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  double offset = 0;
  if (const Fault fault = find_offset(at, offset)) return fault;
  AxisValues target = programmed_target(axes);
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) == 0 || is_rotary(axis)) continue;
    const double way = modal.absolute ? target[axis] - state_.program_position[axis] : words_.axis(axis);
    if (way == 0 && modal.absolute) continue;
    const double farther = times * offset;
    target[axis] += std::signbit(way) ? -farther : farther;
  }
  if (modal.motion == 1) {
    if (const Fault fault = check_feed(at)) return fault;
  }
  return output_.move_straight({modal.motion == 1 ? CommandKind::line : CommandKind::rapid}, target);
}

Fault Positioning::return_to_reference(std::uint16_t at) {
  if (const Fault fault = check_machine_coordinates(at)) return fault;
  return return_to(at, environment_.reference_position());
}

// The control searches the axes one after the other; what the program does next depends on where they end.
Fault Positioning::home(std::uint16_t at) {
  if (const Fault fault = check_machine_coordinates(at)) return fault;
  double speed = 0;
  if (words_.has('F')) {
    words_.use('F');
    speed = words_.value('F');
    if (!(speed > 0)) return {AlarmNumber::feed_not_positive, words_.offset('F')};
  }
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  search_references(axes, speed);
  return {};
}

Fault Positioning::home_axis(std::size_t axis) {
  if (((environment_.axes() >> axis) & 1u) == 0) return {};
  if (const Fault fault = check_machine_coordinates(0)) return fault;
  const ModalState& modal = state_.modal;
  const bool per_minute = modal.feed_mode == FeedMode::per_minute;
  search_references(1u << axis, per_minute ? modal.feed / words_.length_scale() : 0);
  return {};
}

void Positioning::search_references(std::uint32_t axes, double speed) {
  const AxisValues reference = environment_.reference_position();
  Command& command = output_.push(CommandKind::home);
  command.number = axes;
  command.value = speed;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) command.target[axis] = reference[axis];
  }
  state_.homed = static_cast<std::uint16_t>(state_.homed | axes);
  state_.needs_position = state_.homing = true;
}

Fault Positioning::return_to_numbered_reference(std::uint16_t at) {
  if (const Fault fault = check_machine_coordinates(at)) return fault;
  std::uint32_t number = 2;
  if (words_.has('P')) {
    if (const Fault fault = words_.whole_number('P', 2, 4, number)) return fault;
  }
  const auto reference = environment_.numbered_reference(static_cast<std::uint8_t>(number));
  if (!reference) return {AlarmNumber::reference_undefined, words_.has('P') ? words_.offset('P') : at};
  return return_to(at, *reference);
}

Fault Positioning::return_to(std::uint16_t at, const AxisValues& reference) {
  std::uint32_t axes = environment_.axes();
  AxisValues over = state_.program_position;
  if (!words_.every_axis()) {
    if ((words_.letters() & axis_bits) == 0)
      return {AlarmNumber::missing_word, at, "needs axes: X0 Y0 Z0, or Z0 with G91"};
    if (const Fault fault = words_.take_axes(at, axes)) return fault;
    over = programmed_target(axes);
  }
  if (const Fault fault = output_.move_straight({CommandKind::rapid}, over)) return fault;
  state_.change_settings().intermediate = over;
  AxisValues target = state_.position;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) target[axis] = absolute_target(axis, reference[axis], target[axis]);
  }
  return output_.move_straight_in_command_frame(CommandKind::rapid, target);
}

Fault Positioning::return_from_reference(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  if (!state_.settings().intermediate) return {AlarmNumber::intermediate_missing, at};
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  AxisValues over = state_.program_position;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) over[axis] = (*state_.settings().intermediate)[axis];
  }
  if (const Fault fault = output_.move_straight({CommandKind::rapid}, over)) return fault;
  return output_.move_straight({CommandKind::rapid}, programmed_target(axes));
}

Fault Positioning::move_in_machine_coordinates(std::uint16_t at) {
  // It holds for its block alone: without an axis there is nothing to move.
  if ((words_.letters() & axis_bits) == 0) return {};
  if (state_.modal.transformation == Transformation::rtcp) return {AlarmNumber::machine_coordinates_rtcp, at};
  if (state_.modal.motion > 1) return {AlarmNumber::machine_coordinates_motion, at};
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  AxisValues target = state_.position;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) target[axis] = absolute_target(axis, words_.axis(axis), target[axis]);
  }
  if (state_.modal.motion == 1) {
    if (const Fault fault = check_feed(at)) return fault;
  }
  return output_.move_straight_in_command_frame(
      state_.modal.motion == 1 ? CommandKind::line : CommandKind::rapid, target);
}

// Every axis named arrives from its own side, so that its backlash is taken up the same way each time.
Fault Positioning::approach_from_one_side(std::uint16_t at) {
  if (const Fault fault = check_machine_coordinates(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  const AxisValues target = state_.command_from_program(programmed_target(axes));
  const AxisValues last_move = environment_.approach();
  AxisValues before = target;
  for (std::size_t axis = 0; axis < axis_count; ++axis) {
    if (((axes >> axis) & 1u) != 0) before[axis] -= last_move[axis];
  }
  if (const Fault fault = output_.move_straight_in_command_frame(CommandKind::rapid, before)) return fault;
  return output_.move_straight_in_command_frame(CommandKind::rapid, target);
}

bool Positioning::has_own_p() const {
  if (!words_.has('P') || words_.used('P')) return false;
  const MCodes& m = words_.m();
  for (std::size_t i = 0; i < m.count; ++i)
    if (m.codes[i].action == MAction::call || m.codes[i].action == MAction::go_back) return false;
  return true;
}

// The input is L on HNC-8, and P on Fanuc (B-64484EN, multi-step skip).
Fault Positioning::move_until_skip(std::uint16_t at) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t input = 1;
  const char letter = words_.has('L') ? 'L' : has_own_p() ? 'P' : '\0';
  if (letter != '\0') {
    if (const Fault fault = words_.whole_number(letter, 1, highest_skip_input, input)) return fault;
  }
  return skip_move(at, input);
}

// Mitsubishi M700V/M70V programming manual, 15.3: each code has a feed and inputs of its own.
Fault Positioning::move_until_numbered_skip(std::uint16_t at, std::uint32_t number) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  const SkipSettings settings = environment_.skip_settings(number);
  ModalState& modal = state_.modal;
  const double feed = modal.feed;
  const FeedMode mode = modal.feed_mode;
  if (settings.feed > 0 && !words_.has('F')) {
    // A move of rotary axes alone takes an inch for a degree.
    constexpr std::uint32_t linear_axes = letter_bits("XYZUVW");
    const bool linear = (words_.letters() & linear_axes) != 0;
    modal.feed = settings.feed * (linear ? 1.0 : words_.length_scale());
    modal.feed_mode = FeedMode::per_minute;
  }
  const Fault fault = skip_move(at, settings.input);
  modal.feed = feed;
  modal.feed_mode = mode;
  return fault;
}

Fault Positioning::skip_move(std::uint16_t at, std::uint32_t input) {
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  if (const Fault fault = check_feed(at)) return fault;
  const std::uint32_t sequence = output_.sequence();
  StraightMove move{CommandKind::skip};
  move.number = input;
  const Fault fault = output_.move_straight(move, programmed_target(axes));
  if (fault || sequence == output_.sequence()) return fault;  // nothing to wait for without a move
  state_.needs_position = true;
  return {};
}

}  // namespace trunnion::language
