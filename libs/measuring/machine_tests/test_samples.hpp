// SPDX-License-Identifier: Apache-2.0
// What a drive has sent of a servo test, put together.
#pragma once

#include <cstdint>
#include <vector>

#include "contracts/types.hpp"
#include "servo_analysis/axis_trace.hpp"

namespace trunnion::machine_tests {

struct SessionResult {
  idl::servo::TestPhase phase = idl::servo::TestPhase::COMPLETED;
  double vibration = 0;                           ///< mm or deg
  bool lost = false;                              ///< samples are missing
  std::vector<servo_analysis::AxisTrace> traces;  ///< by the axes of the request
};

/// Puts `samples` behind those of `result`, which has `expected` of each axis. True when the test has ended.
bool add_samples(SessionResult& result, std::uint64_t& expected, const idl::servo::TestSamples& samples);

}  // namespace trunnion::machine_tests
