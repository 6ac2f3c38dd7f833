// How fast a corner may be passed so that the smoothed path keeps its tolerance and the axes their
// acceleration.
//
// Contour. The output is the mean of the path over the last T. Relative to the path point at the mean
// coordinate m of the window its error is the mean of the integral of (u(s) - u(m)) ds, so a change of
// direction |du| at the distance x from m contributes |du| times the mean overshoot behind it. When the speed
// is at most V within h = V T / 2 of m, that overshoot is at most (h - x)^2 / (4 h), whatever the speed does
// below V: it is V T / 8 for a corner (x = 0), and for a curvature k the integral over x gives k (V T)^2
// / 24. Between corners the sum is convex in m, so its maximum is at a corner: it is enough that for each
// corner c the weighted sum of all changes of direction around it is within the tolerance at a speed V(c),
// kept within +-h of c.
//
// Acceleration. The output acceleration is (x'[now] - x'[now - T]) / T. Over a window with first rate of an
// axis q'(1), last rate q'(2) and any corner passed at v, |q'(2) v(2) - q'(1) v(1)| <= v |q'(2) - q'(1)| + a
// max|q'| T: the corner gets what the tangential acceleration a leaves of the limit of every axis. A part of
// the limit up to normal_share is kept for changes of direction, as much as a segment is expected to need;
// the rest is tangential.
#pragma once

#include "motion/limits.hpp"
#include "motion/planned_segment.hpp"

namespace trunnion::motion {

struct CornerRules {
  Limits limits;
  double window = 0;        ///< T, s
  double reach_window = 0;  ///< (N + 1) dt: all that two cycle speeds a window apart are averages over
  double contour_window =
      0;  ///< T with the allowance for the finite cycle: (N + 2) dt, 0 when nothing is smoothed
  double acceleration_share =
      1;  ///< below 1 when the axes depend on the path through a chain: its curvature within a window
};

inline constexpr double normal_share = 0.5;
inline constexpr double least_normal_share = 0.05;
inline constexpr double highest_override = 1.5;

/// Speed limit of the segment by itself (velocity and normal acceleration of the axes, feed at the highest
/// override) and its turn and bend from the rates. `before` is the segment in front of it, or nullptr when it
/// starts from a full stop.
void rate_segment(PlannedSegment& segment, const PlannedSegment* before, const CornerRules& rules);

/// Highest V for the start of segment `index` by the contour rule, not above `highest`.
double contour_speed(const SegmentRing& ring, std::uint64_t index, double highest, const CornerRules& rules);

/// Tangential acceleration of segment `index`, once its neighbours are known.
double tangential_acceleration(const SegmentRing& ring, std::uint64_t index, const CornerRules& rules);

/// Highest speed at the start of segment `index` by the acceleration rule, not above `highest`.
double acceleration_speed(const SegmentRing& ring, std::uint64_t index, double highest,
                          const CornerRules& rules);

}  // namespace trunnion::motion
