// SPDX-License-Identifier: Apache-2.0
// A line of manual data input, carried out to its end.
#pragma once

#include <cstdint>
#include <string>

#include "cluster/client.hpp"

namespace trunnion::cli {

/// Changes the mode, carries the line out and gives the state in which the axes have settled. Throws
/// std::runtime_error with the alarm of the channel on the way, or when it does not finish within `timeout`
/// seconds.
idl::channel::ChannelState run_line(cluster::Client& client, std::uint16_t channel, const std::string& text,
                                    double timeout);

}  // namespace trunnion::cli
