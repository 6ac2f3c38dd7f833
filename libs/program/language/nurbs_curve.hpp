// SPDX-License-Identifier: Apache-2.0
// A NURBS curve, read knot by knot and given out as chords.
#pragma once

#include <array>
#include <cstdint>

#include "language/alarms.hpp"
#include "language/canonical.hpp"

namespace trunnion::language {

/// G6.2 as it streams: block i brings knot i and, for the first blocks, control point i. As soon as a span
/// has its knots it is given out as chords within a tolerance, so the curve may have any number of points and
/// needs only a window of them.
///
/// Chords and not a curve command, because everything behind (travel check, restart at a fraction of a
/// command, five-axis transformation, reports) then needs no new case; the tolerance is the control's own
/// (half of 000010) and Command::chord marks for the smoothing that the joints are no corners.
class NurbsCurve {
 public:
  static constexpr std::uint32_t most_order = 4;

  struct ControlPoint {
    Vector3 point{};    ///< mm
    double weight = 1;  ///< > 0
  };

  /// `order` is the degree + 1, 2..most_order; `tolerance` in mm.
  void start(std::uint32_t order, double tolerance);
  bool active() const { return active_; }
  void stop() { active_ = false; }
  bool has_points() const { return point_count_ > 0; }

  AlarmNumber add(double knot, const ControlPoint& point);
  /// A knot without a control point: one of the last `order`.
  AlarmNumber add(double knot);

  /// The end of the next chord; false when the next block is needed. The curve is no longer active when its
  /// last chord has been given.
  bool next(Vector3& end);
  /// That chord was the last.
  bool at_end() const {
    return !in_span_ && knot_count_ > point_count_ && knot_count_ + 1 >= point_count_ + order_;
  }

 private:
  AlarmNumber add_knot(double knot);
  void begin_span();
  Vector3 evaluate(double u) const;
  double knot(std::uint32_t i) const { return knots_[i % knots_.size()]; }
  const ControlPoint& control(std::uint32_t i) const { return points_[i % points_.size()]; }

  std::uint32_t order_ = 2;
  double tolerance_ = 0;
  bool active_ = false;
  std::array<double, 2 * most_order> knots_{};
  std::array<ControlPoint, 2 * most_order> points_{};
  std::uint32_t knot_count_ = 0;
  std::uint32_t point_count_ = 0;
  bool in_span_ = false;
  std::uint32_t span_ = 0;  // index of its first knot
  double u_ = 0;
  double step_ = 0;
  Vector3 at_{};
};

}  // namespace trunnion::language
