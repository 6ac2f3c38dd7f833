// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_motion.hpp"

#include "language/linuxcnc_codes.hpp"

namespace trunnion::language {
namespace {

constexpr std::uint32_t probe_input = 1;
constexpr std::uint8_t last_motion = 3;  // G3

}  // namespace

Fault LinuxcncMotion::set_motion(std::uint16_t, std::uint16_t tenths) {
  constexpr std::uint16_t thread = 330;
  state_.own_motion = tenths;
  state_.modal.cycle = 80;
  if (tenths == thread) state_.modal.motion = 33;
  return {};
}

void LinuxcncMotion::note_codes() {
  const GCodes& g = words_.g();
  if (g.has(Group::cycle)) state_.own_motion = g.is(Group::cycle, no_motion) ? no_motion : std::uint16_t{0};
  if (g.has(Group::motion) && g.code(Group::motion).tenths < own_code) state_.own_motion = 0;
}

Fault LinuxcncMotion::move() {
  const ModalState& modal = state_.modal;
  const GCodes& g = words_.g();
  const bool axes = (words_.letters() & axis_bits) != 0;
  // G43.1 and G43.2 have taken them.
  if (axes && g.has(Group::tool_length) && g.code(Group::tool_length).axis_words != AxisWords::move)
    return g.has(Group::motion) ? Fault{AlarmNumber::codes_compete, g.offset(Group::motion)} : Fault{};
  if (state_.own_motion != 0 && state_.own_motion != no_motion) return move_by_own_code();
  if (modal.cycle != 80) return cycles_.run();
  // A code that a program of another dialect has left is none, either.
  if (state_.own_motion == no_motion || modal.motion > last_motion)
    return axes ? Fault{AlarmNumber::linuxcnc_axis_words, words_.offset_of_any(axis_bits)} : Fault{};
  return motion_.move();
}

Fault LinuxcncMotion::move_by_own_code() {
  const GCodes& g = words_.g();
  const bool named = g.has(Group::motion);
  const bool axes = (words_.letters() & axis_bits) != 0;
  if (curves_.open()) return curves_.add_block();
  if (!named && !axes) return {};
  const std::uint16_t at = named ? g.offset(Group::motion) : words_.offset_of_any(axis_bits);
  switch (state_.own_motion) {
    case 50:
      return curves_.cubic(at);
    case 51:
      return curves_.quadratic(at);
    case 52:
      return named ? curves_.begin(at) : Fault{AlarmNumber::linuxcnc_axis_words, at};
    case 330:
      return threads_.cut(at);
    case 331:
      return threads_.tap(at);
    case 382:
      return probe(at, true);
    case 383:
      return probe(at, false);
    default:
      return threads_.begin_passes(at);
  }
}

Fault LinuxcncMotion::move_in_machine_coordinates(std::uint16_t at) {
  if (state_.own_motion != 0 || state_.modal.cycle != 80)
    return {AlarmNumber::machine_coordinates_motion, at};
  if (!state_.modal.absolute) return {AlarmNumber::linuxcnc_function_missing, at, "G53 with G91"};
  return positioning_.move_in_machine_coordinates(at);
}

Fault LinuxcncMotion::probe(std::uint16_t at, bool must_touch) {
  if (const Fault fault = output_.refuse_in_compensation(at)) return fault;
  std::uint32_t axes = 0;
  if (const Fault fault = words_.take_axes(at, axes)) return fault;
  if (state_.modal.feed_mode == FeedMode::per_revolution)
    return {AlarmNumber::linuxcnc_function_missing, at, "probing with G95"};
  if (const Fault fault = check_feed(at)) return fault;
  const std::uint32_t sequence = output_.sequence();
  StraightMove move{CommandKind::skip};
  move.number = probe_input;
  if (const Fault fault = output_.move_straight(move, programmed_target(axes))) return fault;
  if (sequence == output_.sequence()) return {AlarmNumber::value_range, at, "the probe is there already"};
  state_.needs_position = true;
  state_.needs_contact = must_touch;
  return {};
}

}  // namespace trunnion::language
