// SPDX-License-Identifier: Apache-2.0
// Runs a compiled instruction list once.
#pragma once

#include <optional>

#include "address.hpp"
#include "plc/instruction_list/program.hpp"

namespace trunnion::plc {

/// One pass. `now` is PLC time in ms; timers and edges remember in `blocks`. Allocates nothing and always
/// ends. Returns how many instructions it has executed.
std::uint64_t execute(const il::Program& program, Registers& registers, Blocks& blocks, std::uint64_t now);

/// PLC time in ms at which the next running timer after `now` runs out.
std::optional<std::uint64_t> next_timer_end(const Blocks& blocks, std::uint64_t now);
/// True when a timer has run out since the program last read it.
bool timer_due(const Blocks& blocks, std::uint64_t now);

}  // namespace trunnion::plc
