// SPDX-License-Identifier: Apache-2.0
// How checks of parameters that belong together report what does not fit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trunnion::machine {

/// Parameters that are each within their limits and do not fit together.
struct ParameterFault {
  std::vector<std::uint32_t> numbers;  ///< of those that are to be looked at, the likeliest first
  std::string text;                    ///< one line with numbers, values and limits
};

}  // namespace trunnion::machine
