// SPDX-License-Identifier: Apache-2.0
// Macro variables of a channel, read from the cluster that runs.
#pragma once

#include "commands.hpp"
#include "contracts/types.hpp"

namespace trunnion::cli {

/// The macro variables of `channel` of the cluster that runs. Throws std::runtime_error when they do not come
/// within 5 s.
idl::channel::Variables newest_variables(const Common& common, std::uint16_t channel);

}  // namespace trunnion::cli
