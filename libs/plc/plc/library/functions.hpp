// SPDX-License-Identifier: Apache-2.0
// The names of the standard functions (IEC 61131-3:2013, 6.6.2.5).
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace trunnion::st {

enum class FunctionGroup {
  math,  ///< of REAL and LREAL
  absolute,
  arithmetic,  ///< operators as functions
  comparison,
  shift,
  selection,
  string,
  time,            ///< operators on times and dates as functions
  order_of_bytes,  ///< TO_BIG_ENDIAN ...
  validation,      ///< IS_VALID, IS_VALID_BCD
  move,
  ladder,  ///< of the manuals' ladder, with the target as an argument
  clock,   ///< PLC_TIME
  test,    ///< ASSERT_..., ADVANCE
};

struct FunctionRow {
  std::string_view name;
  FunctionGroup group;
  int least, most;              ///< arguments
  std::string_view parameters;  ///< their names, separated by blanks; IN1 .. when more are permitted
  std::string_view about;
};

std::span<const FunctionRow> standard_functions();
const FunctionRow* find_function(std::string_view upper);

enum class ConversionKind { plain, truncation, from_bcd, to_bcd };

/// The parts of the name of a conversion: INT_TO_REAL, TO_REAL, REAL_TRUNC_INT, TRUNC_INT, WORD_BCD_TO_UINT
/// ...
struct ConversionName {
  ConversionKind kind = ConversionKind::plain;
  std::string from, to;  ///< types, in capitals; `from` is empty when the name does not say it
};
/// Nothing when it is none. `is_type` says which types there are.
std::optional<ConversionName> conversion_name(const std::string& upper,
                                              const std::function<bool(const std::string&)>& is_type);
/// Also conversions.
bool is_standard_function(const std::string& upper);
/// Whether the second edition of the standard does not have it: older programs have one of their own, which
/// takes its place. Nothing in the library calls these.
bool is_replaceable_function(const std::string& upper);

extern const char* const standard_blocks_text;  ///< library/standard_blocks.st

}  // namespace trunnion::st
