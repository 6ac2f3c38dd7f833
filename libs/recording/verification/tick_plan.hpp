// SPDX-License-Identifier: Apache-2.0
// The inputs of drive and PLC at the ticks at which they took effect, as the two have said themselves.
#pragma once

#include "verification/verify_plan.hpp"

namespace trunnion::verification {

/// Whether `service` says at which tick its inputs take effect.
bool says_when(const std::string& service);

/// Fills seed, steps, end, expected and cycles of `plan`, whose topics are known. Inputs that are about
/// nothing (a sign of life) are fed in the order of the writers' clocks. The first of `seeds` counts after
/// which the recording has all setpoints that took effect. Throws std::runtime_error when there is none.
void plan_by_tick(const StoredRecording& recording, const std::string& service,
                  const std::vector<Seed>& seeds, VerifyPlan& plan);

}  // namespace trunnion::verification
