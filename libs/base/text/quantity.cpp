// SPDX-License-Identifier: Apache-2.0
#include "text/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trunnion::text {

std::string quantity(double value, std::string_view unit, int digits) {
  char out[340];
  // No exponent while the number is one that people write out.
  const bool plain = value == 0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e12);
  if (plain) {
    const int magnitude = value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
    std::snprintf(out, sizeof out, "%.*f", std::max(0, digits - 1 - magnitude), value);
  } else {
    std::snprintf(out, sizeof out, "%.*g", digits, value);
  }
  std::string text = out;
  if (plain && text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  if (text == "-0") text = "0";
  if (!unit.empty()) text.append(" ").append(unit);
  return text;
}

}  // namespace trunnion::text
