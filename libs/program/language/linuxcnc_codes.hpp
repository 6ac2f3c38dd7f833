// SPDX-License-Identifier: Apache-2.0
// The G and M codes of the LinuxCNC dialect.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "language/codes.hpp"

namespace trunnion::language {

/// A code that means what one of g_codes means.
struct LinuxcncSharedCode {
  std::uint16_t tenths;
  std::uint16_t code;  ///< of g_codes
  const char* meaning;
  const char* example;  ///< a program that shows the code, without its end
};
inline constexpr std::array linuxcnc_shared_codes = {
    LinuxcncSharedCode{0, 0, "rapid traverse", "G0 X1"},
    LinuxcncSharedCode{10, 10, "straight line at feed", "G1 X1 F100"},
    LinuxcncSharedCode{20, 20, "circle or helix clockwise; centre I J K, or R; P turns", "G2 X2 I1 F100"},
    LinuxcncSharedCode{30, 30, "circle or helix counter-clockwise; words as G2", "G3 X2 I1 F100"},
    LinuxcncSharedCode{170, 170, "plane XY", "G17"},
    LinuxcncSharedCode{180, 180, "plane ZX", "G18"},
    LinuxcncSharedCode{190, 190, "plane YZ", "G19"},
    LinuxcncSharedCode{200, 200, "inch; F of the same block is in the units before it", "G20"},
    LinuxcncSharedCode{210, 210, "millimetre; F of the same block is in the units before it", "G21"},
    LinuxcncSharedCode{282, 282, "search of the references of the axes named: not in LinuxCNC", "G28.2 X0"},
    LinuxcncSharedCode{400, 400, "cutter radius compensation off", "G40"},
    LinuxcncSharedCode{490, 490, "tool length off", "G49"},
    LinuxcncSharedCode{
        500, 500, "scaling off, which there is none of: not in LinuxCNC, written by posts for Mach3", "G50"},
    LinuxcncSharedCode{610, 610, "exact path: here an exact stop at the end of every block", "G61"},
    LinuxcncSharedCode{611, 610, "exact stop", "G61.1"},
    LinuxcncSharedCode{640, 640, "continuous path; P off the corners at most, Q off collinear points",
                       "G64 P0.01"},
    LinuxcncSharedCode{730, 730, "chip-breaking drilling: Q per peck, D back", "G73 Z-4 R1 Q2 F100"},
    LinuxcncSharedCode{740, 740, "tapping, left-hand thread, with M4; here rigid: lead F / S",
                       "S100 M4\nG74 Z-4 R1 F100"},
    LinuxcncSharedCode{800, 800, "cycle and motion code off", "G80"},
    LinuxcncSharedCode{810, 810, "drilling", "G81 Z-4 R1 F100"},
    LinuxcncSharedCode{820, 820, "drilling with dwell P", "G82 Z-4 R1 P0.1 F100"},
    LinuxcncSharedCode{830, 830, "deep drilling: Q per peck, out to R, D above the last depth",
                       "G83 Z-4 R1 Q2 F100"},
    LinuxcncSharedCode{840, 840, "tapping, right-hand thread, with M3; words as G74",
                       "S100 M3\nG84 Z-4 R1 F100"},
    LinuxcncSharedCode{850, 850, "boring, out at feed", "G85 Z-4 R1 F100"},
    LinuxcncSharedCode{860, 860, "boring with dwell P, spindle stops, rapid out",
                       "S100 M3\nG86 Z-4 R1 P0.1 F100"},
    LinuxcncSharedCode{890, 890, "boring with dwell P, out at feed", "G89 Z-4 R1 P0.1 F100"},
    LinuxcncSharedCode{900, 900, "absolute words", "G90"},
    LinuxcncSharedCode{901, 901, "I J K of circles are coordinates: both of the plane",
                       "G90.1 G2 X2 I1 J0 F100"},
    LinuxcncSharedCode{910, 910, "incremental words", "G91"},
    LinuxcncSharedCode{911, 911, "I J K of circles count from the start", "G91.1 G2 X2 I1 F100"},
    LinuxcncSharedCode{930, 930, "inverse time: F in 1/min", "G93"},
    LinuxcncSharedCode{940, 940, "feed per minute", "G94"},
    LinuxcncSharedCode{950, 950, "feed per spindle revolution", "G95"},
    LinuxcncSharedCode{970, 970, "constant spindle speed: S in 1/min", "G97 S100"},
    LinuxcncSharedCode{980, 980, "cycles end at the level before them, if it is above R", "G98"},
    LinuxcncSharedCode{990, 990, "cycles end at R", "G99"},
};

/// Those that only this dialect has. GCode::tenths is own_code plus ten times the number.
inline constexpr std::uint16_t own_code = 20000;
extern const std::span<const GCode> linuxcnc_own_codes;

/// Codes of LinuxCNC that are not here.
struct LinuxcncMissingCode {
  std::uint16_t first;  ///< tenths; of M codes the number
  std::uint16_t last;
  const char* name;  ///< at most 48 characters
};
inline constexpr std::array linuxcnc_missing_codes = {
    LinuxcncMissingCode{171, 171, "plane UV"},
    LinuxcncMissingCode{181, 181, "plane WU"},
    LinuxcncMissingCode{191, 191, "plane VW"},
    LinuxcncMissingCode{281, 281, "G28.1: the position of G28 is a parameter"},
    LinuxcncMissingCode{301, 301, "G30.1: the position of G30 is a parameter"},
    LinuxcncMissingCode{384, 385, "probing away from the workpiece"},
    LinuxcncMissingCode{700, 722, "lathe cycles G70 to G72.2"},
    LinuxcncMissingCode{870, 870, "G87, which LinuxCNC does not define"},
    LinuxcncMissingCode{880, 880, "G88, which LinuxCNC does not define"},
};

/// The row of a code by its number times ten, or nullptr.
const GCode* linuxcnc_g_code(std::uint32_t tenths);
/// The name of a code that is not here, or nullptr.
const char* linuxcnc_missing_g(std::uint32_t tenths);

/// M5 and M9 act before the motion. M7 and M8 may be in one block.
inline constexpr std::array linuxcnc_m_codes = {
    MCode{0, When::after, MAction::auxiliary, MGroup::flow, "program stop"},
    MCode{1, When::after, MAction::auxiliary, MGroup::flow, "optional stop"},
    MCode{2, When::after, MAction::program_end, MGroup::flow, "program end"},
    MCode{3, When::before, MAction::auxiliary, MGroup::spindle, "spindle clockwise"},
    MCode{4, When::before, MAction::auxiliary, MGroup::spindle, "spindle counter-clockwise"},
    MCode{5, When::before, MAction::auxiliary, MGroup::spindle, "spindle stop"},
    MCode{6, When::before, MAction::tool_change, MGroup::none, "tool change"},
    MCode{7, When::before, MAction::auxiliary, MGroup::none, "mist coolant on"},
    MCode{8, When::before, MAction::auxiliary, MGroup::none, "flood coolant on"},
    MCode{9, When::before, MAction::auxiliary, MGroup::none, "coolant off"},
    MCode{19, When::before, MAction::auxiliary, MGroup::spindle, "spindle stop at R in deg"},
    MCode{30, When::after, MAction::program_end, MGroup::flow, "program end"},
    MCode{98, When::after, MAction::call, MGroup::flow, "call of the numbered program P, L times"},
    MCode{99, When::after, MAction::go_back, MGroup::flow, "end of a numbered program"},
};
inline constexpr std::array linuxcnc_missing_m_codes = {
    LinuxcncMissingCode{49, 49, "overrides off"},
    LinuxcncMissingCode{61, 61, "M61: the PLC knows the tool in the spindle"},
    LinuxcncMissingCode{62, 65, "digital outputs"},
    LinuxcncMissingCode{66, 66, "waiting for an input"},
    LinuxcncMissingCode{67, 68, "analog outputs"},
};
/// M70 to M73 save, forget and restore the modal state; their line holds no other code or word.
inline constexpr std::uint16_t save_state_m = 70, forget_state_m = 71, restore_state_m = 72,
                               save_for_return_m = 73;
/// User programs of LinuxCNC.
inline constexpr std::uint16_t first_user_m = 100, last_user_m = 199;

constexpr std::optional<MCode> linuxcnc_m_code(std::uint16_t number) {
  for (const MCode& code : linuxcnc_m_codes)
    if (code.number == number) return code;
  return std::nullopt;
}
/// The name of an M code that is not here, or nullptr.
const char* linuxcnc_missing_m(std::uint32_t number);

}  // namespace trunnion::language
