#include "service.hpp"

namespace trunnion::compensation {

CompensationService::CompensationService(node::Node& node)
    : StageService(node, stream::Stage::COMPENSATION, topics::kinematics_frame, topics::compensation_frame,
                   [] { return std::make_unique<CompensationCore>(); }) {}

}  // namespace trunnion::compensation
