// SPDX-License-Identifier: Apache-2.0
// What a row of the words of other controls says to a person.
#pragma once

#include <fmt/core.h>

#include <string>

#include "language/foreign_words.hpp"

namespace trunnion::analysis {

/// "Siemens: tool tip control on. Here: G43.4 H_."
inline std::string foreign_text(const language::ForeignWord& word) {
  return fmt::format("{}: {}. Here: {}.", word.control, word.meaning, word.here);
}

}  // namespace trunnion::analysis
