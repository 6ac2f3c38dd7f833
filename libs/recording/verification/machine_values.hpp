// SPDX-License-Identifier: Apache-2.0
// The parameters of a machine's directory against those of a recording.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "machine/parameters.hpp"
#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// The newest set of the recording against `delivered`: how many parameters differ, and the first with both
/// values. Empty when none does, or when the recording has no set.
std::string parameters_apart(const StoredRecording& recording,
                             const std::map<std::uint32_t, machine::ParameterValue>& delivered);

/// Every set of the recording gets the values of `delivered`. Its revision stays: batches name it.
void use_parameters(StoredRecording& recording,
                    const std::map<std::uint32_t, machine::ParameterValue>& delivered);

}  // namespace trunnion::verification
