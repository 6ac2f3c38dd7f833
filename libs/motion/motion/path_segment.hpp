// SPDX-License-Identifier: Apache-2.0
// The geometry stage: one command as a curve by its length.
#pragma once

#include <array>

#include "canonical/canonical.hpp"
#include "motion/cubic.hpp"

namespace trunnion::motion {

/// What a path length of a segment counts.
enum class LengthUnit : std::uint8_t {
  millimetre,  ///< travel of X Y Z, or of U V W when X Y Z are at rest
  degree,      ///< of the rotary axes together, when no linear axis moves
};

/// Line, arc or helix from a start to a target in the frame of the command. X Y Z follow the curve; every
/// other axis moves in proportion to the length. position(length()) is the target bit for bit. Or a piece of
/// the smooth curve that replaces short lines.
class PathSegment {
 public:
  PathSegment() = default;

  /// Straight line. A feed counts the travel of X Y Z; of U V W or the rotary axes when the former is below a
  /// millionth of theirs. The length is that travel, or the longest when that is a thousand times longer.
  static PathSegment line(const AxisValues& start, const AxisValues& target);

  /// Arc by centre and sweep (degrees, above 0). Where start and target lie at different radii the radius
  /// runs linearly between them; what then remains between the end of the sweep and the target is closed in
  /// proportion.
  static PathSegment arc(const AxisValues& start, const AxisValues& target, const canonical::Arc& arc);

  /// Piece of a smooth curve, `length` long by the length of the line it replaces, whose command ends at
  /// `target`. When it `meets` the target, position(length) is the target bit for bit.
  static PathSegment curve(const Cubic& curve, double length, const AxisValues& target, bool meets);

  double length() const { return length_; }
  /// Path length per unit of travel that a feed counts, 1 or more.
  double feed_scale() const { return feed_scale_; }
  /// The same where a feed counts mm of X Y Z and degrees of the rotary axes together, as the root of the sum
  /// of their squares: below 1 where both move.
  double combined_feed_scale() const;
  LengthUnit unit() const { return unit_; }
  /// End of the command the segment is of, or is a piece of.
  const AxisValues& target() const { return target_; }

  /// Position at `s` in 0..length(); values outside are clamped.
  AxisValues position(double s) const;

  /// Derivative of the position by s, unit per mm (or per degree, see unit()).
  AxisValues derivative(double s) const;

  /// First, second and third derivative of the position by s.
  std::array<AxisValues, 3> derivatives(double s) const;

  bool is_arc() const { return is_arc_; }
  bool is_curve() const { return is_curve_; }
  const AxisValues& start() const { return start_; }

  /// Largest curvature of the X Y Z curve, 1/mm; 0 for lines.
  double curvature() const { return curvature_; }

 private:
  static PathSegment tilted_arc(const AxisValues& start, const AxisValues& target, const canonical::Arc& arc);

  AxisValues start_{}, target_{}, slope_{};  // slope: change of the proportional part per unit of length
  AxisValues square_{}, cube_{};             // of a curve
  double length_ = 0, feed_scale_ = 1;
  double curvature_ = 0;
  LengthUnit unit_ = LengthUnit::millimetre;
  bool is_arc_ = false;
  bool is_curve_ = false, meets_target_ = true;
  bool is_tilted_ = false;  // the circle lies in the plane of first_ and second_, about hub_
  canonical::Vector3 first_{}, second_{}, hub_{};
  std::array<std::size_t, 2> plane_{0, 1};
  std::array<double, 2> centre_{};
  double radius_ = 0, radius_slope_ = 0;  // mm, mm per mm
  double angle_ = 0, angle_slope_ = 0;    // rad, rad per mm
};

/// Sweep in degrees that is left of `arc` from `position` on to `target`, when about `fraction` (0..1) of it
/// is done: the angle between the two, with the turns that come nearest. Not above 0 when the target is
/// passed.
double remaining_sweep(const AxisValues& position, const AxisValues& target, const canonical::Arc& arc,
                       double fraction);

}  // namespace trunnion::motion
