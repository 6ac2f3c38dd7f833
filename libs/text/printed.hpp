// SPDX-License-Identifier: Apache-2.0
// Text by the formats of printf.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace trunnion::text {

/// As printf, of any length.
std::string printed(const char* format, auto... values) {
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

}  // namespace trunnion::text
