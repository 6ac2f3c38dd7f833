// The channel's entry in the stream's states: what a process that has just begun needs to go on for the one
// before it.
#pragma once

#include <optional>
#include <vector>

#include "contracts/types.hpp"
#include "program_execution/skip_result.hpp"

namespace trunnion::channel {

using language::AxisValues;
using program_execution::SkipResult;

struct ChannelSnapshot {
  bool running = false;  ///< a program is under way that can be gone on with
  std::uint32_t crc = 0;
  std::uint64_t revision = 0;
  std::uint32_t sequence = 0, line = 0;  ///< of the newest setpoint's command
  double fraction = 0;                   ///< of it that is done
  language::Transformation transformation = language::Transformation::none;
  double tool_length = 0;  ///< mm
  std::uint32_t tool = 0;
  AxisValues position{};  ///< of the path, in the frame of `transformation`
  AxisValues start{};     ///< machine coordinates at which the program began
  bool offset_on = false;
  AxisValues offset{};  ///< of the handwheel, added to the path in machine coordinates
  bool dry_run = false, auxiliary_lock = false;
  std::uint16_t block_skip = 0;
  std::vector<SkipResult> skips;  ///< results of the program's skip moves so far
};

/// Writes into `values`, which keeps its memory; `skips` take the place of the snapshot's. More of them than
/// the state has room for are left out: the program is then not resumable.
void store(const ChannelSnapshot& snapshot, const std::vector<SkipResult>& skips,
           std::vector<double>& values);
/// Nothing when the states have none of a channel.
std::optional<ChannelSnapshot> snapshot_of(const std::vector<idl::stream::StageState>& states);

}  // namespace trunnion::channel
