// SPDX-License-Identifier: Apache-2.0
// The PLC programs of the machine, from their files into the core; the file of the rounds.
#pragma once

#include <string>
#include <vector>

#include "plc_core.hpp"
#include "programs.hpp"

namespace trunnion::plc {

using st::read_sources;

/// translate() of the directory, loaded into the core. Returns warnings.
std::vector<std::string> load_programs(const std::string& directory, PlcCore& core, bool simulated = true);

/// The file in the state directory by which the running PLC passes its rounds to a standby comparison.
inline constexpr const char* rounds_file = "/plc.rounds";

}  // namespace trunnion::plc
