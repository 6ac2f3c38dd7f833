// SPDX-License-Identifier: Apache-2.0
// What a measurement keeps over the end of its process: what was asked, how far it is, what was touched.
#pragma once

#include <string>

#include "contracts/types.hpp"

namespace trunnion::measurement {

struct StoredMeasurement {
  idl::measurement::MeasurementRequest request;  ///< the START
  idl::measurement::MeasurementState state;
  idl::measurement::MeasurementResult result;
  bool in_program = false;  ///< a program has called the cycle, and executes the parts
  std::uint32_t call = 0;   ///< number of its call that is not answered yet, 0 = none

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("request", self.request);
    visit("state", self.state);
    visit("result", self.result);
    visit("in_program", self.in_program);
    visit("call", self.call);
  }
};

/// JSON, numbers exact to the bit.
std::string text_of(const StoredMeasurement& measurement);
/// Throws std::runtime_error: one line. Every pose has six angles and whole touches, every number is finite.
StoredMeasurement parse_measurement(const std::string& text);

/// The phases in which the measurement has the machine.
bool is_active(idl::measurement::Phase phase);

}  // namespace trunnion::measurement
