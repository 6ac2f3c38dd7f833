// SPDX-License-Identifier: Apache-2.0
// A program text interpreted without a machine: its first error, and the path of the tool tip.
#pragma once

#include <functional>
#include <string>

#include "bus/json.hpp"
#include "channel_setup/channel_setup.hpp"
#include "language/text_source.hpp"
#include "program_execution/move_guard.hpp"

namespace trunnion::gateway {

/// Points of the path in an answer.
inline constexpr std::size_t most_path_points = 20000;

/// The answer ProgramCheck of openapi.json. `machine` is configured and finds the subprograms. From its
/// reference position as program_execution::ProgramReader reads; block skip is off. `guard` may be null. When
/// `stop` is true the answer is not complete.
bus::Json check_program(language::TextSource& text, channel_setup::ChannelSetup& machine,
                        program_execution::MoveGuard* guard, const std::function<bool()>& stop);

}  // namespace trunnion::gateway
