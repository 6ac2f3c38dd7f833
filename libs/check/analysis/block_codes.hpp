// SPDX-License-Identifier: Apache-2.0
// The G codes of a block that was read, by their group, and what is modal behind them.
#pragma once

#include <cmath>
#include <cstdint>

#include "language/block_watch.hpp"
#include "language/codes.hpp"
#include "language/linuxcnc_codes.hpp"

namespace trunnion::analysis {

/// Ten times the number with which its dialect writes a code.
inline std::uint16_t tenths_of(const language::GCode& code) {
  const bool own = code.tenths >= language::own_code;
  return own ? static_cast<std::uint16_t>(code.tenths - language::own_code) : code.tenths;
}

inline bool is_linuxcnc(const language::Block& block) { return block.table == language::CodeTable::linuxcnc; }

struct FoundCode {
  const language::GCode* code = nullptr;  ///< null: the block has none
  std::uint16_t offset = 0;               ///< byte of its line, from 0
  explicit operator bool() const { return code != nullptr; }
  bool is(std::uint16_t tenths) const { return code != nullptr && tenths_of(*code) == tenths; }
};

/// The row of the block's table for a word; null for codes that are not in it, such as calls.
inline const language::GCode* g_code_of(const language::Block& block, const language::CodeWord& word) {
  const double tenths = std::round(word.value * 10);
  if (!(tenths >= 0 && tenths < 20000)) return nullptr;
  const auto number = static_cast<std::uint32_t>(tenths);
  return is_linuxcnc(block) ? language::linuxcnc_g_code(number) : language::g_code(number);
}

inline FoundCode code_of(const language::Block& block, language::Group group) {
  for (std::size_t i = 0; i < block.g_count; ++i) {
    const language::GCode* const code = g_code_of(block, block.g[i]);
    if (code != nullptr && code->group == group) return {code, block.g[i].offset};
  }
  return {};
}

inline bool has_m(const language::Block& block, double number) {
  for (std::size_t i = 0; i < block.m_count; ++i)
    if (block.m[i].value == number) return true;
  return false;
}

/// G90 is active in the block.
inline bool absolute_in(const language::SeenBlock& seen) {
  const FoundCode code = code_of(seen.block, language::Group::distance);
  return code ? code.is(900) : seen.modal.absolute;
}

/// mm of a length word of the block.
inline double length_scale_in(const language::SeenBlock& seen) {
  const FoundCode code = code_of(seen.block, language::Group::units);
  return (code ? code.is(210) : seen.modal.metric) ? 1.0 : 25.4;
}

}  // namespace trunnion::analysis
