// SPDX-License-Identifier: Apache-2.0
// The G and M functions of Haas mills, and what they are here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace trunnion::language {

/// What the reader makes of a function.
enum class HaasUse : std::uint8_t {
  code,         ///< the code `code` of g_codes and of the calls
  offset,       ///< G110 .. G129: G54.1 P1 .. P20
  numbered,     ///< G154 P: G54.1 P
  pattern,      ///< G70 G71 G72: the code `code`, whose holes are counted by L
  mirror,       ///< G101: the code `code`, about zero
  machine,      ///< G53: the code `code`; without an axis nothing
  reference,    ///< G28: the code `code`; without an axis that of all
  no_effect,    ///< accepted with its P, and nothing to do
  not_here,     ///< alarm 1532
  local_call,   ///< M97 P: M98 of the program that begins at N
  tool_change,  ///< M16: M6
};

/// Of the numbers `first` to `last`.
struct HaasCode {
  std::uint16_t first;
  std::uint16_t last;
  HaasUse use;
  double code;          ///< of the uses that have one
  const char* meaning;  ///< of what is not here: what to do, at most 48 characters
};

inline constexpr std::array haas_g_codes = {
    HaasCode{0, 0, HaasUse::code, 0, "rapid traverse"},
    HaasCode{1, 1, HaasUse::code, 1, "straight line at feed"},
    HaasCode{2, 2, HaasUse::code, 2, "circle or helix clockwise"},
    HaasCode{3, 3, HaasUse::code, 3, "circle or helix counter-clockwise"},
    HaasCode{4, 4, HaasUse::code, 4, "dwell: P with a point seconds, without milliseconds"},
    HaasCode{9, 9, HaasUse::code, 9, "exact stop at the end of this block"},
    HaasCode{10, 10, HaasUse::code, 10, "offsets: L2 L20 work, L10 length, L12 diameter, wear"},
    HaasCode{12, 12, HaasUse::code, 12, "circular pocket clockwise"},
    HaasCode{13, 13, HaasUse::code, 13, "circular pocket counter-clockwise"},
    HaasCode{17, 17, HaasUse::code, 17, "plane XY"},
    HaasCode{18, 18, HaasUse::code, 18, "plane ZX"},
    HaasCode{19, 19, HaasUse::code, 19, "plane YZ"},
    HaasCode{20, 20, HaasUse::code, 20, "inch"},
    HaasCode{21, 21, HaasUse::code, 21, "millimetre"},
    HaasCode{28, 28, HaasUse::reference, 28, "to the reference position, without axis words all axes"},
    HaasCode{29, 29, HaasUse::code, 29, "from the reference position"},
    HaasCode{31, 31, HaasUse::code, 31, "line until the skip input comes"},
    HaasCode{35, 35, HaasUse::not_here, 0, "automatic tool diameter: measure with a macro"},
    HaasCode{36, 36, HaasUse::not_here, 0, "automatic work offset: measure with a macro"},
    HaasCode{37, 37, HaasUse::not_here, 0, "automatic tool length: measure with a macro"},
    HaasCode{40, 40, HaasUse::code, 40, "cutter radius compensation off"},
    HaasCode{41, 41, HaasUse::code, 41, "cutter radius compensation left"},
    HaasCode{42, 42, HaasUse::code, 42, "cutter radius compensation right"},
    HaasCode{43, 43, HaasUse::code, 43, "tool length H added"},
    HaasCode{44, 44, HaasUse::code, 44, "tool length H subtracted"},
    HaasCode{47, 47, HaasUse::not_here, 0, "engraving: post the text as moves"},
    HaasCode{49, 49, HaasUse::code, 49, "tool length and tool tip control off"},
    HaasCode{50, 50, HaasUse::code, 50, "scaling off"},
    HaasCode{51, 51, HaasUse::code, 51, "scaling about X Y Z by P"},
    HaasCode{52, 52, HaasUse::code, 52, "local offset"},
    HaasCode{53, 53, HaasUse::machine, 53, "machine coordinates"},
    HaasCode{54, 54, HaasUse::code, 54, "work offset 1"},
    HaasCode{55, 55, HaasUse::code, 55, "work offset 2"},
    HaasCode{56, 56, HaasUse::code, 56, "work offset 3"},
    HaasCode{57, 57, HaasUse::code, 57, "work offset 4"},
    HaasCode{58, 58, HaasUse::code, 58, "work offset 5"},
    HaasCode{59, 59, HaasUse::code, 59, "work offset 6"},
    HaasCode{60, 60, HaasUse::code, 60, "positioning from one side"},
    HaasCode{61, 61, HaasUse::code, 61, "exact stop"},
    HaasCode{64, 64, HaasUse::code, 64, "continuous path"},
    HaasCode{65, 65, HaasUse::code, 65, "macro call"},
    HaasCode{68, 68, HaasUse::code, 68, "rotation about X Y by R"},
    HaasCode{69, 69, HaasUse::code, 69, "rotation off"},
    HaasCode{70, 70, HaasUse::pattern, 70, "holes on a circle: I radius, J first angle, L holes"},
    HaasCode{71, 71, HaasUse::pattern, 71, "holes on an arc: as G70, K angle between them"},
    HaasCode{72, 72, HaasUse::pattern, 78, "holes on a line: I spacing, J angle, L holes"},
    HaasCode{73, 73, HaasUse::code, 73, "chip-breaking drilling: Q, or I J K; Q K: out to R"},
    HaasCode{74, 74, HaasUse::code, 74, "rigid tapping, left-hand; J multiple of S on the way out"},
    HaasCode{76, 76, HaasUse::code, 76, "fine boring"},
    HaasCode{77, 77, HaasUse::code, 87, "back boring: R the bottom, Z the end; needs G98"},
    HaasCode{80, 80, HaasUse::code, 80, "cycle off"},
    HaasCode{81, 81, HaasUse::code, 81, "drilling"},
    HaasCode{82, 82, HaasUse::code, 82, "drilling with dwell"},
    HaasCode{83, 83, HaasUse::code, 83, "deep drilling: Q, or I J K"},
    HaasCode{84, 84, HaasUse::code, 84, "rigid tapping, right-hand; words as G74"},
    HaasCode{85, 85, HaasUse::code, 85, "boring, out at feed"},
    HaasCode{86, 86, HaasUse::code, 86, "boring, spindle stops, rapid out"},
    HaasCode{87, 87, HaasUse::code, 88, "boring, spindle stops, program stop, rapid out"},
    HaasCode{88, 88, HaasUse::code, 88, "boring, dwell, spindle stops, program stop, rapid out"},
    HaasCode{89, 89, HaasUse::code, 89, "boring, dwell, out at feed"},
    HaasCode{90, 90, HaasUse::code, 90, "absolute words"},
    HaasCode{91, 91, HaasUse::code, 91, "incremental words"},
    HaasCode{92, 92, HaasUse::code, 92, "shift of all work offsets"},
    HaasCode{93, 93, HaasUse::code, 93, "inverse time"},
    HaasCode{94, 94, HaasUse::code, 94, "feed per minute"},
    HaasCode{95, 95, HaasUse::code, 95, "feed per spindle revolution"},
    HaasCode{98, 98, HaasUse::code, 98, "cycles end at the initial level"},
    HaasCode{99, 99, HaasUse::code, 99, "cycles end at R"},
    HaasCode{100, 100, HaasUse::code, 50.1, "mirror off, of the axes named or of all"},
    HaasCode{101, 101, HaasUse::mirror, 51.1, "mirror on about zero, of the axes named"},
    HaasCode{103, 103, HaasUse::no_effect, 0, "limit of the blocks that are read ahead"},
    HaasCode{107, 107, HaasUse::not_here, 0, "cylindrical mapping: post the path with A"},
    HaasCode{110, 111, HaasUse::offset, 0, "work offsets 7 and 8, G154 P1 and P2"},
    HaasCode{112, 112, HaasUse::not_here, 0, "on a mill write G154 P3; polar is not here"},
    HaasCode{113, 113, HaasUse::not_here, 0, "on a mill write G154 P4; polar is not here"},
    HaasCode{114, 129, HaasUse::offset, 0, "work offsets 11 to 26, G154 P5 to P20"},
    HaasCode{136, 136, HaasUse::not_here, 0, "automatic centre of a work offset: use a macro"},
    HaasCode{141, 141, HaasUse::not_here, 0, "compensation in space: post the tool's centre"},
    HaasCode{143, 143, HaasUse::not_here, 0, "length of another tool: post it, or write G234 H"},
    HaasCode{150, 150, HaasUse::code, 150, "pocket milling"},
    HaasCode{153, 153, HaasUse::not_here, 0, "five-axis drilling: post the moves"},
    HaasCode{154, 154, HaasUse::numbered, 54.1, "additional work offset P"},
    HaasCode{155, 155, HaasUse::not_here, 0, "five-axis tapping: write G174 or G184"},
    HaasCode{161, 169, HaasUse::not_here, 0, "five-axis cycle: post the moves"},
    HaasCode{174, 174, HaasUse::code, 174, "rigid tapping to X Y Z and back, left-hand"},
    HaasCode{184, 184, HaasUse::code, 184, "rigid tapping to X Y Z and back, right-hand"},
    HaasCode{187, 187, HaasUse::code, 187, "accuracy: P finish, E mm"},
    HaasCode{234, 234, HaasUse::code, 43.4, "tool tip control with tool length H"},
    HaasCode{253, 253, HaasUse::not_here, 0, "tilted plane: G68.2 in a program of dialect iso"},
    HaasCode{254, 254, HaasUse::not_here, 0, "dynamic work offset: post with G234 H"},
    HaasCode{255, 255, HaasUse::no_effect, 0, "dynamic work offset off: it is never on"},
    HaasCode{266, 266, HaasUse::not_here, 0, "rapid of visible axes: write G0"},
    HaasCode{268, 269, HaasUse::not_here, 0, "tilted plane: G68.2 in a program of dialect iso"},
};

/// M functions that are other ones here; all others are those of every dialect.
inline constexpr std::array haas_m_codes = {
    HaasCode{16, 16, HaasUse::tool_change, 6, "tool change, as M6"},
    HaasCode{46, 46, HaasUse::not_here, 0, "jump if a pallet is loaded: use IF and GOTO"},
    HaasCode{95, 95, HaasUse::not_here, 0, "sleep: start the program when it is due"},
    HaasCode{96, 96, HaasUse::not_here, 0, "jump without an input: use IF and GOTO"},
    HaasCode{97, 97, HaasUse::local_call, 98, "local subprogram: P its first N, L repetitions"},
    HaasCode{109, 109, HaasUse::not_here, 0, "question to the operator: use #3006"},
};

/// The function with this number, or nullptr.
template <std::size_t size>
constexpr const HaasCode* haas_code(const std::array<HaasCode, size>& codes, double number) {
  for (const HaasCode& row : codes) {
    if (number < row.first || number > row.last) continue;
    return number == static_cast<double>(static_cast<std::uint32_t>(number)) ? &row : nullptr;
  }
  return nullptr;
}

}  // namespace trunnion::language
