// SPDX-License-Identifier: Apache-2.0
// What a block of the LinuxCNC dialect moves.
#pragma once

#include "language/block_context.hpp"
#include "language/linuxcnc_curves.hpp"
#include "language/linuxcnc_cycles.hpp"
#include "language/linuxcnc_threads.hpp"
#include "language/path_motion.hpp"
#include "language/positioning.hpp"

namespace trunnion::language {

class LinuxcncMotion : private BlockHandler {
 public:
  LinuxcncMotion(BlockContext& context, PathMotion& motion, Positioning& positioning, LinuxcncCycles& cycles,
                 LinuxcncThreads& threads, LinuxcncCurves& curves)
      : BlockHandler(context),
        motion_(motion),
        positioning_(positioning),
        cycles_(cycles),
        threads_(threads),
        curves_(curves) {}

  /// A motion code that only LinuxCNC has, by its tenths.
  Fault set_motion(std::uint16_t at, std::uint16_t tenths);
  /// G80 leaves no motion code, another one ends that.
  void note_codes();
  /// By the active code, if there is one.
  Fault move();
  /// G53: with G0 or G1 and in G90 only.
  Fault move_in_machine_coordinates(std::uint16_t at);

 private:
  Fault move_by_own_code();
  /// G38.2 and G38.3: the skip input 1 is the probe.
  Fault probe(std::uint16_t at, bool must_touch);

  PathMotion& motion_;
  Positioning& positioning_;
  LinuxcncCycles& cycles_;
  LinuxcncThreads& threads_;
  LinuxcncCurves& curves_;
};

}  // namespace trunnion::language
