// SPDX-License-Identifier: Apache-2.0
// The columns of a channel's axes by their logical numbers.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "compensation/error_table.hpp"

namespace trunnion::compensation {

struct ChannelColumns {
  std::vector<std::uint16_t> numbers;  ///< of the channel's axes, then of the slaves that are compensated
  std::uint16_t channel = 0;

  /// The column of the axis that `parameter` of axis `axis` names. Throws machine::KinematicsError.
  std::size_t of(const machine::Parameters& parameters, const machine::IntegerParameter& parameter,
                 std::uint32_t axis) const {
    const int number = parameters.integer(parameter, axis);
    const auto found = std::find(numbers.begin(), numbers.end(), number);
    if (found == numbers.end())
      refuse(parameter, axis,
             "is " + std::to_string(number) + ": channel " + std::to_string(channel) + " has no such axis");
    return static_cast<std::size_t>(found - numbers.begin());
  }
};

}  // namespace trunnion::compensation
