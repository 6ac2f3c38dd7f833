// SPDX-License-Identifier: Apache-2.0
// Numbers in texts for operators.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::text {

/// `value` with at most `digits` significant digits, without trailing zeros, then a space and the unit:
/// quantity(1.5, "s") is "1.5 s". Without a unit the number alone.
std::string quantity(double value, std::string_view unit = {}, int digits = 6);

}  // namespace trunnion::text
