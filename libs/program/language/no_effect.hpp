// SPDX-License-Identifier: Apache-2.0
// Codes that the table has so that programs with them run, and that change nothing on this control.
#pragma once

#include "language/codes.hpp"

namespace trunnion::language {

/// Why `code` has no effect, for the reader of a summary; null: it has one.
inline const char* no_effect_reason(const GCode& code) {
  static_cast<void>(code);
  return nullptr;
}

}  // namespace trunnion::language
