// SPDX-License-Identifier: Apache-2.0
// What an alarm says of a word whose number is computed.
#pragma once

#include <array>
#include <string_view>

#include "language/alarms.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

using WordDetail = std::array<char, 49>;

/// "#4120 is 0", or "the value is -1.5" of an expression, where the value of a word is at fault; "needs P:
/// #101 is vacant" where a word is missing whose variable is; empty where there is nothing to say. Computes
/// the word again, and is for lines that have failed.
std::string_view computed_word(const Fault& fault, std::string_view line, const Variables& variables,
                               WordDetail& detail);

}  // namespace trunnion::language
