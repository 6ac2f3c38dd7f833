// SPDX-License-Identifier: Apache-2.0
// What a block of the LinuxCNC dialect moves.
#pragma once

#include "language/block_context.hpp"
#include "language/linuxcnc_cycles.hpp"
#include "language/path_motion.hpp"

namespace trunnion::language {

class LinuxcncMotion : private BlockHandler {
 public:
  LinuxcncMotion(BlockContext& context, PathMotion& motion, LinuxcncCycles& cycles)
      : BlockHandler(context), motion_(motion), cycles_(cycles) {}

  /// G80 leaves no motion code, another one ends that.
  void note_codes();
  /// By the active code, if there is one.
  Fault move();

 private:
  PathMotion& motion_;
  LinuxcncCycles& cycles_;
};

}  // namespace trunnion::language
