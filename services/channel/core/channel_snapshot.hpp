// SPDX-License-Identifier: Apache-2.0
// The channel's snapshot in the stream: what a fresh process needs to continue for the one before it.
#pragma once

#include <optional>
#include <vector>

#include "contracts/types.hpp"
#include "program_execution/skip_result.hpp"

namespace trunnion::channel {

using language::AxisValues;
using program_execution::SkipResult;

/// idl::stream::ChannelSnapshot in the types of the channel.
struct ChannelSnapshot {
  bool running = false;  ///< a program is executed that can be continued
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
  bool in_thread = false;         ///< the command follows the spindle
  double thread_origin = 0;       ///< of the thread, rev
  std::vector<SkipResult> skips;  ///< results of the program's skip moves so far
};

/// Makes `out` valid, but for its cycle; it keeps its memory. `skips` take the place of the snapshot's. More
/// of them than the message has room for are left out: the program can then not be continued.
void store(const ChannelSnapshot& snapshot, const std::vector<SkipResult>& skips,
           idl::stream::ChannelSnapshot& out);
/// Nothing when it is not valid.
std::optional<ChannelSnapshot> snapshot_of(const idl::stream::ChannelSnapshot& stored);

/// To and from the enumerator of the contract.
idl::stream::Transformation idl_of(language::Transformation transformation);
language::Transformation transformation_of(idl::stream::Transformation transformation);

}  // namespace trunnion::channel
