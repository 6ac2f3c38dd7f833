// SPDX-License-Identifier: Apache-2.0
// Evaluation of a dynamic R-test (Qian and Bi): response of the servos, noise, pitch error, location errors
// of the rotary axis; the difference from a static test. Pure.
#pragma once

#include "ball_motion.hpp"
#include "circular_tests/ball_signal.hpp"
#include "identification/axis_location.hpp"

namespace trunnion::cli {

struct RTestSettings {
  double cutoff = 20;            ///< Hz, of the filter
  double least_harmonic = 5e-5;  ///< mm: smaller pitch errors are not looked for
};

struct RTestResult {
  std::vector<double> angles;  ///< deg of the axis since the start of the turn, by sample
  std::vector<Vec3> read;      ///< mm: deviations as read
  std::vector<Vec3> cleaned;   ///< mm: less the response of the servos, filtered, less the pitch error
  std::vector<circular_tests::TurnHarmonic> tangential;  ///< of a whole turn, mm
  std::vector<circular_tests::TurnHarmonic> pitch;       ///< the harmonics that were removed
  identification::AxisLocation location;
};

RTestResult evaluate_turn(const BallTest& test, const BallTurn& turn, const RTestSettings& settings);

/// The same from stops: no servo, no filter.
identification::AxisLocation locate_from_stops(const BallTest& test, const std::vector<BallSample>& stops);

/// Standard deviation of dynamic less static deviations at the angles of the stops, along X, Y, Z, mm.
Vec3 dynamic_less_static(const std::vector<double>& angles, const std::vector<Vec3>& dynamic,
                         const std::vector<BallSample>& stops);

/// Largest less least along X, Y, Z, mm.
Vec3 ranges(const std::vector<Vec3>& deviations);

}  // namespace trunnion::cli
