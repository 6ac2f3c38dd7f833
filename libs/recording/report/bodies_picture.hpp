// SPDX-License-Identifier: Apache-2.0
// A picture of the bodies of a machine.
#pragma once

#include <string>

#include "collision/collision_model.hpp"

namespace trunnion::report {

/// The outlines of all bodies with the axes at `position`, seen from the front (XZ), from the side (YZ) and
/// from above (XY), with the two points of the nearest pair. SVG; the same inputs give the same bytes.
std::string bodies_picture(const collision::CollisionModel& model, const collision::AxisPosition& position,
                           const std::string& title);

}  // namespace trunnion::report
