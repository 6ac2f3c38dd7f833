// SPDX-License-Identifier: Apache-2.0
// How a touch probe in the spindle is turned about its own axis: the lobes of its pre-travel turn with it.
#pragma once

#include <vector>

#include "geometry/chain.hpp"

namespace trunnion::touch_probe {

class ProbeOrientation {
 public:
  /// `design`: the machine without errors, which are far below what the lobes can show.
  explicit ProbeOrientation(const geometry::ChainParameters& design);
  /// The probe's X as the workpiece sees it, a unit vector; `degrees` of A B C U V W. No allocation.
  geometry::Vec3 across(const geometry::Angles& degrees) const;

 private:
  std::vector<geometry::OrientingAxis> axes_;  // from the workpiece to the tool
};

}  // namespace trunnion::touch_probe
