// SPDX-License-Identifier: Apache-2.0
#include "recording/damage.hpp"

#include <algorithm>

#include "text/instant.hpp"

namespace trunnion::recording {
namespace {

constexpr std::size_t most_damages = 3;  // in one line
constexpr std::size_t date_length = 11;  // "2026-03-01T"

}  // namespace

std::string text_of(const Damage& damage) {
  auto words = "bytes " + std::to_string(damage.begin) + " to " +
               std::to_string(std::max(damage.begin + 1, damage.end) - 1);
  if (damage.first_time != 0)
    words += ", messages of " + text::instant(damage.first_time) + " to " +
             text::instant(damage.last_time).substr(date_length);
  return words + ": " + damage.what;
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
