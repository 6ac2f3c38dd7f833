// SPDX-License-Identifier: Apache-2.0
// What brings the machine to a point of a program away from its position: functions first, then moves.
#pragma once

#include <string>
#include <vector>

#include "channel_setup/channel_setup.hpp"
#include "language/program_frame.hpp"
#include "program_execution/auxiliary_memory.hpp"

namespace trunnion::channel {

using language::AxisValues;
using program_execution::AuxiliaryFunction;

/// What is done, in this sequence, before a program continues.
struct Preparation {
  std::vector<AuxiliaryFunction> functions;
  std::vector<language::Command> moves;  ///< rapids in machine coordinates, with a stop between them
};

/// The approach from `from` to `to`, machine coordinates in mm and degrees. With Z going up, Z moves first
/// and then all the other axes together; with Z going down, the others first and Z last. So the tool leaves
/// the part before it moves over it, and comes to it last. Empty when nothing has to move. `line` is what the
/// setpoints of the approach show.
std::vector<language::Command> approach_moves(const AxisValues& from, const AxisValues& to,
                                              std::uint32_t line);

/// The first thing wrong with the approach: an axis would leave its travel, or come where the zone of `frame`
/// (null: none is known) forbids. Empty when it is right.
std::string approach_error(const channel_setup::ChannelSetup& machine, const AxisValues& from,
                           const std::vector<language::Command>& moves,
                           const language::ProgramFrame* frame = nullptr);

/// In words for the operator, e.g. "S1000 M3 M8, approach X10.0000 Y5.0000, then Z-3.0000".
std::string words_of(const Preparation& preparation, const AxisValues& from);

}  // namespace trunnion::channel
