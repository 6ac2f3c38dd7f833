// SPDX-License-Identifier: Apache-2.0
#include "text/instant.hpp"

#include <cstdio>
#include <ctime>

namespace trunnion::text {

std::string instant(std::uint64_t nanoseconds, std::size_t digits) {
  constexpr std::uint64_t second = 1'000'000'000;
  const auto seconds = static_cast<std::time_t>(nanoseconds / second);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char date[40] = "", decimals[16] = "";
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(decimals, sizeof decimals, "%09u", static_cast<unsigned>(nanoseconds % second));
  return std::string(date) + "." + std::string(decimals, digits) + "Z";
}

}  // namespace trunnion::text
