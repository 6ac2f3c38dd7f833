// SPDX-License-Identifier: Apache-2.0
// channel status: position, mode, program, feed, tool and alarms of a channel, and the spindles of the
// machine.
#pragma once

#include "commands.hpp"

namespace trunnion::cli {

/// Prints it once; with `watch` until it is interrupted: at a terminal in place, otherwise as one line of
/// JSON for each change, at most 10 a second. Throws std::runtime_error when the channel publishes nothing.
int show_channel_status(const Common& common, std::uint16_t channel, bool watch);

}  // namespace trunnion::cli
