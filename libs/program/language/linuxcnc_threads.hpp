// SPDX-License-Identifier: Apache-2.0
// Threads as LinuxCNC means them: G33, rigid tapping (G33.1) and threading in passes (G76).
#pragma once

#include "language/block_context.hpp"
#include "language/path_motion.hpp"
#include "language/thread_passes.hpp"

namespace trunnion::language {

class LinuxcncThreads : private BlockHandler {
 public:
  LinuxcncThreads(BlockContext& context, PathMotion& motion) : BlockHandler(context), motion_(motion) {}

  /// G33: K is the lead along the way, whatever its direction. Every block begins at the index mark.
  Fault cut(std::uint16_t at);
  /// G33.1: in and out again along one axis; I times the speed on the way out.
  Fault tap(std::uint16_t at);
  /// G76: the moves come with next_pass().
  Fault begin_passes(std::uint16_t at);
  Fault next_pass();

 private:
  Fault read_lead(std::uint16_t at, double& lead);
  Fault read_return(double& speed);
  Fault read_passes(std::uint16_t at, ThreadPasses::Words& words);
  Fault read_taper(ThreadPasses::Words& words);
  Fault check_passes(std::uint16_t at, const ThreadPasses::Words& words) const;
  /// mm of an I, J or K of G76, which count as X does.
  double height(char letter);
  Fault rapid_to(double x, double z);
  Fault thread_to(double x, double z, bool begins);
  /// In mm per revolution of the axis that goes farthest to `target` (program coordinates).
  double lead_of_farthest(double lead, const AxisValues& target) const;

  PathMotion& motion_;
  ThreadPasses passes_;
  std::uint16_t at_ = 0;
};

}  // namespace trunnion::language
