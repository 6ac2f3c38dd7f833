// SPDX-License-Identifier: Apache-2.0
// Evaluation of a dynamic R-test (Qian and Bi): response of the servos, noise, pitch error, location errors
// of the rotary axis; the difference from a static test. Pure.
#pragma once

#include <vector>

#include "circular_tests/ball_signal.hpp"
#include "identification/axis_location.hpp"
#include "identification/turned_ball.hpp"

namespace trunnion::identification {

struct RTestSettings {
  double cutoff = 20;            ///< Hz, of the filter
  double least_harmonic = 5e-5;  ///< mm: smaller pitch errors are not looked for
};

struct RTestResult {
  std::vector<double> angles;        ///< deg of the axis since the start of the turn, by sample
  std::vector<truth::Vec3> read;     ///< mm: deviations as read
  std::vector<truth::Vec3> cleaned;  ///< mm: less the response of the servos, filtered, less the pitch error
  std::vector<circular_tests::TurnHarmonic> tangential;  ///< of a whole turn, mm
  std::vector<circular_tests::TurnHarmonic> pitch;       ///< the harmonics that were removed
  AxisLocation location;
};

RTestResult evaluate_turn(const TurnedBall& set, const BallTurn& turn, const RTestSettings& settings);

/// The same from stops: no servo, no filter.
AxisLocation locate_from_stops(const TurnedBall& set, const std::vector<BallSample>& stops);

/// Standard deviation of dynamic less static deviations at the angles of the stops, along X, Y, Z, mm.
truth::Vec3 dynamic_less_static(const std::vector<double>& angles, const std::vector<truth::Vec3>& dynamic,
                                const std::vector<BallSample>& stops);

/// A dynamic test beside a static one.
struct StaticComparison {
  AxisLocation location;  ///< by the stops
  /// Dynamic less static, as read and cleaned: standard deviation along X, Y, Z, mm.
  truth::Vec3 difference = truth::Vec3::Zero(), cleaned = truth::Vec3::Zero();
};
inline constexpr std::size_t least_stops = 4;  ///< that locate an axis
StaticComparison compare(const TurnedBall& set, const RTestResult& dynamic,
                         const std::vector<BallSample>& stops);

/// Largest less least along X, Y, Z, mm.
truth::Vec3 span_of(const std::vector<truth::Vec3>& deviations);

}  // namespace trunnion::identification
