// SPDX-License-Identifier: Apache-2.0
// The inputs of drive and PLC at the ticks at which they took effect, as the two have said themselves.
#pragma once

#include "verification/verify_plan.hpp"

namespace trunnion::verification {

/// Whether `service` says at which tick its inputs take effect.
bool says_when(const std::string& service);

/// Fills steps, end, expected and cycles of `plan`, whose topics are known. Inputs that are about nothing
/// (a sign of life) are fed in the order of the writers' clocks. Throws std::runtime_error when the recording
/// lacks an input that took effect.
void plan_by_tick(const StoredRecording& recording, const std::string& service, VerifyPlan& plan);

}  // namespace trunnion::verification
