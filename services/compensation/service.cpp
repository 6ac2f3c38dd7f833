#include "service.hpp"

namespace trunnion::compensation {

CompensationService::CompensationService(service::Node& node)
    : StageService(node, stream::stage_compensation, topics::kinematics_frame, topics::compensation_frame,
                   [] { return std::make_unique<CompensationCore>(); }) {}

}  // namespace trunnion::compensation
