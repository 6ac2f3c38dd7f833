// SPDX-License-Identifier: Apache-2.0
// A rotary axis that turns with constant speed under tool tip control, while the linear axes follow the tip.
#pragma once

#include <string>
#include <vector>

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

struct RtcpTurn {
  std::vector<AxisTrace> linear;
  AxisTrace rotary;
};

/// The samples in which the rotary axis, the last of `traces`, turns with `speed` deg/s, signed. Throws
/// std::runtime_error when it does not.
RtcpTurn turn_under_rtcp(std::vector<AxisTrace> traces, double speed);

/// mm: the longest way of a linear axis from its first place.
double linear_way(const RtcpTurn& turn);

/// Of the setpoint, mm/s or deg/s.
double peak_speed(const AxisTrace& trace);

struct AxisLag {
  char letter = 0;
  double time = 0;  ///< s
};

/// `times` and `letters`: of the linear axes and, last, of the rotary axis. A linear axis with less than a
/// tenth of the highest speed has no lag to speak of and is left out.
std::vector<AxisLag> lags_of(const RtcpTurn& turn, const std::vector<double>& times,
                             const std::string& letters);

}  // namespace trunnion::servo_analysis
