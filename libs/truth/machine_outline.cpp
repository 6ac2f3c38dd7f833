// SPDX-License-Identifier: Apache-2.0
#include "truth/machine_outline.hpp"

#include "machine/axes.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/gantry_pairs.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::truth {

MachineOutline outline_of(const machine::Parameters& parameters, std::uint16_t channel) {
  MachineOutline outline;
  outline.design = machine::chain_parameters(parameters, channel);
  const auto axes = machine::channel_axes(parameters, channel);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const auto travel = machine::travel_of(parameters, axes.number[i]);
    outline.axes[axes.index[i]] = {true, travel.negative, travel.positive,
                                   machine::rotary_way(parameters, axes.number[i])};
  }
  for (const auto& axis : machine::drive_axes(parameters)) {
    outline.drives.push_back(axis.name);
    if (axis.type != machine::axis_type_linear) outline.turning.push_back(axis.name);
  }
  for (const auto& spindle : machine::spindles(parameters)) outline.spindles.push_back(spindle.name);
  for (const auto& pair : machine::gantry_pairs(parameters, channel))
    for (std::size_t i = 0; i < axes.index.size(); ++i)
      if (axes.number[i] == pair.master && axes.index[i] < 3) outline.gantry = axes.index[i];
  return outline;
}

}  // namespace trunnion::truth
