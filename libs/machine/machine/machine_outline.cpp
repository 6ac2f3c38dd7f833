// SPDX-License-Identifier: Apache-2.0
#include "machine/machine_outline.hpp"

#include "machine/axes.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine {

MachineOutline outline_of(const Parameters& parameters, std::uint16_t channel) {
  MachineOutline outline;
  outline.design = chain_parameters(parameters, channel);
  const auto axes = channel_axes(parameters, channel);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const auto travel = travel_of(parameters, axes.number[i]);
    outline.axes[axes.index[i]] = {true, travel.negative, travel.positive,
                                   rotary_way(parameters, axes.number[i])};
  }
  for (const auto& axis : drive_axes(parameters)) {
    outline.drives.push_back(axis.name);
    if (axis.type != axis_type_linear) outline.turning.push_back(axis.name);
  }
  for (const auto& spindle : spindles(parameters)) outline.spindles.push_back(spindle.name);
  for (const auto& pair : gantry_pairs(parameters, channel))
    for (std::size_t i = 0; i < axes.index.size(); ++i)
      if (axes.number[i] == pair.master && axes.index[i] < 3) outline.gantry = axes.index[i];
  return outline;
}

}  // namespace trunnion::machine
