// SPDX-License-Identifier: Apache-2.0
// A circular test of ISO 230-4 from a motion of a channel. Pure.
#pragma once

#include <array>
#include <string>

#include "circular_tests/circle_program.hpp"
#include "circular_tests/circle_report.hpp"
#include "circular_tests/turns.hpp"
#include "identification/circle_points.hpp"
#include "servo_analysis/test_programs.hpp"
#include "truth/measurement.hpp"

namespace trunnion::identification {

/// `linear`: X, Y and Z. Throws std::runtime_error when one of them would leave its travel or cannot reach
/// the feed.
void check_circle(const circular_tests::CircleMotion& motion,
                  const std::array<servo_analysis::TestedAxis, 3>& linear);

struct CircleTest {
  truth::BallbarMeasurement readings;
  circular_tests::CircleReport report;
  double feed = 0;                ///< mm/min, reached
  double servo_mismatch = 0;      ///< ms: the first axis lags more than the second
  double start = 0, overrun = 0;  ///< deg, of the first turn
};

/// `points` are those of `motion` in `plane` (XY, XZ or YZ), as `bar` reads them. Throws std::runtime_error
/// when the motion has no whole turn of `circle` in each sense.
CircleTest evaluate_circle(const servo_analysis::ChannelMotion& motion, const std::string& plane,
                           const circular_tests::ProgrammedCircle& circle, const CirclePoints& points,
                           const truth::InstrumentTruth& bar);

}  // namespace trunnion::identification
