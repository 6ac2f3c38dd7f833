// SPDX-License-Identifier: Apache-2.0
// The inputs of a stage that computes from another's output, in the order of their cycles.
#pragma once

#include "machine/service_definition.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {

/// Null when `service` is no stage that computes from another's output.
const machine::ServiceDefinition* find_stage(const std::string& service);

/// Fills steps, end, expected and cycles of `plan`. Throws std::runtime_error when inputs are missing.
void plan_stage(const StoredRecording& recording, const machine::ServiceDefinition& stage, VerifyPlan& plan);

}  // namespace trunnion::verification
