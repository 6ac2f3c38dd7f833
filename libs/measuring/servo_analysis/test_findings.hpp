// SPDX-License-Identifier: Apache-2.0
// What the servo tests find, against the limits of the manual.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "machine/parameters.hpp"
#include "servo_analysis/contour_figures.hpp"
#include "servo_analysis/frequency_response.hpp"
#include "servo_analysis/friction.hpp"
#include "servo_analysis/loop_figures.hpp"
#include "servo_analysis/motion_figures.hpp"
#include "servo_analysis/rtcp_turn.hpp"
#include "servo_analysis/servo_settings.hpp"
#include "servo_analysis/test_programs.hpp"

namespace trunnion::servo_analysis {

/// 1/s, of a position loop: the manual's 0.2 mm (deg) of following error at 1000 mm/min (deg/min).
inline constexpr double least_position_gain = 1000 / per_minute / 0.2;

struct TestFigure {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> least, most;  ///< limits; none: for information
  bool reached() const { return (!least || value >= *least) && (!most || value <= *most); }
};

struct TestFindings {
  std::vector<TestFigure> figures;
  std::vector<std::string> notes;              ///< one line each: what to do, what else was found
  std::vector<ServoSettings::Value> proposal;  ///< parameters that the test proposes
  bool reached() const;
};

/// `moved` at `feed`, `bare` without feed-forward at `slower` mm/min or deg/min. `highest_gain` 1/s: no loop
/// can have a higher one.
TestFindings position_findings(const TestedAxis& axis, double feed, const MotionFigures& moved, double slower,
                               const MotionFigures& bare, double highest_gain);
TestFindings speed_findings(const TestedAxis& axis, const MotionFigures& moved);
/// `moved`: by the feed, mm/min or deg/min.
TestFindings overshoot_findings(const TestedAxis& axis,
                                const std::vector<std::pair<double, MotionFigures>>& moved,
                                bool full_closed_loop);
/// `bare`: without feed-forward.
TestFindings roundness_findings(char first, char second, const RoundnessFigures& circle,
                                const RoundnessFigures& bare);
/// `lags`: without feed-forward.
TestFindings rtcp_findings(const SimultaneousFigures& turn, const std::vector<AxisLag>& lags);
/// `time_constant` s.
TestFindings current_findings(double time_constant);
TestFindings frequency_findings(const Response& open, const Response& closed);
/// `inertia`: torque, a share of the rated one, over acceleration.
TestFindings friction_findings(const TestedAxis& axis, const FrictionModel& friction, double inertia);
/// Over one revolution of the motor; proposes direction (10a931) and pulses (10a932) of the load encoder.
TestFindings encoder_findings(const machine::Parameters& parameters, const TestedAxis& axis,
                              const EncoderComparison& compared);

}  // namespace trunnion::servo_analysis
