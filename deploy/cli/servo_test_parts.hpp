// SPDX-License-Identifier: Apache-2.0
// What the servo tests have in common.
#pragma once

#include "servo_tests.hpp"

namespace trunnion::cli {

inline constexpr double longest_test = 600;  // s

/// Throws std::runtime_error when another number of axes than one is given.
const SessionAxis& only_axis(const ServoSession& session, const TestOptions& options);
std::string length_unit(const SessionAxis& axis);
std::string speed_unit(const SessionAxis& axis);
/// Samples in motion alone.
idl::servo::TestRequest samples_of(const std::vector<std::uint16_t>& axes, std::uint16_t decimation);
/// To and fro with `time` s at constant speed where the travel permits.
std::string stroke_program(const SessionAxis& axis, double feed, double time, int strokes = 2);
/// The same with 0.5 s.
servo_analysis::AxisTrace stroke(ServoSession& session, const SessionAxis& axis, double feed,
                                 int strokes = 2);
/// Throws std::runtime_error when there is no constant speed behind `settling` s.
servo_analysis::MotionFigures moved_figures(const servo_analysis::AxisTrace& trace, double settling = 0.1);
/// Highest feed, `feed` at most, at which without feed-forward none of the axes lags by more than half of its
/// limit (10a037). `speeds`: of the axes at `feed`, mm/s or deg/s.
double feed_without_feedforward(const ServoSession& session, const std::vector<std::uint16_t>& axes,
                                const std::vector<double>& speeds, double feed);
/// The traces of the axes of `request` while the program runs without feed-forward of these axes and of their
/// gantry slaves. With feed-forward the following error is small at any position gain.
std::vector<servo_analysis::AxisTrace> run_without_feedforward(ServoSession& session,
                                                               idl::servo::TestRequest request,
                                                               const std::string& program);
/// That of the options, else `standard`. Throws std::runtime_error when the axis does not reach it.
double feed_of(const SessionAxis& axis, const TestOptions& options, double standard);
std::string picture_title(const ServoSession& session, const SessionAxis& axis, const char* what);
std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace trunnion::cli
