// SPDX-License-Identifier: Apache-2.0
#include "stream/drive_at_rest.hpp"

#include <cmath>
#include <cstddef>
#include <cstdio>

namespace trunnion::stream {
namespace {

using idl::stream::SpindleCondition;

constexpr double rest_speed = 5;  // 1/min, at most, as SPINDLE_STOPPED has it

std::string speed_text(double speed) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f 1/min", std::abs(speed));
  return text;
}

}  // namespace

std::string tap_in_hole(const idl::channel::ChannelState& state) {
  return state.detail.starts_with(tap_in_hole_detail) ? state.detail : std::string();
}

std::string spindle_at_work(const idl::stream::Feedback& newest) {
  const auto name = [](std::size_t spindle) { return "spindle " + std::to_string(spindle + 1); };
  const auto& speeds = newest.spindle_speed;
  // A master turns with its slave: who only stops it has not ended the synchronization.
  for (std::size_t i = 0; i < newest.spindles.size(); ++i) {
    const auto& spindle = newest.spindles[i];
    const auto speed = speed_text(i < speeds.size() ? speeds[i] : 0);
    if (spindle.condition == SpindleCondition::SPINDLE_FOLLOWS_PATH)
      return name(i) + " follows the path of a tap, at " + speed + "; let the tap come out of its hole first";
    if (spindle.condition != SpindleCondition::SPINDLE_SYNCHRONIZING &&
        spindle.condition != SpindleCondition::SPINDLE_SYNCHRONIZED)
      continue;
    const auto master =
        spindle.master < 0 ? std::string("another one") : name(static_cast<std::size_t>(spindle.master));
    return name(i) + " follows " + master + ", at " + speed + "; stop both and end the synchronization first";
  }
  for (std::size_t i = 0; i < speeds.size(); ++i)
    if (std::abs(speeds[i]) > rest_speed)
      return name(i) + " turns at " + speed_text(speeds[i]) + "; stop it (M5) first";
  return "";
}

}  // namespace trunnion::stream
