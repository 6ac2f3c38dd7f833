// SPDX-License-Identifier: Apache-2.0
// The synchronization of two spindles by their angles, against the window of the slave (10a974).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "servo_analysis/test_findings.hpp"
#include "servo_analysis/test_picture.hpp"

namespace trunnion::servo_analysis {

/// Both encoders at one moment: rev, clockwise, turns counted.
struct SpindleAngles {
  double time = 0;  ///< s of machine time
  double master = 0, slave = 0;
  bool cycle = false;  ///< one of consecutive cycles; else what the drive reported between two dwells
};

/// What the drive itself says.
struct SlaveReport {
  std::size_t at = 0;  ///< index of the newest angles
  bool follows = false;
  double reference = 0;   ///< 1/min: the speed that the master is given
  double error = 0;       ///< rev
  double correction = 0;  ///< 1/min, of the integral action
};

/// Of the program at one speed: it couples the spindles, dwells, and perhaps gives the master another speed
/// and dwells again. There are cycles while it dwells only.
struct SpindleSyncRecord {
  double interval = 0.001;  ///< s from one cycle to the next
  std::vector<SpindleAngles> angles;
  std::vector<SlaveReport> reports;
};

struct SpindleSyncSettings {
  bool reverse = false;
  double angle = 0;   ///< deg: the slave is at (master + angle), with reverse at -(master + angle)
  double window = 1;  ///< deg: 10a974
  double gain = 500;  ///< 1/min for each rev: 10a975
  double settling = 2, record = 5;  ///< s: of the first dwell, before the recording and of it
};

/// deg: where the slave should be less where it is, of all angles. Counts from the turn that is nearest at
/// the angles `from`.
std::vector<double> synchronization_errors(const std::vector<SpindleAngles>& angles,
                                           const SpindleSyncSettings& settings, std::size_t from);

/// At constant speed.
struct SteadySync {
  double master_speed = 0;                   ///< 1/min, measured
  double mean = 0, deviation = 0, peak = 0;  ///< deg; the standard deviation; the largest, without sign
  double drift = 0;                          ///< deg: change of the straight line through the recording
  std::optional<double> growth;  ///< oscillation of the second half over that of the first; none: it is small
  double correction = 0;         ///< 1/min
  double slow = 0;               ///< 1/min: the slave, if nothing corrected it
  double lag_without_integral = 0;  ///< deg: the error with the gain alone
  double drive_difference = 0;      ///< deg: largest difference of the drive's own error
};

/// The master takes another speed.
struct SyncStep {
  double speed = 0;            ///< 1/min: the new one, measured
  double largest = 0;          ///< deg, without sign
  std::optional<double> back;  ///< s from the order until the error stays within the window
  double at_end = 0;           ///< deg: the largest at the end of the dwell
  double resolution = 0;       ///< s: longest time between two angles
};

struct SpindleSyncFigures {
  std::optional<double> synchronized;  ///< s from the coupling until the error stays within the window
  SteadySync steady;
  std::optional<SyncStep> step;
  std::vector<CurvePoint>
      course;  ///< error, deg, over the time since the coupling, s, once it is in the window
};

/// Throws std::runtime_error when the spindles were not coupled or cycles are missing.
SpindleSyncFigures spindle_sync_figures(const SpindleSyncRecord& record, const SpindleSyncSettings& settings);

/// `speed`: ordered, 1/min; `next`: ordered by the step, 0 = none.
TestFindings spindle_sync_findings(double speed, double next, const SpindleSyncFigures& figures,
                                   const SpindleSyncSettings& settings);

/// The window as a curve that surrounds it, from 0 to `time` s.
Curve window_curve(double window, double time);

}  // namespace trunnion::servo_analysis
