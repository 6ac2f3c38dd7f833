// SPDX-License-Identifier: Apache-2.0
// The bodies of the machine: what they let a channel do (`collision` in machine.yaml, docs/collision.md).
#include "channel_core.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

using machine::CollisionMode;

void ChannelCore::guard(CollisionMode mode, const collision_guard::BodiesText& bodies) {
  program_guard_ = std::make_unique<collision_guard::CollisionGuard>(machine_, mode, bodies);
  manual_guard_ = std::make_unique<collision_guard::CollisionGuard>(machine_, mode, bodies);
  program_flow_.set_guard(program_guard_.get());
  mdi_flow_.set_guard(manual_guard_.get());
  if (parameters_) configure_guards();
}

// With bodies that cannot be used nothing moves: whoever demanded the check relies on it.
void ChannelCore::configure_guards() {
  guard_error_.clear();
  for (auto* guard : {program_guard_.get(), manual_guard_.get()}) {
    if (guard == nullptr) continue;
    try {
      guard->configure(*parameters_, number_);
    } catch (const std::exception& e) {
      guard_error_ = e.what();
    }
  }
  if (!guard_error_.empty()) event(alarm::bodies_invalid, guard_error_);
}

void ChannelCore::hold_guarded_axes() {
  for (auto* guard : {program_guard_.get(), manual_guard_.get()})
    if (guard != nullptr) guard->hold_axes(lock_.mask(), lock_.hold({}));
}

void ChannelCore::report_guard() {
  auto* guard = states_.is(Activity::mdi) ? manual_guard_.get() : program_guard_.get();
  if (guard == nullptr || !guard->has_warnings()) return;
  for (auto& line : guard->take_warnings()) event(alarm::bodies_near, program_name() + ":" + std::move(line));
}

// A jog without an increment is planned to the end of travel: only where it arrives counts.
void ChannelCore::report_jog_obstacle() {
  if (!jog_obstacle_ || !states_.is(Activity::jog)) return;
  constexpr double arrived = 1e-6;
  const auto& o = *jog_obstacle_;
  if ((path().position()[o.axis] - o.position) * o.direction < -arrived) return;
  event(guards_stop() ? alarm::bodies_would_meet : alarm::bodies_near, o.text);
  jog_obstacle_.reset();
}

// Empty, or what is in the way of the moves from here with the tool that is in the spindle.
std::string ChannelCore::approach_obstacle(const std::vector<language::Command>& moves) {
  if (manual_guard_ == nullptr) return "";
  hold_guarded_axes();
  auto modal = power_on_modal();
  modal.length_offset = program_flow_.executing().length_offset;
  auto at = machine_start_;
  for (const auto& move : moves) {
    if (const auto obstacle = manual_guard_->obstacle(at, move.target, modal)) {
      if (guards_stop()) return obstacle->text;
      event(alarm::bodies_near,
            program_name() + ":" + std::to_string(move.line) + ": on the approach " + obstacle->text);
      return "";
    }
    at = move.target;
  }
  return "";
}

std::optional<Refusal> ChannelCore::guard_jog(AxisMove& move) {
  jog_obstacle_.reset();
  if (manual_guard_ == nullptr) return std::nullopt;
  hold_guarded_axes();
  auto modal = mdi_.modal;
  modal.tool = static_cast<std::uint16_t>(tool_);
  const auto target = manual_.command(move, machine_start_).target;
  const auto obstacle = manual_guard_->obstacle(machine_start_, target, modal);
  if (!obstacle) return std::nullopt;
  const double from = machine_start_[move.axis], whole = target[move.axis] - from;
  const std::string text = std::string("JOG ") + language::axis_letters[move.axis] + ": " + obstacle->text;
  if (guards_stop()) {
    constexpr double shortest = 1e-3;  // mm or degrees
    if (std::abs(obstacle->share * whole) < shortest) return Refusal{&alarm::bodies_would_meet, text};
    move.target = from + obstacle->share * whole;
  }
  jog_obstacle_ = JogObstacle{move.axis, from + obstacle->share * whole, whole > 0 ? 1.0 : -1.0, text};
  return std::nullopt;
}

std::optional<Refusal> ChannelCore::guard_reference(const AxisMove& move) {
  AxisMove part = move;
  auto refusal = guard_jog(part);
  if (!refusal && jog_obstacle_ && guards_stop())
    refusal = Refusal{&alarm::bodies_would_meet, jog_obstacle_->text};
  if (refusal) jog_obstacle_.reset();
  return refusal;
}

// What of `distance` is free. The other axes are taken where they are going.
double ChannelCore::guard_handwheel(std::uint8_t axis, double distance) {
  if (!guards_stop() || distance == 0) return distance;
  hold_guarded_axes();
  auto modal = mdi_.modal;
  modal.tool = static_cast<std::uint16_t>(tool_);
  auto from = machine_start_;
  for (std::size_t i = 0; i < from.size(); ++i) from[i] += manual_.wheel_target()[i];
  auto to = from;
  to[axis] += distance;
  const auto obstacle = manual_guard_->obstacle(from, to, modal);
  return obstacle ? obstacle->share * distance : distance;
}

}  // namespace trunnion::channel
