// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/spindle_sync_speeds.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine_tests {
namespace {

constexpr unsigned gear_count = 5;                         // M41 .. M45
constexpr double first_choice = 1000, last_choice = 2000;  // 1/min
constexpr double least_speed = 1;                          // 1/min

std::string range_text(double lowest, double highest) {
  return std::isinf(highest) ? fmt::format("{:g} 1/min and more", lowest)
                             : fmt::format("{:g} .. {:g} 1/min", lowest, highest);
}

}  // namespace

SpindleSyncSpeeds::SpindleSyncSpeeds(const machine::Parameters& parameters,
                                     const std::vector<machine::AxisInfo>& spindles,
                                     const idl::stream::Feedback& feedback) {
  for (std::size_t i = 0; i < spindles.size(); ++i) {
    const auto axis = spindles[i].number;
    auto& spindle = spindles_.emplace_back();
    spindle.name = spindles[i].name;
    spindle.gear = i < feedback.spindles.size() ? feedback.spindles[i].gear : 0u;
    if (const double most = parameters.get(parameter::maximum_speed, axis); most > 0)
      spindle.highest = most, spindle.highest_number = parameter::maximum_speed.number(axis);
    for (unsigned gear = 1; gear <= gear_count; ++gear) {
      const double lowest = parameters.get(parameter::gear_lowest_speed, axis, gear - 1);
      const double highest = parameters.get(parameter::gear_highest_speed, axis, gear - 1);
      if (highest <= 0) continue;
      if (gear != spindle.gear) {
        spindle.others.push_back({gear, lowest, highest});
        continue;
      }
      spindle.lowest = lowest, spindle.lowest_number = parameter::gear_lowest_speed.number(axis, gear - 1);
      if (highest > spindle.highest) continue;
      spindle.highest = highest;
      spindle.highest_number = parameter::gear_highest_speed.number(axis, gear - 1);
    }
  }
}

double SpindleSyncSpeeds::lowest() const {
  double lowest = 0;
  for (const auto& spindle : spindles_) lowest = std::max(lowest, spindle.lowest);
  return lowest;
}

double SpindleSyncSpeeds::highest() const {
  double highest = std::numeric_limits<double>::infinity();
  for (const auto& spindle : spindles_) highest = std::min(highest, spindle.highest);
  return highest;
}

// Whole speeds.
std::vector<double> SpindleSyncSpeeds::choice() const {
  const double low = std::max(std::ceil(lowest()), least_speed), high = std::floor(highest());
  if (low > high)
    throw std::runtime_error("no speed is in the range of all spindles (" + all_words() +
                             "): engage other gears at rest first");
  double first = low, last = std::min(2 * low, high);
  if (high < last_choice)
    first = std::max(low, std::floor(high / 2)), last = high;
  else if (low < last_choice)
    first = std::max(low, first_choice), last = last_choice;
  return first < last ? std::vector<double>{first, last} : std::vector<double>{first};
}

std::string SpindleSyncSpeeds::refusal(double speed) const {
  for (const auto& spindle : spindles_) {
    if (speed >= spindle.lowest && speed <= spindle.highest) continue;
    const auto number = speed < spindle.lowest ? spindle.lowest_number : spindle.highest_number;
    auto why = fmt::format("{:g} 1/min cannot be tested: spindle {} {} {} ({})", speed, spindle.name,
                           spindle.gear > 0 ? fmt::format("is in gear {}, which has", spindle.gear) : "has",
                           range_text(spindle.lowest, spindle.highest), machine::number_text(number));
    const auto other = std::find_if(spindle.others.begin(), spindle.others.end(), [&](const Gear& gear) {
      return speed >= gear.lowest && speed <= gear.highest;
    });
    if (other != spindle.others.end())
      why += fmt::format("; engage gear {} (M4{}, {}) at rest first", other->number, other->number,
                         range_text(other->lowest, other->highest));
    if (lowest() <= highest()) why += "; now the spindles have " + range_text(lowest(), highest());
    return why;
  }
  return "";
}

std::string SpindleSyncSpeeds::text() const {
  return range_text(lowest(), highest()) + " (" + all_words() + ")";
}

std::string SpindleSyncSpeeds::words(const Spindle& spindle) {
  const auto gear = spindle.gear > 0 ? fmt::format("in gear {}", spindle.gear) : "without gears";
  return fmt::format("{} {}: {}", spindle.name, gear, range_text(spindle.lowest, spindle.highest));
}

std::string SpindleSyncSpeeds::all_words() const {
  std::string all;
  for (const auto& spindle : spindles_) all += (all.empty() ? "" : "; ") + words(spindle);
  return all;
}

}  // namespace trunnion::machine_tests
