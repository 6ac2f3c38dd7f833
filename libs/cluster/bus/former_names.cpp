// SPDX-License-Identifier: Apache-2.0
#include "bus/former_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>

namespace trunnion::bus {
namespace {

bool is_part_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view name_of_today(std::string_view word) {
  using Name = std::pair<std::string_view, std::string_view>;  // before, today
  static constexpr std::array<Name, 15> renamed{{
      {"PathFrame", "PathBatch"},
      {"AxisFrame", "AxisBatch"},
      {"FeedbackFrame", "Feedback"},
      {"path_frame", "path_batch"},
      {"axis_frame", "axis_batch"},
      {"kinematics_frame", "kinematics_batch"},
      {"compensation_frame", "compensation_batch"},
      {"gantry_frame", "gantry_batch"},
      {"feedback_frame", "feedback"},
      {"GANTRY_FRAME", "GANTRY_BATCH"},
      {"frames_ahead", "cycles_ahead"},
      {"frames_in", "messages_in"},
      {"frames_out", "messages_out"},
      {"frames_lost", "cycles_lost"},
      {"frames_per_second", "messages_per_second"},
  }};
  for (const auto& [before, today] : renamed)
    if (word == before) return today;
  return word;
}

}  // namespace

std::string with_names_of_today(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const auto length =
        static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_part_of_name) - text.begin());
    out += name_of_today(text.substr(0, length));
    if (length < text.size()) out += text[length];
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

}  // namespace trunnion::bus
