// SPDX-License-Identifier: Apache-2.0
// The M functions that the logic of a machine carries out (parameters m_functions of a channel).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace trunnion::language {

/// Codes in groups: a block may hold one code of each. M0, M1, M2, M30, M98 and M99 belong to the control and
/// are in no list.
class MFunctions {
 public:
  static constexpr std::size_t codes = 10000;  ///< M0 to M9999

  /// `3 4 5 19; 7 8 9; 70-79`: groups divided by semicolons, codes by blanks. Throws std::runtime_error that
  /// names the number when it is no M code, belongs to the control, or is there twice.
  void add(std::string_view text);

  bool has(std::uint16_t code) const { return group_[code] != 0; }
  /// Both are in one group; two codes that are in none are not.
  bool same_group(std::uint16_t a, std::uint16_t b) const { return has(a) && group_[a] == group_[b]; }

 private:
  std::uint16_t groups_ = 0;
  std::array<std::uint16_t, codes> group_{};  // from 1; 0: the logic does not know the code
};

}  // namespace trunnion::language
