// SPDX-License-Identifier: Apache-2.0
// Where a skip move (G31) ended; also what else a program has learned at rest, in its order: where a search
// for references has ended, and values of spindles and signals (ProgramFlow::value_read).
#pragma once

#include <vector>

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

/// `results` are those of `others` and more; both are of one run of a program.
inline bool goes_farther(const std::vector<SkipResult>& results, const std::vector<SkipResult>& others) {
  if (results.size() != others.size()) return results.size() > others.size();
  return !results.empty() && results.back().touched[language::X] > others.back().touched[language::X];
}

}  // namespace trunnion::program_execution
