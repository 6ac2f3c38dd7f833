// SPDX-License-Identifier: Apache-2.0
// Which axes a machine and its channels have.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "canonical/rotary_way.hpp"
#include "machine/kinematics.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

inline constexpr int axis_type_linear = 1, axis_type_swivel = 2, axis_type_rotary = 3, axis_type_spindle = 10;
inline constexpr std::uint16_t channel_count = 10;  ///< that the catalogue has parameters for
inline constexpr int spindle_letter = -2;           ///< 04c001..04c009 of a letter that is a spindle

struct AxisInfo {
  std::uint16_t number = 0;  ///< logical axis number
  std::string name;
  int type = axis_type_linear;
};

/// Servo axes in the order of their logical numbers: the columns of the drive's feedback. Spindles are left
/// out.
std::vector<AxisInfo> drive_axes(const Parameters& parameters);
std::vector<AxisInfo> spindles(const Parameters& parameters);

/// Column of logical axis `number` in drive_axes, or -1.
int column_of(const std::vector<AxisInfo>& axes, std::uint16_t number);

/// Parameters 10a949 and 10a001: linear for all but rotary axes.
canonical::RotaryWay rotary_way(const Parameters& parameters, std::uint16_t axis);

/// Whether a table of errors over `axis` holds at every turn of it. One that counts modulo 360 needs a table
/// that repeats, `period` degrees long, at the same place of each turn.
bool holds_at_every_turn(const Parameters& parameters, std::uint16_t axis, bool repeats, double period);

/// Software travel limits of a logical axis, mm or degrees; without end where it counts modulo 360.
geometry::AngleTravel travel_of(const Parameters& parameters, std::uint16_t axis);

struct ChannelAxes {
  std::vector<std::uint8_t> index;    ///< 0..8 for X Y Z A B C U V W
  std::vector<std::uint16_t> number;  ///< logical axis number of each
  std::string letters;
};

/// Axes of a channel in the order X Y Z A B C U V W (parameters 04c001..04c009).
ChannelAxes channel_axes(const Parameters& parameters, std::uint16_t channel);

}  // namespace trunnion::machine
