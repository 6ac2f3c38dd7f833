// SPDX-License-Identifier: Apache-2.0
// Which program a name, a call or the head of a text means.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace trunnion::machine {

/// O9990, %9990 and 9990 are one program. The NUM dialect has an index behind the number: %9990.9 is another.
struct ProgramNumber {
  std::uint32_t number = 0;
  std::uint8_t index = 0;  ///< 0 = none
  bool operator==(const ProgramNumber&) const = default;
};

/// Of a stored program or of a call: O9990, O9990.9, both with or without an extension; up to nine digits. A
/// point and one digit are an index and no extension. Nothing when the name is no number.
std::optional<ProgramNumber> number_in_name(std::string_view name);

/// A command of `trunnion` or a service has stored the program for itself: its name ends with .tmp.nc.
bool is_temporary(std::string_view name);

/// At the beginning of a text, behind O, o or %; what follows may be anything.
std::optional<ProgramNumber> number_in_head(std::string_view text);

}  // namespace trunnion::machine
