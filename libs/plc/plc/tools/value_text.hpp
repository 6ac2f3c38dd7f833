// SPDX-License-Identifier: Apache-2.0
// Values of variables as text and back.
#pragma once

#include <span>
#include <string>

#include "plc/semantics/type.hpp"

namespace trunnion::st {

/// As a literal of the language: TRUE, -5, 1.5, T#1s500ms, 'text', RED, [1, 2], (a := 1).
std::string value_text(const Type& type, std::span<const std::uint64_t> cells);

/// Writes an elementary value or a string: a number (also 16#FF), TRUE, FALSE, T#1s, an enumerated value,
/// 'text'. Throws std::runtime_error saying what is expected; nothing is written then.
void set_value(const Type& type, const std::string& text, std::span<std::uint64_t> cells);

}  // namespace trunnion::st
