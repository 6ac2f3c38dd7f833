// SPDX-License-Identifier: Apache-2.0
// The G and M codes of the ISO dialect: one table each, which the interpreter follows and the manual is made
// from.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "language/alarms.hpp"
#include "language/canonical.hpp"

namespace trunnion::language {

/// A block may hold one code of each group: two would contradict each other, so the second is an alarm. All
/// groups except one_block and exact_stop are modal. The codes of a block act in the sequence of this list.
enum class Group : std::uint8_t {
  exact_stop,
  units,
  feed_mode,
  spindle_mode,
  plane,
  distance,
  arc_distance,
  diameter,
  return_level,
  path_control,
  work_offset,
  polar,
  smoothing,
  motion,
  cycle,
  tool_length,
  cutter_compensation,
  stroke_zone,
  setting_error,
  scaling,
  mirror,
  rotation,
  one_block,
};
inline constexpr std::size_t group_count = 23;

/// Where a code comes from.
enum class Origin : std::uint8_t {
  iso,         ///< ISO 6983, and the same on every control of this family
  fanuc,       ///< as on Fanuc controls
  hnc,         ///< as on HNC-8 controls
  num,         ///< as on NUM controls
  g2core,      ///< as on g2core and TinyG
  linuxcnc,    ///< as in LinuxCNC
  haas,        ///< as on Haas controls
  mitsubishi,  ///< as on Mitsubishi controls
};

/// What the axis words of a block with the code mean.
enum class AxisWords : std::uint8_t {
  move,    ///< the code leaves them to the motion of the block
  taken,   ///< the code gives them a meaning of its own, so that the block moves nothing else
  shared,  ///< taken when there are any
  passed,  ///< as move, and the code is carried out before a motion of the same block
};

struct BlockHandlers;

/// A G code as ten times its number, so that G43.4 is 434.
struct GCode {
  std::uint16_t tenths;
  Group group;
  AxisWords axis_words;
  /// Carries the code out; `at` is its place in the line.
  Fault (*execute)(BlockHandlers& handlers, std::uint16_t at);
  const char* meaning;
  Origin origin;
  const char* since;    ///< version of Trunnion
  const char* example;  ///< a program of one or more blocks that shows the code
  /// Why the control accepts the code and does nothing for it; null: it has an effect.
  const char* no_effect = nullptr;
};

/// Sorted by number; in codes.cpp.
extern const std::span<const GCode> g_codes;

/// The code with this number times ten, or nullptr.
const GCode* g_code(std::uint32_t tenths);

/// When an M code acts, seen from the motion of its block.
enum class When : std::uint8_t { before, after };

/// What an M code means to the interpreter itself.
enum class MAction : std::uint8_t {
  auxiliary,    ///< handed to the channel and the PLC
  tool_change,  ///< as auxiliary; the selected tool becomes the tool
  program_end,
  call,     ///< P the subprogram, H or Q where it begins, L how often
  go_back,  ///< end of a subprogram; a main program starts again from its top
};

/// A block may hold one M code of each group but `none`, and none twice.
enum class MGroup : std::uint8_t { none, spindle, flow };

struct MCode {
  std::uint16_t number;
  When when;
  MAction action;
  MGroup group;
  const char* meaning;
};

inline constexpr std::array m_codes = {
    MCode{0, When::after, MAction::auxiliary, MGroup::flow, "program stop"},
    MCode{1, When::after, MAction::auxiliary, MGroup::flow, "optional stop"},
    MCode{2, When::after, MAction::program_end, MGroup::flow, "program end"},
    MCode{3, When::before, MAction::auxiliary, MGroup::spindle, "spindle clockwise"},
    MCode{4, When::before, MAction::auxiliary, MGroup::spindle, "spindle counter-clockwise"},
    MCode{5, When::after, MAction::auxiliary, MGroup::spindle, "spindle stop"},
    MCode{6, When::before, MAction::tool_change, MGroup::none, "tool change"},
    MCode{7, When::before, MAction::auxiliary, MGroup::none, "mist coolant on"},
    MCode{8, When::before, MAction::auxiliary, MGroup::none, "flood coolant on"},
    MCode{9, When::after, MAction::auxiliary, MGroup::none, "coolant off"},
    MCode{19, When::before, MAction::auxiliary, MGroup::spindle,
          "spindle stop at its reference angle, or at R or P in deg"},
    MCode{
        29, When::before, MAction::auxiliary, MGroup::none,
        "rigid tapping follows: nothing to do, since G74 and G84 are rigid; to the PLC where the list of the "
        "channel has it"},
    MCode{30, When::after, MAction::program_end, MGroup::flow, "program end and rewind"},
    MCode{98, When::after, MAction::call, MGroup::flow,
          "subprogram call: P number, H or Q sequence number in it, L repetitions"},
    MCode{99, When::after, MAction::go_back, MGroup::flow, "subprogram end"},
    MCode{198, When::after, MAction::call, MGroup::flow, "as M98: there is one store of programs"},
};
inline constexpr std::uint16_t highest_m = 9999;

/// Whether the table has M`number`.
constexpr bool is_named_m(std::uint32_t number) {
  for (const MCode& code : m_codes) {
    if (code.number == number) return true;
  }
  return false;
}

/// Every M code the table does not name goes to the PLC before the motion: clamps must open before an axis
/// moves.
constexpr MCode m_code(std::uint16_t number) {
  for (const MCode& code : m_codes) {
    if (code.number == number) return code;
  }
  return {number, When::before, MAction::auxiliary, MGroup::none, "auxiliary function"};
}

/// What M`number` asks for is always so: it may stand where the machine's logic does not know it, and then
/// makes no command.
constexpr bool is_granted(std::uint16_t number) { return number == 29; }

/// The modal motion code `motion` cuts a thread.
constexpr bool is_thread(std::uint8_t motion) { return motion == 33 || motion == 34; }

/// T, S, orders for spindles, and M codes that do not only steer the program's flow: what the PLC carries out
/// and going back along the path does not undo.
constexpr bool changes_machine(const Command& command) {
  if (command.kind == CommandKind::tool || command.kind == CommandKind::spindle_speed ||
      command.kind == CommandKind::spindle_order)
    return true;
  return command.kind == CommandKind::auxiliary &&
         m_code(static_cast<std::uint16_t>(command.number)).group != MGroup::flow;
}

}  // namespace trunnion::language
