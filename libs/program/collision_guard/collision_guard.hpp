// SPDX-License-Identifier: Apache-2.0
// Moves of a channel among the bodies of its machine, checked before motion gets them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "channel_setup/channel_setup.hpp"
#include "collision/bodies_file.hpp"
#include "collision/path_check.hpp"
#include "machine/collision_mode.hpp"
#include "motion/path_segment.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::collision_guard {

using language::AxisValues;
using machine::CollisionMode;

/// bodies.yaml of a machine.
struct BodiesText {
  std::string file;
  std::optional<std::string> text;  ///< nothing when there is no such file
};
/// Of the machine in `directory`. Throws std::runtime_error when the file cannot be read.
BodiesText load_bodies_text(const std::string& directory);

/// Where a straight move of the axes would come nearer than the clearance.
struct Obstacle {
  double share = 0;  ///< of the move, 0 .. 1, that is free
  std::string text;  ///< bodies, distance and positions, one line
};

/// The bodies of the machine, with a cylinder by the tool table for the tool in the spindle: T, or H of an
/// active length offset while T is 0. A tool that is not in the table leaves the bodies on the tool of the
/// file.
///
/// A command is cut into straight moves of the axes; how far the axes leave them, and how far the path may
/// leave the command (contour and orientation tolerance), is added to the clearance. Everything is
/// deterministic, and nothing depends on time or feed.
class CollisionGuard : public program_execution::MoveGuard {
 public:
  /// `machine` must outlive the guard. `mode` is warn or stop.
  CollisionGuard(const channel_setup::ChannelSetup& machine, CollisionMode mode, BodiesText bodies);

  /// When `machine` has been configured with `parameters`. Throws std::runtime_error: no bodies.yaml, an
  /// error in it, or a chain without links. Before it, and after it has thrown, every move is a contact.
  void configure(const machine::Parameters& parameters, std::uint16_t channel);
  /// When the tool table has changed.
  void tools_changed() { tool_.reset(); }
  /// Axes of `mask` stay at `held`, machine coordinates.
  void hold_axes(std::uint16_t mask, const AxisValues& held) { held_mask_ = mask, held_ = held; }
  CollisionMode mode() const { return mode_; }

  void begin_run() override;
  void begin_call() override { budget_ = most_distances; }
  /// With CollisionMode::warn a contact is a line of take_warnings(), and the move is free. Bodies on the
  /// tool and bodies on the workpiece's side may touch in a skip move.
  Verdict check(const AxisValues& from, const language::Command& move) override;
  const std::string& contact_text() const override { return contact_text_; }

  /// A straight move of the axes in machine coordinates, with the tool of `modal`; nothing when it is free.
  std::optional<Obstacle> obstacle(const AxisValues& from, const AxisValues& to,
                                   const language::ModalState& modal);
  bool has_warnings() const { return !warnings_.empty(); }
  /// One line for each stretch of moves that leads bodies within the clearance, since the last time.
  std::vector<std::string> take_warnings() { return std::exchange(warnings_, {}); }

  /// Distances computed so far.
  std::uint64_t distances() const { return check_ ? check_->distances() : 0; }

  /// Positions of pairs that one call of ProgramFlow::fill() may compute: about 0.3 ms.
  static constexpr std::size_t most_distances = 64;

 private:
  struct Tool {
    double length = 0, radius = 0;
    std::uint32_t number = 0;
    bool operator==(const Tool&) const = default;
  };
  Tool tool_of(const language::ModalState& modal) const;
  void use_tool(const language::ModalState& modal);
  AxisValues machine_of(const AxisValues& position, const language::Command& move) const;
  void open(const AxisValues& from, const language::Command& move);
  void begin_chord();
  std::string words() const;

  const channel_setup::ChannelSetup& machine_;
  CollisionMode mode_;
  BodiesText text_;
  std::optional<collision::MachineBodies> bodies_;  ///< of the file
  collision::Travel travel_{};
  std::optional<Tool> tool_;
  std::optional<collision::CollisionModel> model_;
  std::optional<collision::PathCheck> check_;
  std::uint16_t held_mask_ = 0;
  AxisValues held_{};

  // The command that is checked.
  bool open_ = false;
  motion::PathSegment path_;
  language::Command move_;
  std::size_t chord_ = 0, chords_ = 1;
  AxisValues at_{}, next_{};
  AxisValues tolerance_{};  ///< of the command, in its frame, mm and deg

  std::size_t budget_ = 0;
  std::string contact_text_;
  std::optional<std::pair<std::size_t, std::size_t>> warned_;  ///< bodies, until a move is free
  std::vector<std::string> warnings_;
};

/// The check that machine.yaml in `directory` demands of a channel; null when it is off. `machine` must
/// outlive it. Throws as CollisionGuard::configure().
std::unique_ptr<CollisionGuard> load_guard(const channel_setup::ChannelSetup& machine,
                                           const std::string& directory,
                                           const machine::Parameters& parameters, std::uint16_t channel);

}  // namespace trunnion::collision_guard
