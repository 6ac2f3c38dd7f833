// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/kinematics_core.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::kinematics {

class KinematicsService : public stream::StageService<idl::stream::PathBatch> {
 public:
  explicit KinematicsService(service::Node& node);
};

}  // namespace trunnion::kinematics
