// SPDX-License-Identifier: Apache-2.0
// channel couple and channel uncouple: a spindle follows another one, or no longer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands.hpp"

namespace trunnion::cli {

/// Carries the lines of a program out as manual data input, so what refuses them there refuses them here, and
/// waits until the drive says that it is so. Prints what the slave does then. Throws std::runtime_error.
int couple_spindles(const Common& common, const std::string& word, const std::vector<std::string>& arguments,
                    std::uint16_t channel, bool take_over);

}  // namespace trunnion::cli
