// SPDX-License-Identifier: Apache-2.0
// The great circle between two tool directions.
#pragma once

#include <optional>

#include "geometry/types.hpp"

namespace trunnion::geometry {

/// Turns `from` into `to` by the shortest rotation, at a constant rate over s = 0 .. 1.
class DirectionArc {
 public:
  /// Vectors of any length above zero. Nothing when one has no length, or they are opposite within 1e-6 rad:
  /// then no rotation is the shortest.
  static std::optional<DirectionArc> make(const Vec3& from, const Vec3& to);

  /// Unit vector at s, which may lie outside 0 .. 1.
  Vec3 at(double s) const;
  /// [0] the vector, [1] .. [3] its derivatives by s.
  std::array<Vec3, 4> derivatives(double s) const;

  const Vec3& from() const { return from_; }
  const Vec3& to() const { return to_; }
  /// Unit vector across `from` in the sense of the rotation.
  const Vec3& across() const { return across_; }
  /// rad, 0 .. pi
  double length() const { return length_; }

 private:
  Vec3 from_ = Vec3::UnitZ(), to_ = Vec3::UnitZ(), across_ = Vec3::UnitX();
  double length_ = 0;
};

}  // namespace trunnion::geometry
