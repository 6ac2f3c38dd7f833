// SPDX-License-Identifier: Apache-2.0
// The reference motions with their bounds: what `trunnion bench motion` prints and the tests ask for.
#pragma once

#include <string>
#include <vector>

#include "motion_analysis/reference_paths.hpp"

namespace trunnion::analysis {

/// A reference path and the time it may take.
struct ReferenceCase {
  ReferencePath path;
  double bound = 0;      ///< s
  std::string bound_is;  ///< what the bound is
  double allowed = 0;    ///< s
};

/// Line, corners, circle, five-axis wavy cap, dense three-axis path.
std::vector<ReferenceCase> reference_cases();

struct ReferenceResult {
  RunReport run;
  bool good = false;  ///< stopped in time, within every limit and tolerance
};

ReferenceResult run_case(const ReferenceCase& reference);

}  // namespace trunnion::analysis
