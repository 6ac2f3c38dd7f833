// SPDX-License-Identifier: Apache-2.0
// Cycles that a line of the ISO dialect calls by name.
#pragma once

#include <string_view>

#include "language/block.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

/// Reads CYCLE1234(1, "text", , 4) at `scanner`, which is at Block::at of `line`, to the end of the line:
/// arguments by their place, a skipped one is vacant.
Fault read_cycle(Scanner& scanner, std::string_view line, const Variables& variables, Block& block);

}  // namespace trunnion::language
