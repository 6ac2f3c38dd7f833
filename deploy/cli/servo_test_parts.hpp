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
/// To and fro with 0.5 s at constant speed where the travel permits.
servo_analysis::AxisTrace stroke(ServoSession& session, const SessionAxis& axis, double feed,
                                 int strokes = 2);
/// Throws std::runtime_error when there is no constant speed.
servo_analysis::MotionFigures moved_figures(const servo_analysis::AxisTrace& trace);
/// That of the options, else `standard`. Throws std::runtime_error when the axis does not reach it.
double feed_of(const SessionAxis& axis, const TestOptions& options, double standard);
std::string picture_title(const ServoSession& session, const SessionAxis& axis, const char* what);
std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace trunnion::cli
