// SPDX-License-Identifier: Apache-2.0
// Tests that turn a rotary axis about a ball: `trunnion measure k-test` and `r-test`.
#pragma once

#include "commands.hpp"

namespace trunnion::cli {

/// `k-test` and `r-test` of `measure`.
void add_ball_commands(CLI::App& measure, Common& common);

}  // namespace trunnion::cli
