// The G and M codes of the ISO dialect: one table each, which the interpreter obeys and the manual is made
// from.
#pragma once

#include <array>
#include <cstdint>

#include "language/canonical.hpp"

namespace trunnion::language {

/// A block may hold one code of each group: two would contradict each other, so the second is an alarm. All
/// groups but one_block and exact_stop are modal.
enum class Group : std::uint8_t {
  motion,
  one_block,
  plane,
  units,
  cutter_compensation,
  tool_length,
  work_offset,
  path_control,
  distance,
  feed_mode,
  cycle,
  return_level,
  spindle_mode,
  scaling,
  mirror,
  rotation,
  polar,
  smoothing,
  exact_stop,
};
inline constexpr std::size_t group_count = 19;

/// Where a code comes from.
enum class Origin : std::uint8_t {
  iso,    ///< ISO 6983, and the same on every control of this family
  fanuc,  ///< as on Fanuc controls
  hnc,    ///< as on HNC-8 controls
};

/// A G code as ten times its number, so that G43.4 is 434.
struct GCode {
  std::uint16_t tenths;
  Group group;
  const char* meaning;
  Origin origin;
  const char* since;    ///< version of Trunnion
  const char* example;  ///< a program of one or more blocks that shows the code
};

inline constexpr std::array g_codes = {
    GCode{0, Group::motion, "rapid traverse", Origin::iso, "0.1", "G0 X1"},
    GCode{10, Group::motion, "straight line at feed", Origin::iso, "0.1", "G1 X1 F100"},
    GCode{20, Group::motion,
          "circle or helix clockwise; centre I J K from the start, or R; L turns, or the lead of the helix "
          "under the third centre letter",
          Origin::iso, "0.1", "G2 X2 I1 F100"},
    GCode{30, Group::motion, "circle or helix counter-clockwise; words as G2", Origin::iso, "0.1",
          "G3 X2 I1 F100"},
    GCode{40, Group::one_block, "dwell: P milliseconds, or X or U seconds", Origin::iso, "0.1", "G4 P500"},
    GCode{51, Group::smoothing,
          "machining mode: Q0 default, Q1 high precision, Q2 high speed and high precision", Origin::fanuc,
          "0.2", "G5.1 Q1"},
    GCode{62, Group::motion,
          "NURBS curve: P order 2..4, K knot, R weight, X Y Z control point per block; as many blocks with K "
          "alone as the order end it",
          Origin::fanuc, "0.2", "G6.2 P2 K0 X0 F100\nK0 X1\nK1\nK1"},
    GCode{90, Group::exact_stop, "exact stop at the end of this block", Origin::iso, "0.2", "G9 G1 X1 F100"},
    GCode{100, Group::one_block,
          "tables: L2 P1..6 and L20 P1..48 work offsets, L10 length, L11 its wear, L12 radius, L13 its wear "
          "of tool P to R, L50 parameter P to R; without L length Z and radius R of tool P; G91 adds",
          Origin::fanuc, "0.2", "G10 L2 P1 X5"},
    GCode{110, Group::one_block, "end of the parameter input G10 L50", Origin::fanuc, "0.2",
          "G10 L50\nN10 R1\nG11"},
    GCode{150, Group::polar, "polar coordinates off", Origin::fanuc, "0.2", "G15"},
    GCode{160, Group::polar, "polar coordinates: first axis of the plane radius, second angle", Origin::fanuc,
          "0.2", "G16"},
    GCode{170, Group::plane, "plane XY", Origin::iso, "0.1", "G17"},
    GCode{180, Group::plane, "plane ZX", Origin::iso, "0.1", "G18"},
    GCode{190, Group::plane, "plane YZ", Origin::iso, "0.1", "G19"},
    GCode{200, Group::units, "inch: linear words and feeds", Origin::iso, "0.1", "G20"},
    GCode{210, Group::units, "millimetre", Origin::iso, "0.1", "G21"},
    GCode{240, Group::mirror, "mirror on about the coordinates given", Origin::hnc, "0.2", "G24 X0"},
    GCode{250, Group::mirror, "mirror off, of the axes named or of all", Origin::hnc, "0.2", "G25 X0"},
    GCode{280, Group::one_block, "the named axes over the point given to the reference position, in rapid",
          Origin::iso, "0.1", "G28 X1"},
    GCode{290, Group::one_block,
          "from the reference position over the point of the last G28 or G30 to the point given, in rapid",
          Origin::fanuc, "0.2", "G28 X1\nG29 X2"},
    GCode{300, Group::one_block, "as G28 to reference position P2..P4 (2 without P)", Origin::fanuc, "0.2",
          "G30 P2 X1"},
    GCode{310, Group::one_block, "line that ends when skip input L (1 without L) comes", Origin::hnc, "0.2",
          "G31 L1 X1 F100"},
    GCode{400, Group::cutter_compensation,
          "cutter radius compensation off; I J K: the direction in which the contour would continue",
          Origin::iso, "0.1", "G40"},
    GCode{410, Group::cutter_compensation, "cutter radius compensation, tool left of the path; D radius",
          Origin::iso, "0.2", "G41 D1"},
    GCode{420, Group::cutter_compensation, "cutter radius compensation, tool right of the path; D radius",
          Origin::iso, "0.2", "G42 D1"},
    GCode{430, Group::tool_length, "tool length H along Z", Origin::iso, "0.1", "G43 H1"},
    GCode{434, Group::tool_length, "tool tip control (RTCP) with tool length H, rotary angles programmed",
          Origin::hnc, "0.1", "G43.4 H1"},
    GCode{435, Group::tool_length, "tool tip control (RTCP) with tool length H, tool vector I J K programmed",
          Origin::hnc, "0.2", "G43.5 H1"},
    GCode{440, Group::tool_length, "tool length H along Z, subtracted", Origin::iso, "0.2", "G44 H1"},
    GCode{490, Group::tool_length, "tool length and tool tip control off", Origin::iso, "0.1", "G49"},
    GCode{500, Group::scaling, "scaling off", Origin::fanuc, "0.2", "G50"},
    GCode{501, Group::mirror, "mirror off, of the axes named or of all", Origin::fanuc, "0.2", "G50.1 X0"},
    GCode{510, Group::scaling,
          "scaling about X Y Z (the position where not given): factor P, or I J K per axis; negative ones "
          "mirror",
          Origin::fanuc, "0.2", "G51 X0 Y0 P2"},
    GCode{511, Group::mirror, "mirror on about the coordinates given", Origin::fanuc, "0.2", "G51.1 X0"},
    GCode{520, Group::one_block, "local offset: added to every work offset", Origin::fanuc, "0.2", "G52 X5"},
    GCode{530, Group::one_block, "G0 or G1 to machine coordinates of the control point, absolute",
          Origin::iso, "0.1", "G53 G0 X1"},
    GCode{531, Group::one_block,
          "swing to the tilted plane, rotary axes only; alone in the block behind G68.1..3", Origin::hnc,
          "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.1"},
    GCode{532, Group::one_block,
          "swing to the tilted plane, the tool tip stays; alone in the block behind G68.1..3", Origin::hnc,
          "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.2"},
    GCode{533, Group::one_block,
          "move along the tool by L, positive away from its tip; needs tool tip control", Origin::hnc, "0.2",
          "G43.4 H1\nG53.3 L5 F100"},
    GCode{540, Group::work_offset, "work offset 1", Origin::iso, "0.1", "G54"},
    GCode{541, Group::work_offset, "additional work offset P1..P48", Origin::fanuc, "0.2", "G54.1 P1"},
    GCode{550, Group::work_offset, "work offset 2", Origin::iso, "0.1", "G55"},
    GCode{560, Group::work_offset, "work offset 3", Origin::iso, "0.1", "G56"},
    GCode{570, Group::work_offset, "work offset 4", Origin::iso, "0.1", "G57"},
    GCode{580, Group::work_offset, "work offset 5", Origin::iso, "0.1", "G58"},
    GCode{590, Group::work_offset, "work offset 6", Origin::iso, "0.1", "G59"},
    GCode{600, Group::one_block, "single-direction positioning: rapid, every axis arrives from its set side",
          Origin::fanuc, "0.2", "G60 X1"},
    GCode{610, Group::path_control, "exact stop", Origin::iso, "0.1", "G61"},
    GCode{640, Group::path_control,
          "continuous path; P mm off the corners at most, Q mm off collinear points", Origin::iso, "0.1",
          "G64"},
    GCode{680, Group::rotation,
          "rotation in the plane about the point given (the position where not given) by R or P degrees; G91 "
          "adds to the angle",
          Origin::fanuc, "0.2", "G68 X0 Y0 R30"},
    GCode{681, Group::rotation,
          "tilted plane number Q of the table; needs tool tip control; P0 shortest, P1 positive, P2 negative "
          "swing",
          Origin::hnc, "0.2", "G43.4 H1\nG68.1 Q1\nG53.2"},
    GCode{682, Group::rotation,
          "tilted plane at X Y Z, turned by I about Z, J about the new X, K about the new Z; P as G68.1",
          Origin::hnc, "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.2"},
    GCode{
        683, Group::rotation,
        "tilted plane at X Y Z, turned by I about X, then J about Y, then K about Z, axes fixed; P as G68.1",
        Origin::hnc, "0.2", "G43.4 H1\nG68.3 X0 Y0 Z0 I10 J0 K0\nG53.2"},
    GCode{690, Group::rotation, "rotation and tilted plane off", Origin::fanuc, "0.2", "G69"},
    GCode{700, Group::one_block,
          "active drilling cycle on a circle: centre, radius I, first angle J, K holes (negative: clockwise)",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG70 X0 Y0 I10 J0 K4"},
    GCode{710, Group::one_block,
          "active drilling cycle on an arc: centre, radius I, first angle J, angle P between holes, K holes",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG71 X0 Y0 I10 J0 P15 K4"},
    GCode{730, Group::cycle, "chip-breaking drilling: Q per peck", Origin::fanuc, "0.2",
          "G73 Z-4 R1 Q2 F100"},
    GCode{740, Group::cycle,
          "rigid tapping, left-hand thread, at S; G94: lead = F / S, G95: lead = F; Q per peck; J1..6: the "
          "spindle is the axis A B C U V W",
          Origin::fanuc, "0.2", "G95 S100 G74 Z-4 R1 F1"},
    GCode{760, Group::cycle,
          "fine boring: oriented stop at the bottom, shift Q or I J K of the plane, rapid out", Origin::fanuc,
          "0.2", "G76 Z-4 R1 Q1 F100"},
    GCode{780, Group::one_block, "active drilling cycle on a line: first hole, spacing I, angle J, K holes",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG78 X0 Y0 I10 J0 K4"},
    GCode{790, Group::one_block,
          "active drilling cycle on a grid, to and fro: first hole, spacing I times P, spacing J times K",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG79 X0 Y0 I10 P3 J10 K4"},
    GCode{800, Group::cycle, "cycle off", Origin::iso, "0.1", "G80"},
    GCode{810, Group::cycle, "drilling", Origin::iso, "0.2", "G81 Z-4 R1 F100"},
    GCode{820, Group::cycle, "drilling with dwell P", Origin::iso, "0.2", "G82 Z-4 R1 P100 F100"},
    GCode{830, Group::cycle, "deep drilling: Q per peck, out to R between", Origin::iso, "0.2",
          "G83 Z-4 R1 Q2 F100"},
    GCode{840, Group::cycle, "rigid tapping, right-hand thread; words as G74", Origin::iso, "0.2",
          "G95 S100 G84 Z-4 R1 F1"},
    GCode{850, Group::cycle, "boring, out at feed", Origin::iso, "0.2", "G85 Z-4 R1 F100"},
    GCode{860, Group::cycle, "boring, spindle stops, rapid out", Origin::iso, "0.2", "G86 Z-4 R1 F100"},
    GCode{870, Group::cycle,
          "back boring: R the bottom, Z the end of the bore, shift Q or I J K of the plane; needs G98",
          Origin::fanuc, "0.2", "G87 Z-4 R-9 Q1 F100"},
    GCode{880, Group::cycle, "boring with dwell P, spindle stops, program stop, rapid out", Origin::iso,
          "0.2", "G88 Z-4 R1 P100 F100"},
    GCode{890, Group::cycle, "boring with dwell P, out at feed", Origin::iso, "0.2", "G89 Z-4 R1 P100 F100"},
    GCode{900, Group::distance, "absolute words", Origin::iso, "0.1", "G90"},
    GCode{910, Group::distance, "incremental words", Origin::iso, "0.1", "G91"},
    GCode{920, Group::one_block,
          "shift of all work offsets that gives the position these coordinates; S limit of the spindle with "
          "G96",
          Origin::fanuc, "0.2", "G92 X0"},
    GCode{921, Group::one_block, "G52 and G92 off", Origin::fanuc, "0.2", "G92.1"},
    GCode{930, Group::feed_mode, "inverse time: F in 1/min, in every block that moves at feed", Origin::iso,
          "0.1", "G93"},
    GCode{940, Group::feed_mode, "feed per minute", Origin::iso, "0.1", "G94"},
    GCode{950, Group::feed_mode, "feed per spindle revolution", Origin::iso, "0.1", "G95"},
    GCode{960, Group::spindle_mode, "constant surface speed: S in m/min (ft/min with G20)", Origin::iso,
          "0.2", "G96 S100"},
    GCode{970, Group::spindle_mode, "constant spindle speed: S in 1/min", Origin::iso, "0.2", "G97 S100"},
    GCode{980, Group::return_level, "cycles end at the level they were called at", Origin::iso, "0.2", "G98"},
    GCode{990, Group::return_level, "cycles end at R", Origin::iso, "0.2", "G99"},
};

/// When an M code acts, seen from the motion of its block.
enum class When : std::uint8_t { before, after };

/// What an M code means to the interpreter itself.
enum class MAction : std::uint8_t {
  auxiliary,    ///< handed to the channel and the PLC
  tool_change,  ///< as auxiliary; the selected tool becomes the tool
  program_end,
  call,     ///< P the subprogram, L how often
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
    MCode{19, When::before, MAction::auxiliary, MGroup::spindle, "spindle stop at its reference angle"},
    MCode{30, When::after, MAction::program_end, MGroup::flow, "program end and rewind"},
    MCode{98, When::after, MAction::call, MGroup::flow, "subprogram call: P number, L repetitions"},
    MCode{99, When::after, MAction::go_back, MGroup::flow, "subprogram end"},
};
inline constexpr std::uint16_t highest_m = 999;

/// Every M code the table does not name goes to the PLC before the motion: clamps must open before an axis
/// moves.
constexpr MCode m_code(std::uint16_t number) {
  for (const MCode& code : m_codes) {
    if (code.number == number) return code;
  }
  return {number, When::before, MAction::auxiliary, MGroup::none, "auxiliary function"};
}

/// T, S, and M codes that do not only steer the program's flow: what the PLC carries out and going back along
/// the path does not undo.
constexpr bool changes_machine(const Command& command) {
  if (command.kind == CommandKind::tool || command.kind == CommandKind::spindle_speed) return true;
  return command.kind == CommandKind::auxiliary &&
         m_code(static_cast<std::uint16_t>(command.number)).group != MGroup::flow;
}

namespace detail {
inline constexpr std::uint8_t no_code = 0xff;
inline constexpr auto g_index = [] {
  std::array<std::uint8_t, 1000> index{};
  index.fill(no_code);
  for (std::size_t i = 0; i < g_codes.size(); ++i) index[g_codes[i].tenths] = static_cast<std::uint8_t>(i);
  return index;
}();
}  // namespace detail

/// The code with this number times ten, or nullptr.
constexpr const GCode* g_code(std::uint32_t tenths) {
  if (tenths >= detail::g_index.size() || detail::g_index[tenths] == detail::no_code) return nullptr;
  return &g_codes[detail::g_index[tenths]];
}

}  // namespace trunnion::language
