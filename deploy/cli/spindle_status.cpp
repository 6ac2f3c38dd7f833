// SPDX-License-Identifier: Apache-2.0
#include "spindle_status.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace trunnion::cli {
namespace {

constexpr double degrees = 360;  // of a turn

// To so many parts of a unit, and never -0.
double to_parts(double value, double parts) { return std::round(value * parts) / parts + 0.0; }

// deg, 0 up to 359.99
double angle_of(const idl::stream::SpindleState& state) {
  constexpr double parts = 100;
  const double turn = state.angle - std::floor(state.angle);
  return std::fmod(std::round(turn * degrees * parts), degrees * parts) / parts;
}

double error_of(const idl::stream::SpindleState& state) {
  return to_parts(state.synchronization_error * degrees, 1000);
}

// "at speed" of SPINDLE_AT_SPEED
std::string words_of(idl::stream::SpindleCondition condition) {
  constexpr std::string_view prefix = "SPINDLE_";
  std::string text = bus::to_string(condition);
  if (text.starts_with(prefix)) text.erase(0, prefix.size());
  for (char& c : text) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

bus::Json SpindleStatus::json() const {
  return {{"spindle", name},
          {"condition", bus::to_string(state.condition)},
          {"speed_per_min", to_parts(speed, 100)},
          {"reference_per_min", to_parts(state.reference, 100)},
          {"homed", state.homed},
          {"angle_deg", angle_of(state)},
          {"gear", state.gear},
          {"master", master},
          {"synchronization_error_deg", error_of(state)},
          {"correction_per_min", to_parts(state.correction, 100)}};
}

std::string SpindleStatus::line() const {
  auto text = fmt::format("{:<8} {:.0f} of {:.0f} 1/min, {}", name, to_parts(speed, 1),
                          to_parts(state.reference, 1), words_of(state.condition));
  if (state.gear > 0) text += fmt::format(", gear {}", unsigned{state.gear});
  text += state.homed ? fmt::format(", {:.2f} deg", angle_of(state)) : ", no index mark yet";
  if (!master.empty()) text += fmt::format(", follows {}, error {:.3f} deg", master, error_of(state));
  return text;
}

std::vector<SpindleStatus> spindle_status(const std::vector<machine::AxisInfo>& spindles,
                                          const idl::stream::Feedback& feedback) {
  std::vector<SpindleStatus> all;
  const std::size_t count =
      std::min({spindles.size(), feedback.spindles.size(), feedback.spindle_speed.size()});
  for (std::size_t i = 0; i < count; ++i) {
    const auto& state = feedback.spindles[i];
    std::string master;
    if (state.master >= 0) {
      const auto number = static_cast<std::size_t>(state.master);
      master = number < spindles.size() ? spindles[number].name : "spindle " + std::to_string(number + 1);
    }
    all.push_back({spindles[i].name, state, feedback.spindle_speed[i], std::move(master)});
  }
  return all;
}

}  // namespace trunnion::cli
