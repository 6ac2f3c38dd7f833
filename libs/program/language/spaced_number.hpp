// SPDX-License-Identifier: Apache-2.0
// Numbers with blanks between sign, digits and point, which Fanuc and RS274/NGC read as if they were not
// there.
#pragma once

#include "language/decimal.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

/// Takes `- 1 . 5`: an optional sign, at most one group of digits before the point and one behind it, of 64
/// digits together. Takes nothing where there is no such number; Decimal::end means nothing.
Decimal read_spaced_number(Scanner& scanner);

}  // namespace trunnion::language
