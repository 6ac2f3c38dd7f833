// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

namespace trunnion::compensation {

CompensationService::CompensationService(service::Node& node)
    : StageService(node, stream::Stage::COMPENSATION, topics::kinematics_batch, topics::compensation_batch,
                   [] { return std::make_unique<CompensationCore>(); }) {}

}  // namespace trunnion::compensation
