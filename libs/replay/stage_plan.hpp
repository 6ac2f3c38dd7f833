// The inputs of kinematics, compensation and gantry in the order of their cycles.
#pragma once

#include "replay/verify_plan.hpp"

namespace trunnion::replay {

struct Stage {
  const char* service;
  idl::stream::Stage number;   ///< as in AxisFrame
  const char *input, *output;  ///< handles
};

/// Null when `service` is none of the three.
const Stage* find_stage(const std::string& service);

/// Fills steps, end, expected and cycles of `plan`. Throws std::runtime_error when inputs are missing.
void plan_stage(const StoredRecording& recording, const Stage& stage, VerifyPlan& plan);

}  // namespace trunnion::replay
