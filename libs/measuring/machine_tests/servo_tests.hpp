// SPDX-License-Identifier: Apache-2.0
// The servo tests: what each moves or excites, its figures against the manual's limits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/json.hpp"
#include "machine_tests/servo_session.hpp"
#include "machine_tests/spindle_sync_samples.hpp"
#include "servo_analysis/test_findings.hpp"
#include "servo_analysis/test_picture.hpp"

namespace trunnion::machine_tests {

struct TestReport : servo_analysis::TestFindings {
  std::string test;
  bus::Json details;  ///< what the figures follow from
  servo_analysis::TestPicture picture;
};

struct TestOptions {
  std::vector<std::string> axes;
  std::optional<double> feed, amplitude;  ///< of the test, its default otherwise
  double radius = 100;                    ///< roundness, mm
  double from = 1, to = 300;              ///< frequency, Hz
  double start = 0, end = 360;            ///< rtcp, deg
  std::uint32_t tool = 1;                 ///< rtcp, H
  std::string loop = "speed";
  SpindleSyncOptions spindle_sync;
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

/// Two spindles that the PLC couples by M functions, at each speed and while the master changes from one to
/// the next. At the end, also after an exception, they are at rest and not coupled.
TestReport test_spindle_sync(ServoSession& session, const TestOptions& options);

}  // namespace trunnion::machine_tests
