// SPDX-License-Identifier: Apache-2.0
// Words of other controls that this one does not have, or has with another meaning: what an alarm says of
// them.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "language/alarms.hpp"

namespace trunnion::language {

/// A row of foreign_words.yaml. In patterns A..Z are letters in either case, # a whole number, ? a digit, @ a
/// letter, a blank any blanks, and ^ comes before a word that begins a block.
struct ForeignWord {
  std::string_view word;  ///< pattern
  std::string_view
      with;  ///< pattern of a word that the block must have, too; behind a - one it must not have
  const char* control;
  const char* meaning;  ///< of the word there
  const char* shown;    ///< the control and what to write here, the end of an alarm's text
  const char* here;     ///< what to write here, in a sentence
};

extern const std::span<const ForeignWord> foreign_words;

/// The row of the word on which `fault` was found in `line`; `at` becomes the byte where it begins. Null, and
/// `at` as it was, when the table does not have it. Looks at every row: for lines that have failed.
const ForeignWord* find_foreign_word(const Fault& fault, std::string_view line, std::uint16_t& at);

/// The row of M`number`; null when the table does not have it.
const ForeignWord* foreign_m(std::uint32_t number);

}  // namespace trunnion::language
