// SPDX-License-Identifier: Apache-2.0
// The rotary axes that a program names, of which a check without a machine knows nothing.
#pragma once

#include <cstdint>

#include "language/text_source.hpp"

namespace trunnion::analysis {

/// A, B and C (bit a for language::Axis a) that lines of the text have words of. Arguments of G65 and G66 are
/// none, nor what is in comments, printed, behind a comma or in names. Reads the whole text, but not what it
/// calls.
std::uint16_t rotary_words(language::TextSource& text);

}  // namespace trunnion::analysis
