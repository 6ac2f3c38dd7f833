// SPDX-License-Identifier: Apache-2.0
// What the axes of one channel did in a motion: of a cluster's drives, or of a recording.
#pragma once

#include <string>

#include "servo_analysis/channel_motion.hpp"
#include "servo_session.hpp"

namespace trunnion::cli {

using servo_analysis::ChannelMotion;

/// Runs `program` and samples the axes `sampled` (letters) every `decimation` periods of the speed loop while
/// the channel moves; the other axes rest where they are. When this computer loses samples, the program runs
/// again, at last with a quarter of the rate: the interval of the result says which.
ChannelMotion run_sampled(ServoSession& session, const std::string& program, const std::string& sampled,
                          std::uint16_t decimation);

/// From the path (commanded, in machine coordinates, without compensation) and the feedback of a recording,
/// one sample for each cycle that has both. `parameters`: those of the recording. Throws std::runtime_error.
ChannelMotion motion_of_recording(const std::string& file, std::uint16_t channel,
                                  machine::Parameters& parameters);

}  // namespace trunnion::cli
