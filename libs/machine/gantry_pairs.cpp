// SPDX-License-Identifier: Apache-2.0
#include "machine/gantry_pairs.hpp"

#include <algorithm>
#include <stdexcept>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine {

std::vector<GantryPair> gantry_pairs(const Parameters& p) {
  std::vector<GantryPair> pairs;
  const auto axes = drive_axes(p);
  const int slaves = p.integer(parameter::gantry_slaves);
  for (int i = 0; i < slaves; ++i) {
    const int slave = p.integer(parameter::gantry_slave_axis, 0, static_cast<std::uint32_t>(i));
    if (slave < 0 || p.integer(parameter::gantry_synchronous, static_cast<std::uint32_t>(slave)) != 1)
      continue;
    const auto a = static_cast<std::uint32_t>(slave);
    GantryPair pair;
    const int master = p.integer(parameter::gantry_master, a);
    pair.slave = static_cast<std::uint16_t>(slave);
    pair.master = static_cast<std::uint16_t>(std::max(0, master));
    pair.slave_column = column_of(axes, pair.slave);
    pair.master_column = column_of(axes, pair.master);
    if (master < 0 || pair.slave_column < 0 || pair.master_column < 0)
      throw std::runtime_error("parameter " + number_text(parameter::gantry_master.number(a)) +
                               " (gantry_master): axis " + std::to_string(slave) + " follows axis " +
                               std::to_string(master) + ", and one of them does not exist");
    pair.sign = p.integer(parameter::gantry_mirror, a) == 1 ? -1 : 1;
    pair.zero_deviation = p.get(parameter::gantry_zero_deviation, a);
    pair.rate = p.get(parameter::gantry_compensation_rate, a);
    pair.maximum = p.get(parameter::gantry_compensation_maximum, a);
    pair.warning = p.get(parameter::synchronization_warning_limit, a);
    pair.limit = p.get(parameter::synchronization_error_limit, a);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<GantryPair> gantry_pairs(const Parameters& parameters, std::uint16_t channel) {
  auto pairs = gantry_pairs(parameters);
  const auto numbers = channel_axes(parameters, channel).number;
  std::erase_if(pairs, [&](const GantryPair& pair) {
    return std::find(numbers.begin(), numbers.end(), pair.master) == numbers.end();
  });
  return pairs;
}

bool axis_moves_with(const Parameters& parameters, std::uint16_t axis, std::uint16_t channel) try {
  const auto numbers = channel_axes(parameters, channel).number;
  if (std::find(numbers.begin(), numbers.end(), axis) != numbers.end()) return true;
  const auto pairs = gantry_pairs(parameters, channel);
  return std::any_of(pairs.begin(), pairs.end(), [&](const GantryPair& pair) { return pair.slave == axis; });
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace trunnion::machine
