// SPDX-License-Identifier: Apache-2.0
// The motion of a program without a machine: its time, line by line, and the path of the tool tip.
#pragma once

#include <functional>

#include "bus/json.hpp"
#include "channel_setup/channel_setup.hpp"
#include "language/text_source.hpp"

namespace trunnion::gateway {

/// Stretches of lines in an answer; of a longer program the shortest are left out.
inline constexpr std::size_t most_stretches = 20000;

/// The fields complete, seconds, moves, alarm, lines and path of ProgramPlan in openapi.json. `machine` is
/// configured and finds the subprograms. From its reference position to the end of the program at feed
/// override 1. `stop` is asked every few hundred cycles; when it is true the answer is not complete.
bus::Json plan_document(language::TextSource& text, channel_setup::ChannelSetup& machine,
                        const std::function<bool()>& stop);

}  // namespace trunnion::gateway
