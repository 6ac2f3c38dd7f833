// SPDX-License-Identifier: Apache-2.0
// Whether another process may take the place of the drive. Of axes it knows the positions; spindles it begins
// with at rest, at angles that nobody knows.
#pragma once

#include <string>
#include <string_view>

#include "contracts/types.hpp"

namespace trunnion::stream {

/// What ChannelState::detail begins with while a channel is at rest with a tap in its hole.
inline constexpr std::string_view tap_in_hole_detail = "a tap is in its hole: ";
/// The detail of such a channel, else an empty text.
std::string tap_in_hole(const idl::channel::ChannelState& state);

/// The first spindle that turns, follows another one or has the angles of a path, and what to do; empty when
/// there is none. Spindles are named by their numbers from 1.
std::string spindle_at_work(const idl::stream::Feedback& newest);

}  // namespace trunnion::stream
