// SPDX-License-Identifier: Apache-2.0
// The names of the standard functions (IEC 61131-3:2013, 6.6.2.5).
#pragma once

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
  time,  ///< operators on times and dates as functions
  move,
  clock,  ///< PLC_TIME
  test,   ///< ASSERT_..., ADVANCE
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
/// Also conversions like DINT_TO_INT.
bool is_standard_function(const std::string& upper);

extern const char* const standard_blocks_text;  ///< library/standard_blocks.st

}  // namespace trunnion::st
