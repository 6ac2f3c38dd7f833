// SPDX-License-Identifier: Apache-2.0
#include "text/instant.hpp"

#include <cstdio>

namespace trunnion::text {

std::string instant(std::uint64_t nanoseconds, std::size_t digits) {
  constexpr std::uint64_t second = 1'000'000'000;
  char decimals[16] = "";
  std::snprintf(decimals, sizeof decimals, "%09u", static_cast<unsigned>(nanoseconds % second));
  auto text = whole_second(static_cast<std::time_t>(nanoseconds / second));
  return text.insert(text.size() - 1, "." + std::string(decimals, digits));
}

std::string whole_second(std::time_t seconds) {
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[40] = "";
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace trunnion::text
