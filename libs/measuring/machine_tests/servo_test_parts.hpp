// SPDX-License-Identifier: Apache-2.0
// What the servo tests have in common.
#pragma once

#include "machine_tests/servo_tests.hpp"
#include "machine_tests/test_requests.hpp"

namespace trunnion::machine_tests {

/// Throws std::runtime_error when another number of axes than one is given.
const TestedAxis& only_axis(const ServoSession& session, const TestOptions& options);
TestReport report_of(const char* test, servo_analysis::TestFindings findings);
/// To and fro with 0.5 s at constant speed where the travel permits.
servo_analysis::AxisTrace stroke(ServoSession& session, const TestedAxis& axis, double feed, int strokes = 2);
/// Throws std::runtime_error when there is no constant speed behind `settling` s.
servo_analysis::MotionFigures moved_figures(const servo_analysis::AxisTrace& trace, double settling = 0.1);
/// The traces of the axes of `request` while the program runs with without_feedforward().
std::vector<servo_analysis::AxisTrace> run_without_feedforward(ServoSession& session,
                                                               idl::servo::TestRequest request,
                                                               const std::string& program);
servo_analysis::TestPicture picture_of(const ServoSession& session, const TestedAxis& axis, const char* what,
                                       servo_analysis::Diagram diagram);

}  // namespace trunnion::machine_tests
