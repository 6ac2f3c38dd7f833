// SPDX-License-Identifier: Apache-2.0
#include "stream/gantry_synchronization.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::stream {
namespace {

constexpr int under_control = 1;  // of Feedback::enabled, without the bit of a slave that is off

GantryFinding compare(const machine::AlarmDefinition& alarm, const machine::GantryPair& pair, double value,
                      double limit, std::uint32_t parameter, const char* what, const char* unit) {
  if (limit <= 0 || std::abs(value) <= limit) return {&alarm, std::nullopt};
  char text[200];
  std::snprintf(text, sizeof text,
                "Slave axis %d %s its master axis %d by %.4f %s, limit %.4f %s (parameter %s)", pair.slave,
                what, pair.master, value, unit, limit, unit, machine::number_text(parameter).c_str());
  return {&alarm, text};
}

}  // namespace

std::vector<double> compensated_offsets(std::size_t pairs, std::span<const double> state) {
  std::vector<double> offsets(pairs, 0.0);
  if (state.size() == pairs) std::copy(state.begin(), state.end(), offsets.begin());
  return offsets;
}

bool is_coupled(const machine::GantryPair& pair, const idl::stream::Feedback& feedback) {
  const auto columns = feedback.position.size();
  for (const int column : {pair.master_column, pair.slave_column}) {
    if (column < 0 || static_cast<std::size_t>(column) >= columns) return false;
    const auto i = static_cast<std::size_t>(column);
    if (feedback.velocity.size() <= i || feedback.torque.size() <= i || feedback.enabled.size() <= i)
      return false;
    if (feedback.enabled[i] != under_control) return false;
  }
  return feedback.mode != idl::stream::DriveMode::HOMING;
}

GantryDifference gantry_difference(const machine::GantryPair& pair, const idl::stream::Feedback& f,
                                   double offset) {
  const auto m = static_cast<std::size_t>(pair.master_column),
             s = static_cast<std::size_t>(pair.slave_column);
  return {pair.error(f.position[m], f.position[s]) - offset, (f.velocity[s] - pair.sign * f.velocity[m]) * 60,
          f.torque[s] * pair.slave_current - pair.sign * f.torque[m] * pair.master_current};
}

std::vector<GantryFinding> gantry_findings(const machine::GantryPair& pair, const GantryDifference& d) {
  return {
      compare(alarm::synchronization_error, pair, d.position, pair.limit,
              parameter::synchronization_error_limit.number(pair.slave), "is off", "mm"),
      compare(alarm::synchronization_speed, pair, d.speed, pair.speed_limit,
              parameter::synchronization_speed_limit.number(pair.slave), "differs in speed from", "mm/min"),
      compare(alarm::synchronization_current, pair, d.current, pair.current_limit,
              parameter::synchronization_current_limit.number(pair.slave), "differs in current from", "A")};
}

}  // namespace trunnion::stream
