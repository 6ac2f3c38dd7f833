// SPDX-License-Identifier: Apache-2.0
// The languages in which programs are written, and their names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trunnion::canonical {

/// As parameter 04c959 counts them.
enum class ProgramDialect : std::uint8_t { iso, num, linuxcnc, haas };

/// In the order of the enumerators: what machine.yaml, heads of programs and `trunnion check` write.
inline constexpr std::array<std::string_view, 4> dialect_names = {"iso", "num", "linuxcnc", "haas"};

/// Before a line of manual data input that the control writes itself: such lines are ISO whatever the channel
/// reads.
inline constexpr std::string_view iso_head = "(DIALECT: ISO) ";

constexpr std::string_view dialect_name(ProgramDialect dialect) {
  return dialect_names[static_cast<std::size_t>(dialect)];
}

/// The dialect of this name, in letters of either case; nothing when there is none.
constexpr std::optional<ProgramDialect> dialect_named(std::string_view name) {
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  for (std::size_t i = 0; i < dialect_names.size(); ++i) {
    bool same = name.size() == dialect_names[i].size();
    for (std::size_t k = 0; same && k < name.size(); ++k) same = small(name[k]) == dialect_names[i][k];
    if (same) return static_cast<ProgramDialect>(i);
  }
  return std::nullopt;
}

}  // namespace trunnion::canonical
