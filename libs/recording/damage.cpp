// SPDX-License-Identifier: Apache-2.0
#include "recording/damage.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace trunnion::recording {
namespace {

constexpr std::size_t most_damages = 3;  // in one line

std::string time_of_day(std::uint64_t time, const char* format) {
  const auto seconds = static_cast<std::time_t>(time / 1'000'000'000);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[40] = "", milliseconds[8] = "";
  std::strftime(text, sizeof text, format, &parts);
  std::snprintf(milliseconds, sizeof milliseconds, ".%03uZ", static_cast<unsigned>(time / 1'000'000 % 1000));
  return std::string(text) + milliseconds;
}

}  // namespace

std::string text_of(const Damage& damage) {
  auto text = "bytes " + std::to_string(damage.begin) + " to " +
              std::to_string(std::max(damage.begin + 1, damage.end) - 1);
  if (damage.first_time != 0)
    text += ", messages of " + time_of_day(damage.first_time, "%Y-%m-%dT%H:%M:%S") + " to " +
            time_of_day(damage.last_time, "%H:%M:%S");
  return text + ": " + damage.what;
}

std::string text_of(const std::vector<Damage>& damages) {
  std::string text;
  for (std::size_t i = 0; i < std::min(damages.size(), most_damages); ++i)
    text += (i == 0 ? "damaged, " : "; ") + text_of(damages[i]);
  if (damages.size() > most_damages)
    text += "; and " + std::to_string(damages.size() - most_damages) + " more places";
  return text;
}

}  // namespace trunnion::recording
