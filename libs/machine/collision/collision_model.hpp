// SPDX-License-Identifier: Apache-2.0
// Distances between the bodies of a machine, and the first contact along straight moves of its axes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "collision/bodies.hpp"

namespace trunnion::collision {

/// Two bodies and how far they are apart.
struct PairDistance {
  std::size_t first = 0, second = 0;                       ///< numbers of the bodies
  double distance = 0;                                     ///< mm; below zero: depth of the penetration
  Vec3 on_first = Vec3::Zero(), on_second = Vec3::Zero();  ///< nearest points, mm, frame of the base
};

/// Where a move comes nearer than the clearance.
struct FirstContact {
  double share = 0;  ///< of the move, 0 .. 1
  AxisPosition position{};
  PairDistance pair;
};

/// Least distance of each pair of bodies along a path, for a table of clearances.
class ClearanceTable {
 public:
  struct Row {
    std::size_t first = 0, second = 0;
    double distance = 0;  ///< mm, an upper limit of the least distance: the least one at the positions seen
    std::size_t at = 0;   ///< which position
  };
  const std::vector<Row>& rows() const { return rows_; }

 private:
  friend class CollisionModel;
  std::vector<Row> rows_;
};

struct BodyPairs;

/// Pairs of bodies on the same link or on neighbouring ones, and allowed pairs, are not checked. Pure; every
/// member function may be called from any thread.
///
/// Along a move every axis goes evenly from start to end. A point of a body that an axis turns moves no
/// farther than the turned angle times its distance from the axis. So a pair whose distance exceeds the
/// clearance by d cannot reach it within a share of the move in which both together move less than d. The
/// move is followed by such shares: nothing between two samples is overlooked.
class CollisionModel {
 public:
  /// `links` and bodies of one machine.
  CollisionModel(MachineLinks links, BodySet set);
  CollisionModel(CollisionModel&&) noexcept;
  CollisionModel& operator=(CollisionModel&&) noexcept;
  ~CollisionModel();

  const MachineLinks& links() const;
  const std::vector<Body>& bodies() const;
  double clearance() const;  ///< mm
  std::size_t pair_count() const;

  /// The pair that is nearest, exact for distances below `within` mm; nothing when all are farther apart.
  std::optional<PairDistance> nearest(const AxisPosition& position, double within = 1e9) const;
  /// Any pair nearer than the clearance (and 0.01 mm).
  bool collides(const AxisPosition& position) const;
  /// The first share at which a pair is nearer than `clearance` (and 0.01 mm); nothing when the whole
  /// move is free. Below zero: that of the set.
  std::optional<FirstContact> first_contact(const AxisPosition& from, const AxisPosition& to,
                                            double clearance = -1) const;
  /// Notes the distances at `position`, which is number `at`; those above `within` mm may be left out.
  void note(const AxisPosition& position, std::size_t at, double within, ClearanceTable& table) const;

  /// "'probe' and 'table' are 0.312 mm apart", "'a' and 'b' overlap by 1.200 mm"
  std::string text_of(const PairDistance& pair) const;

 private:
  friend class PathCheck;
  std::unique_ptr<BodyPairs> pairs_;
};

}  // namespace trunnion::collision
