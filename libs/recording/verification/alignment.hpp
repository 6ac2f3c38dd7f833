// SPDX-License-Identifier: Apache-2.0
// One run of a program out of a recording, counted from its start: so that two runs in one life of a machine
// compare.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "verification/stored_recording.hpp"

namespace trunnion::verification {

/// Handles of the topics that are of a run: the stream, and the M, S and T functions.
const std::set<std::string>& aligned_topics();

/// The messages of `run` (from 1: the programs that were started with the channel idle) of `channel` up to
/// the next start of a motion behind its end. Cycles count from its first setpoint, functions from its first;
/// parameter and program revisions, which differ without a difference of the run, are 0. Throws
/// std::runtime_error with one line when the recording has no such run.
std::vector<StoredMessage> aligned(const StoredRecording& recording, std::uint16_t channel, unsigned run);

}  // namespace trunnion::verification
