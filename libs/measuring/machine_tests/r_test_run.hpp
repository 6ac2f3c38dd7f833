// SPDX-License-Identifier: Apache-2.0
// The R-test on a machine: a turn and its stops, or a study of feeds and start angles.
#pragma once

#include <optional>
#include <vector>

#include "identification/r_test_evaluation.hpp"
#include "machine_tests/ball_test.hpp"

namespace trunnion::machine_tests {

struct RTestReport {
  BallMotion motion;
  identification::RTestResult result;  ///< of the turn to
  std::vector<identification::BallSample> stops;
  std::optional<identification::StaticComparison> comparison;  ///< with identification::least_stops at least
};

/// Turns with `feed` mm/min along the circle of the ball, then stands at `stops` stops, or at none.
RTestReport run_r_test(BallTest& test, double feed, std::size_t stops,
                       const identification::RTestSettings& settings);

struct RTestStudy {
  std::vector<double> feeds, starts;  ///< mm/min along the circle, deg
  std::size_t stops = 72;             ///< identification::least_stops at least
  std::size_t repeats = 1;            ///< of each feed from each start
};

/// Standard deviation of dynamic less static deviations along X, Y, Z, mm: root mean square of the repeats.
struct StudyRow {
  double feed = 0, start = 0;  ///< mm/min, deg
  truth::Vec3 difference = truth::Vec3::Zero(), cleaned = truth::Vec3::Zero();
};

/// Every feed from every start.
std::vector<StudyRow> study_r_test(BallTest& test, const RTestStudy& study,
                                   const identification::RTestSettings& settings);

}  // namespace trunnion::machine_tests
