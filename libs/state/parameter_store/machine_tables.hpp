// SPDX-License-Identifier: Apache-2.0
// Parameters, tools and work offsets of a machine as its folder gives them, without a cluster.
#pragma once

#include <string>

#include "contracts/types.hpp"
#include "machine/parameters.hpp"

namespace trunnion::tool_tables {

/// Files of a machine's folder beside its parameters; either may be missing.
inline constexpr const char* tools_file = "tools.yaml";
inline constexpr const char* offsets_file = "work_offsets.yaml";

/// The machine a program is interpreted for.
struct MachineTables {
  machine::Parameters parameters;
  idl::parameters::ToolTable tools;
  idl::parameters::WorkOffsets offsets;
  std::uint16_t channel = 0;
};

/// Of the machine in `directory` (one with machine.yaml). Throws std::runtime_error with file:line:column.
MachineTables load_machine_tables(const std::string& directory, std::uint16_t channel = 0);

}  // namespace trunnion::tool_tables
