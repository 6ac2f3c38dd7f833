// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/circle_report.hpp"

namespace trunnion::circular_tests {

CircleReport circle_report(const std::string& plane, double radius, Readings ccw, Readings cw) {
  CircleReport r{plane, radius, circular_figures(ccw, cw, radius), ballbar_causes(ccw, cw, radius), {}};
  r.shares = cause_shares(r.causes, radius);
  for (auto& share : r.shares)
    if (share.name.ends_with('1') || share.name.ends_with('2'))
      share.name.back() = plane[share.name.back() == '1' ? 0 : 1];
  return r;
}

}  // namespace trunnion::circular_tests
