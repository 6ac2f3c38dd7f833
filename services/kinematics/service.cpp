// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

namespace trunnion::kinematics {

KinematicsService::KinematicsService(service::Node& node)
    : StageService(node, stream::Stage::KINEMATICS, topics::path_batch, topics::kinematics_batch,
                   [] { return std::make_unique<KinematicsCore>(); }) {}

}  // namespace trunnion::kinematics
