// SPDX-License-Identifier: Apache-2.0
// Automatic tuning of the loops of one axis: critical gains, 80 % of them, feed-forward, the manual's limits.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "servo_analysis/motion_figures.hpp"
#include "servo_analysis/servo_settings.hpp"

namespace trunnion::servo_analysis {

/// To and fro from the place where the axis is at the start of the tuning; or its part of two turns of a
/// circle, which begin where it reverses.
struct TestMotion {
  double feed = 1000;    ///< mm/min or deg/min
  double distance = 10;  ///< mm or deg
  int strokes = 2;
  double radius = 0;  ///< mm; above zero: a circle, and distance and strokes are without effect
};

struct MotionResult {
  bool vibration = false;  ///< it was ended by the drive, which has taken the fallback
  double amplitude = 0;    ///< half of the largest stroke of a vibration, mm or deg
  AxisTrace trace;
};

/// The axis that is tuned: a simulation or one of a running cluster.
class AxisUnderTest {
 public:
  virtual ~AxisUnderTest() = default;
  /// Moves with `trial`; with `fallback` as soon as the drive finds a vibration (half a stroke of
  /// `vibration_limit` mm or deg). Afterwards the parameters of the machine are in force again. Throws
  /// std::runtime_error when an alarm or the operator ends it.
  virtual MotionResult move(const ServoSettings& trial, const ServoSettings& fallback, double vibration_limit,
                            const TestMotion& motion) = 0;
};

/// The limits of the manual's servo tests, mm and mm/min (of a rotary axis deg and deg/min).
struct ServoLimits {
  double following_error = 0.2;        ///< at 1000 mm/min; 0.1 is the best
  double ripple = 10;                  ///< at the finishing feed
  double overshoot = 40;               ///< at the end of an acceleration
  double overshoot_full_closed = 100;  ///< the same in full closed loop at 500 mm/min and less
  double reversal_jump = 0.01;
};
inline constexpr double overshoot_feeds[] = {100, 200, 500, 1000, 3000};  // mm/min

struct TuningTask {
  ServoSettings current;               ///< of the machine now
  double amplitude = 0.02;             ///< mm or deg: no vibration may be larger
  double rated_acceleration = 1;       ///< mm/s2 or deg/s2 that the rated torque gives the nominal inertia
  double highest_feed = 10000;         ///< of the axis, mm/min or deg/min
  double current_time_constant = 0.4;  ///< 10a903, ms
  double acceleration = 1000;          ///< of the axis, mm/s2 or deg/s2
  double travel = 40;                  ///< that may be used, mm or deg
  bool full_closed_loop = false;
  bool circles = true;  ///< the axis can move on a circle with another one
  ServoLimits limits;
  /// One line for each step; empty: none.
  std::function<void(const std::string&)> progress;
};

struct ServoFigure {
  std::string name;
  double value = 0, limit = 0;
  std::string unit;
  bool reached() const { return value <= limit; }
};

struct TuningResult {
  ServoSettings settings;
  /// The least gains at which the axis vibrated; 0 where it did not up to the largest gain that was tried.
  double critical_speed_gain = 0, critical_position_gain = 0;
  double inertia = 1;            ///< over the nominal one
  double coulomb = 0;            ///< share of the rated torque
  double largest_vibration = 0;  ///< half of the largest stroke while tuning, mm or deg
  int motions = 0;
  std::vector<ServoFigure> figures;  ///< with the settings
  bool reached() const;
};

/// The figures of the manual's tests of position loop, speed loop, overshoot and reversal with `settings`.
/// `vibration` is set when one occurs.
std::vector<ServoFigure> servo_figures(AxisUnderTest& axis, const TuningTask& task,
                                       const ServoSettings& settings, bool* vibration = nullptr);

/// Throws what AxisUnderTest::move() throws, and std::runtime_error when the axis vibrates with the least
/// gains. The procedure is in docs/drives.md.
TuningResult tune_axis(AxisUnderTest& axis, const TuningTask& task);

}  // namespace trunnion::servo_analysis
