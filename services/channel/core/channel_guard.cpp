// SPDX-License-Identifier: Apache-2.0
// What the channel asks of the bodies of its machine, and what it reports of them.
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

void ChannelCore::guard(machine::CollisionMode mode, const collision_guard::BodiesText& bodies) {
  bodies_.demand(mode, bodies);
  program_flow_.set_guard(bodies_.of_program());
  mdi_.flow().set_guard(bodies_.of_manual());
  if (parameters_) configure_guards();
}

void ChannelCore::configure_guards() {
  bodies_.configure(*parameters_, number_);
  if (!bodies_.error().empty()) event(alarm::bodies_invalid, bodies_.error());
}

void ChannelCore::report_guard() {
  for (auto& line : bodies_.take_warnings(!states_.is(Activity::mdi)))
    event(alarm::bodies_near, program_name() + ":" + std::move(line));
}

void ChannelCore::report_jog_obstacle() {
  if (!states_.is(Activity::jog)) return;
  if (auto text = bodies_.jog_arrived(path().position()))
    event(bodies_.stop() ? alarm::bodies_would_meet : alarm::bodies_near, std::move(*text));
}

// Empty, or what is in the way of the moves from here with the tool that is in the spindle.
std::string ChannelCore::approach_obstacle(const std::vector<language::Command>& moves) {
  hold_guarded_axes();
  auto modal = power_on_modal();
  modal.length_offset = program_flow_.executing().length_offset;
  const auto obstacle = bodies_.on_approach(machine_start_, moves, modal);
  if (!obstacle) return "";
  if (bodies_.stop()) return obstacle->text;
  event(alarm::bodies_near,
        program_name() + ":" + std::to_string(obstacle->line) + ": on the approach " + obstacle->text);
  return "";
}

language::ModalState ChannelCore::by_hand_modal() const {
  auto modal = mdi_.modal();
  modal.tool = static_cast<std::uint16_t>(tool_);
  return modal;
}

std::optional<Refusal> ChannelCore::guard_jog(AxisMove& move) {
  hold_guarded_axes();
  const auto target = manual_.command(move, machine_start_).target;
  return bodies_.guard_jog(move, machine_start_, target, by_hand_modal());
}

std::optional<Refusal> ChannelCore::guard_reference(const AxisMove& move) {
  hold_guarded_axes();
  const auto target = manual_.command(move, machine_start_).target;
  return bodies_.guard_reference(move, machine_start_, target, by_hand_modal());
}

// What of `distance` is free. The other axes are taken where they are going.
double ChannelCore::guard_handwheel(std::uint8_t axis, double distance) {
  if (!bodies_.stop() || distance == 0) return distance;
  hold_guarded_axes();
  auto from = machine_start_;
  for (std::size_t i = 0; i < from.size(); ++i) from[i] += manual_.wheel_target()[i];
  return bodies_.free_distance(axis, distance, from, by_hand_modal());
}

}  // namespace trunnion::channel
