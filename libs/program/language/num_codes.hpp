// SPDX-License-Identifier: Apache-2.0
// The G functions of the NUM dialect, and what they are here.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::language {

/// What the reader makes of a function.
enum class NumUse : std::uint8_t {
  code,       ///< the code `code` of g_codes
  dwell,      ///< the same, whose time is F
  tap,        ///< the same, with its lead in K, and perhaps with EK, EH and ER
  removal,    ///< G39+: G84.9, with M3 or M4 in place of the hand of the thread, and M2
  call,       ///< G77 H: a program
  jump,       ///< G79 N
  wait_mark,  ///< G78: alarm 1152
  thread,     ///< G38: the code `code`, with its lead in K
  resumed,    ///< G38+: the same, J and EC behind it
  one_pass,   ///< G33: the same, only in its block, and perhaps with EC and EX or EZ
  home,       ///< G159: the code `code`, letters of axes behind it need no number
};

struct NumCode {
  std::uint16_t number;
  bool plus;  ///< with + behind the number
  NumUse use;
  std::uint16_t code;   ///< of the uses that have one
  std::uint16_t modal;  ///< #4001 .., which has the active code of its group; 0 when it has none
  const char* meaning;  ///< at most 48 characters
};

inline constexpr std::array num_codes = {
    NumCode{0, false, NumUse::code, 0, 4001, "rapid traverse"},
    NumCode{1, false, NumUse::code, 1, 4001, "straight line at feed"},
    NumCode{2, false, NumUse::code, 2, 4001, "circle clockwise, radius R"},
    NumCode{3, false, NumUse::code, 3, 4001, "circle counter-clockwise, radius R"},
    NumCode{4, false, NumUse::dwell, 4, 0, "dwell of F seconds"},
    NumCode{9, false, NumUse::code, 9, 0, "exact stop at the end of this block"},
    NumCode{17, false, NumUse::code, 17, 4002, "plane XY"},
    NumCode{18, false, NumUse::code, 18, 4002, "plane ZX"},
    NumCode{19, false, NumUse::code, 19, 4002, "plane YZ"},
    NumCode{33, false, NumUse::one_pass, 33, 0, "thread cutting cycle, one pass; K lead"},
    NumCode{38, false, NumUse::thread, 33, 4001, "thread cutting; K lead"},
    NumCode{38, true, NumUse::resumed, 33, 4001, "resumed thread cutting; J, EC, K lead"},
    NumCode{39, true, NumUse::removal, 0, 0, "rigid tap removal"},
    NumCode{40, false, NumUse::code, 40, 4007, "tool radius compensation off"},
    NumCode{70, false, NumUse::code, 20, 4006, "inch"},
    NumCode{71, false, NumUse::code, 21, 4006, "millimetre"},
    NumCode{77, false, NumUse::call, 0, 0, "call of program H"},
    NumCode{78, false, NumUse::wait_mark, 0, 0, "wait mark between channels"},
    NumCode{79, false, NumUse::jump, 0, 0, "jump to block N, if a condition before N holds"},
    NumCode{80, false, NumUse::code, 80, 4009, "cycle off"},
    NumCode{84, false, NumUse::tap, 84, 4009, "rigid tapping"},
    NumCode{90, false, NumUse::code, 90, 4003, "absolute words"},
    NumCode{91, false, NumUse::code, 91, 4003, "incremental words"},
    NumCode{94, false, NumUse::code, 94, 4005, "feed per minute"},
    NumCode{95, false, NumUse::code, 95, 4005, "feed per spindle revolution"},
    NumCode{97, false, NumUse::code, 97, 4013, "constant spindle speed: S in 1/min"},
    NumCode{159, false, NumUse::home, 159, 4009, "homing of the axes named"},
};

/// The function with this number, or nullptr.
constexpr const NumCode* num_code(double number, bool plus) {
  for (const NumCode& row : num_codes) {
    if (row.number == number && row.plus == plus) return &row;
  }
  return nullptr;
}

/// The number that NUM gives to the code `code` of g_codes.
constexpr double num_number(double code) {
  return code == 20 ? 70 : code == 21 ? 71 : code == 33 ? 38 : code;
}

}  // namespace trunnion::language
