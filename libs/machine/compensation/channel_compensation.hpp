// SPDX-License-Identifier: Apache-2.0
// Every compensation of one channel as its parameters describe it.
#pragma once

#include <optional>
#include <vector>

#include "compensation/angle.hpp"
#include "compensation/backlash.hpp"
#include "compensation/reversal_jump.hpp"
#include "compensation/squareness.hpp"
#include "compensation/straightness.hpp"
#include "compensation/thermal.hpp"
#include "compensation/volumetric_compensation.hpp"
#include "machine/gantry_pairs.hpp"

namespace trunnion::compensation {

/// What one axis adds to its setpoint.
struct AxisCompensation {
  /// It depends on more than the setpoint and its direction.
  bool has_further_state() const { return backlash.has_rapid || thermal.enabled || jump.amount != 0; }
  bool active() const {
    return backlash.active() || pitch.enabled || thermal.enabled || jump.amount != 0 || !squareness.empty() ||
           !straightness.empty();
  }

  Backlash backlash;
  ErrorTable pitch;
  Thermal thermal;
  ReversalJump jump;
  std::vector<Squareness> squareness;
  std::vector<Straightness> straightness;
};

struct CompensatedSlave {
  machine::GantryPair pair;
  std::size_t master = 0;  ///< column of its master
};

struct ChannelCompensation {
  static constexpr std::size_t most_axes = 32;

  std::vector<AxisCompensation> axes;     ///< of the channel, then of the slaves
  std::vector<CompensatedSlave> slaves;   ///< those that are compensated, or whose master is
  std::vector<AngleCompensation> angles;  ///< of all axes
  std::vector<std::uint8_t> letters;      ///< 0 .. 8 of the channel's axes
  std::optional<volumetric::VolumetricCompensation> volumetric;

  /// Throws machine::KinematicsError that names the parameter and its limit.
  static ChannelCompensation read(const machine::Parameters& parameters, std::uint16_t channel);
};

}  // namespace trunnion::compensation
