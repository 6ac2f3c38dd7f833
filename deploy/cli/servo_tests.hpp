// SPDX-License-Identifier: Apache-2.0
// The servo tests: what each moves or excites, its figures against the manual's limits.
#pragma once

#include <optional>

#include "bus/json.hpp"
#include "servo_session.hpp"

namespace trunnion::cli {

/// 1/s, of a position loop: the manual's 0.2 mm (deg) of following error at 1000 mm/min (deg/min).
inline constexpr double least_position_gain = 1000 / servo_analysis::per_minute / 0.2;

struct TestFigure {
  std::string name;
  double value = 0;
  std::string unit;
  std::optional<double> least, most;  ///< limits; none: for information
  bool reached() const { return (!least || value >= *least) && (!most || value <= *most); }
};

struct TestReport {
  std::string test;
  std::vector<TestFigure> figures;
  std::vector<std::string> notes;  ///< one line each: what to do, what else was found
  bus::Json details;               ///< further content of --json
  std::string picture;             ///< SVG
  /// Parameters that the test proposes.
  std::vector<servo_analysis::ServoSettings::Value> proposal;
  bool reached() const;
};

struct TestOptions {
  std::vector<std::string> axes;
  std::optional<double> feed, amplitude;  ///< of the test, its default otherwise
  double radius = 100;                    ///< roundness, mm
  double from = 1, to = 300;              ///< frequency, Hz
  double start = 0, end = 360;            ///< rtcp, deg
  std::uint32_t tool = 1;                 ///< rtcp, H
  std::string loop = "speed";
};

/// Each throws std::runtime_error when the test cannot be done or is ended.
TestReport test_position(ServoSession& session, const TestOptions& options);
TestReport test_speed(ServoSession& session, const TestOptions& options);
TestReport test_current(ServoSession& session, const TestOptions& options);
TestReport test_overshoot(ServoSession& session, const TestOptions& options);
TestReport test_roundness(ServoSession& session, const TestOptions& options);
TestReport test_rtcp(ServoSession& session, const TestOptions& options);
TestReport test_frequency(ServoSession& session, const TestOptions& options);
TestReport test_friction(ServoSession& session, const TestOptions& options);
/// Signs and pulses of motor and load encoder over one revolution in semi-closed loop; proposes 10a931 and
/// 10a932.
TestReport test_encoders(ServoSession& session, const TestOptions& options);

/// What a tuning needs to know of an axis. `amplitude` mm or deg.
servo_analysis::TuningTask tuning_task(const ServoSession& session, const SessionAxis& axis,
                                       const SessionAxis* partner, double amplitude);
/// Another linear axis for circles with `axis`; null when there is none.
const SessionAxis* partner_of(const ServoSession& session, const SessionAxis& axis);

}  // namespace trunnion::cli
