// SPDX-License-Identifier: Apache-2.0
// The bodies of the machine: what they let a channel do (`collision` in machine.yaml, docs/collision.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "answer.hpp"
#include "collision_guard/collision_guard.hpp"
#include "manual_motion.hpp"

namespace trunnion::channel {

/// Positions are machine coordinates; the tool is that of `modal`.
class ChannelBodies {
 public:
  /// Of a move on the approach.
  struct Obstacle {
    std::uint32_t line = 0;
    std::string text;
  };

  /// `machine` must outlive this.
  explicit ChannelBodies(const channel_setup::ChannelSetup& machine) : machine_(machine) {}

  /// Before it nothing is checked, and every move is free.
  void demand(machine::CollisionMode mode, const collision_guard::BodiesText& bodies);
  bool demanded() const { return manual_ != nullptr; }
  /// What leads bodies together is not moved; false: it is reported at most.
  bool stop() const { return demanded() && manual_->mode() == machine::CollisionMode::stop; }
  /// When the machine has been configured with `parameters`.
  void configure(const machine::Parameters& parameters, std::uint16_t channel);
  /// Why the bodies cannot be used, else empty. Nothing may move then: whoever demanded the check relies on
  /// it.
  const std::string& error() const { return error_; }
  void tools_changed();
  /// As CollisionGuard::hold_axes().
  void hold_axes(std::uint16_t mask, const AxisValues& held);

  /// Of the program's path, and of that of everything else; null unless the check is demanded.
  program_execution::MoveGuard* of_program() const { return program_.get(); }
  program_execution::MoveGuard* of_manual() const { return manual_.get(); }
  /// As CollisionGuard::take_warnings().
  std::vector<std::string> take_warnings(bool program);

  /// The first thing in the way of `moves` from `from`.
  std::optional<Obstacle> on_approach(const AxisValues& from, const std::vector<language::Command>& moves,
                                      const language::ModalState& modal);
  /// `target` is where `move` leads. With stop() the move is cut short before the bodies meet, or refused.
  std::optional<Refusal> guard_jog(AxisMove& move, const AxisValues& from, const AxisValues& target,
                                   const language::ModalState& modal);
  /// With stop() a move that would have to be cut short is refused.
  std::optional<Refusal> guard_reference(const AxisMove& move, const AxisValues& from,
                                         const AxisValues& target, const language::ModalState& modal);
  /// What of `distance` the axis may move from `from` before bodies meet. Only when the check is demanded.
  double free_distance(std::uint8_t axis, double distance, const AxisValues& from,
                       const language::ModalState& modal);

  /// What is in the way of the jog, once, when the path has arrived there. A jog without an increment is
  /// planned to the end of travel: only where it arrives counts.
  std::optional<std::string> jog_arrived(const AxisValues& position);
  /// The jog has ended.
  void forget_jog() { jog_.reset(); }

 private:
  /// Where a jog reaches the clearance of two bodies.
  struct JogObstacle {
    std::uint8_t axis = 0;
    double position = 0, direction = 1;
    std::string text;
  };

  const channel_setup::ChannelSetup& machine_;
  std::unique_ptr<collision_guard::CollisionGuard> program_, manual_;
  std::string error_;
  std::optional<JogObstacle> jog_;
};

}  // namespace trunnion::channel
