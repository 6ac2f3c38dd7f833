// SPDX-License-Identifier: Apache-2.0
#include "channel_bodies.hpp"

#include <cmath>
#include <utility>

#include "machine/alarm_constants.hpp"

namespace trunnion::channel {

void ChannelBodies::demand(machine::CollisionMode mode, const collision_guard::BodiesText& bodies) {
  program_ = std::make_unique<collision_guard::CollisionGuard>(machine_, mode, bodies);
  manual_ = std::make_unique<collision_guard::CollisionGuard>(machine_, mode, bodies);
}

void ChannelBodies::configure(const machine::Parameters& parameters, std::uint16_t channel) {
  error_.clear();
  for (auto* guard : {program_.get(), manual_.get()}) {
    if (guard == nullptr) continue;
    try {
      guard->configure(parameters, channel);
    } catch (const std::exception& e) {
      error_ = e.what();
    }
  }
}

void ChannelBodies::tools_changed() {
  for (auto* guard : {program_.get(), manual_.get()})
    if (guard != nullptr) guard->tools_changed();
}

void ChannelBodies::hold_axes(std::uint16_t mask, const AxisValues& held) {
  for (auto* guard : {program_.get(), manual_.get()})
    if (guard != nullptr) guard->hold_axes(mask, held);
}

std::vector<std::string> ChannelBodies::take_warnings(bool program) {
  auto* guard = program ? program_.get() : manual_.get();
  if (guard == nullptr || !guard->has_warnings()) return {};
  return guard->take_warnings();
}

std::optional<ChannelBodies::Obstacle> ChannelBodies::on_approach(const AxisValues& from,
                                                                  const std::vector<language::Command>& moves,
                                                                  const language::ModalState& modal) {
  if (!demanded()) return std::nullopt;
  auto at = from;
  for (const auto& move : moves) {
    if (const auto obstacle = manual_->obstacle(at, move.target, modal))
      return Obstacle{move.line, obstacle->text};
    at = move.target;
  }
  return std::nullopt;
}

std::optional<Refusal> ChannelBodies::guard_jog(AxisMove& move, const AxisValues& from,
                                                const AxisValues& target, const language::ModalState& modal) {
  jog_.reset();
  if (!demanded()) return std::nullopt;
  const auto obstacle = manual_->obstacle(from, target, modal);
  if (!obstacle) return std::nullopt;
  const double start = from[move.axis], whole = target[move.axis] - start;
  const std::string text = std::string("JOG ") + language::axis_letters[move.axis] + ": " + obstacle->text;
  if (stop()) {
    constexpr double shortest = 1e-3;  // mm or degrees
    if (std::abs(obstacle->share * whole) < shortest) return Refusal{&alarm::bodies_would_meet, text};
    move.target = start + obstacle->share * whole;
  }
  jog_ = JogObstacle{move.axis, start + obstacle->share * whole, whole > 0 ? 1.0 : -1.0, text};
  return std::nullopt;
}

std::optional<Refusal> ChannelBodies::guard_reference(const AxisMove& move, const AxisValues& from,
                                                      const AxisValues& target,
                                                      const language::ModalState& modal) {
  AxisMove part = move;
  auto refusal = guard_jog(part, from, target, modal);
  if (!refusal && jog_ && stop()) refusal = Refusal{&alarm::bodies_would_meet, jog_->text};
  if (refusal) jog_.reset();
  return refusal;
}

double ChannelBodies::free_distance(std::uint8_t axis, double distance, const AxisValues& from,
                                    const language::ModalState& modal) {
  auto to = from;
  to[axis] += distance;
  const auto obstacle = manual_->obstacle(from, to, modal);
  return obstacle ? obstacle->share * distance : distance;
}

std::optional<std::string> ChannelBodies::jog_arrived(const AxisValues& position) {
  if (!jog_) return std::nullopt;
  constexpr double arrived = 1e-6;
  if ((position[jog_->axis] - jog_->position) * jog_->direction < -arrived) return std::nullopt;
  auto text = std::move(jog_->text);
  jog_.reset();
  return text;
}

}  // namespace trunnion::channel
