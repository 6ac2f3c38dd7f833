// SPDX-License-Identifier: Apache-2.0
// Where a skip move (G31) ended.
#pragma once

#include "language/canonical.hpp"

namespace trunnion::program_execution {

using language::AxisValues;

/// Where a skip move ended and where its input found the axes, in the frame of the move. Without an edge both
/// are its end.
struct SkipResult {
  AxisValues stopped{}, touched{};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("stopped", self.stopped), visit("touched", self.touched);
  }
};

}  // namespace trunnion::program_execution
