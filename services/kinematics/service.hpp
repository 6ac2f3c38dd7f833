// SPDX-License-Identifier: Apache-2.0
// The process of the kinematics: the stage that makes machine axes of the path of the tool tip.
#pragma once

#include "core/kinematics_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::kinematics {

class KinematicsService : public stream::StageService<idl::stream::PathBatch> {
 public:
  explicit KinematicsService(service::Node& node);
};

}  // namespace trunnion::kinematics
