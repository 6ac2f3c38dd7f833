// SPDX-License-Identifier: Apache-2.0
// A path of the axes among the bodies of a machine, checked move after move.
#pragma once

#include <memory>
#include <optional>

#include "collision/collision_model.hpp"

namespace trunnion::collision {

/// Follows a path of straight moves of the axes. Of each pair of bodies it keeps one position and the
/// distance there: as long as the axes have not moved both bodies together by more than what exceeds the
/// clearance, nothing has to be computed anew. So a path of many short moves costs few distances.
/// Deterministic: the answers depend on the path alone.
///
/// A path that begins within the clearance of a pair may only increase the distance of that pair until it is
/// beyond: it is followed in steps in which the pair moves at most `escape_step`, and its distance must not
/// fall more than `escape_loss` below the largest one so far. A move that brings such a pair nearer is in
/// contact at its start.
class PathCheck {
 public:
  enum class Verdict : std::uint8_t { free, contact, unfinished };

  /// mm: a pair counts as in contact when its distance is the clearance and this or less. It bounds the
  /// number of steps along a path that keeps just beyond it.
  static constexpr double resolution = 0.05;
  static constexpr double escape_step = 0.1, escape_loss = 0.02;  ///< mm

  /// `model` must outlive the check.
  explicit PathCheck(const CollisionModel& model);
  PathCheck(PathCheck&&) noexcept;
  PathCheck& operator=(PathCheck&&) noexcept;
  ~PathCheck();

  /// A straight move of all axes between `from` and `to`, from which they deviate by at most `deviation` of
  /// each axis, mm and degrees. A path begins where the move before did not end, and behind a contact. With
  /// `probing` bodies on the tool and bodies on the workpiece's side may touch. Call advance() until it is
  /// finished.
  void begin(const AxisPosition& from, const AxisPosition& to, const AxisPosition& deviation, bool probing);
  /// The next move begins a path.
  void forget_path();
  /// Computes at most `budget` distances, which it subtracts from.
  Verdict advance(std::size_t& budget);
  /// Of Verdict::contact.
  const FirstContact& contact() const;
  /// Distances computed so far.
  std::uint64_t distances() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace trunnion::collision
