// SPDX-License-Identifier: Apache-2.0
// What the truth of a machine, its bodies and its measurements refer to: the machine as it was designed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "canonical/axes.hpp"
#include "canonical/rotary_way.hpp"
#include "geometry/chain.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

struct AxisOutline {
  bool present = false;
  double low = 0, high = 0;  ///< travel, mm or deg
  canonical::RotaryWay way = canonical::RotaryWay::linear;
};

struct MachineOutline {
  geometry::ChainParameters design;
  std::array<AxisOutline, canonical::axis_count> axes;  ///< X Y Z A B C U V W of the channel
  std::vector<std::string> drives;                      ///< names of all servo axes, slaves of gantries too
  std::vector<std::string> turning;                     ///< those of them that turn
  std::vector<std::string> spindles;                    ///< names of the spindles
  std::optional<std::size_t> gantry;                    ///< of `axes`: the linear axis that has a slave
};

/// Of `channel`. `parameters` are those the machine was delivered with: what the operator changes later does
/// not change the machine. Throws KinematicsError.
MachineOutline outline_of(const machine::Parameters& parameters, std::uint16_t channel);

}  // namespace trunnion::machine
