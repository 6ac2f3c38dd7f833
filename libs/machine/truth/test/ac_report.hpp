// SPDX-License-Identifier: Apache-2.0
// The AC trunnion machine with the errors of a text, for tests of what is reported of it.
#pragma once

#include <string>

#include "outline.hpp"
#include "truth/pose_report.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::truth {

inline PoseReport report(const std::string& text) {
  return {make_geometry(parse_truth(text, "truth.yaml", ac).geometry, ac, "truth.yaml"),
          geometry::make(ac.design), ac};
}

}  // namespace trunnion::truth
