// SPDX-License-Identifier: Apache-2.0
// Circular tests with the axes of a cluster: `trunnion measure circle`.
#pragma once

#include "commands.hpp"

namespace trunnion::cli {

/// `circle` of `measure`.
void add_circle_command(CLI::App& measure, Common& common);

}  // namespace trunnion::cli
