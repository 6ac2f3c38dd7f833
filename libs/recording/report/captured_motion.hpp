// SPDX-License-Identifier: Apache-2.0
// The motion of a channel's axes in a recording, as a sampled test has it.
#pragma once

#include <cstdint>
#include <string>

#include "machine/parameters.hpp"
#include "report/capture.hpp"
#include "servo_analysis/channel_motion.hpp"

namespace trunnion::report {

/// From path (commanded, in machine coordinates, without compensation) and feedback of a capture of
/// `channel`, one sample for each cycle that has both.
servo_analysis::ChannelMotion motion_of(const Capture& capture, std::uint16_t channel);

/// That of the recording `file`, with `parameters` those of the recording. Throws std::runtime_error when it
/// has no motion of `channel`.
servo_analysis::ChannelMotion motion_of_recording(const std::string& file, std::uint16_t channel,
                                                  machine::Parameters& parameters);

}  // namespace trunnion::report
