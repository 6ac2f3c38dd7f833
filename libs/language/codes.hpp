// The G and M codes of the ISO dialect: one table each, which the interpreter obeys and the manual is made
// from.
#pragma once

#include <array>
#include <cstdint>

namespace trunnion::language {

/// A block may hold one code of each group. All groups but one_block are modal.
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
};
inline constexpr std::size_t group_count = 10;

/// A G code as ten times its number, so that G43.4 is 434.
struct GCode {
  std::uint16_t tenths;
  Group group;
  bool available;  ///< false: known, and refused with its own alarm
  const char* meaning;
};

inline constexpr std::array g_codes = {
    GCode{0, Group::motion, true, "rapid traverse"},
    GCode{10, Group::motion, true, "straight line at feed"},
    GCode{20, Group::motion, true, "circle or helix clockwise; centre I J K from the start, or R; L turns"},
    GCode{30, Group::motion, true,
          "circle or helix counter-clockwise; centre I J K from the start, or R; L turns"},
    GCode{40, Group::one_block, true, "dwell: P milliseconds, or X or U seconds"},
    GCode{170, Group::plane, true, "plane XY"},
    GCode{180, Group::plane, true, "plane ZX"},
    GCode{190, Group::plane, true, "plane YZ"},
    GCode{200, Group::units, true, "inch: linear words and feeds"},
    GCode{210, Group::units, true, "millimetre"},
    GCode{280, Group::one_block, true,
          "the named axes over the point given to the reference position, in rapid"},
    GCode{400, Group::cutter_compensation, true, "cutter radius compensation off"},
    GCode{410, Group::cutter_compensation, false, "cutter radius compensation left"},
    GCode{420, Group::cutter_compensation, false, "cutter radius compensation right"},
    GCode{430, Group::tool_length, true, "tool length H along Z"},
    GCode{434, Group::tool_length, true,
          "tool tip control (RTCP) with tool length H, rotary angles programmed"},
    GCode{490, Group::tool_length, true, "tool length and tool tip control off"},
    GCode{530, Group::one_block, true, "G0 or G1 to machine coordinates of the control point, absolute"},
    GCode{540, Group::work_offset, true, "work offset 1"},
    GCode{550, Group::work_offset, true, "work offset 2"},
    GCode{560, Group::work_offset, true, "work offset 3"},
    GCode{570, Group::work_offset, true, "work offset 4"},
    GCode{580, Group::work_offset, true, "work offset 5"},
    GCode{590, Group::work_offset, true, "work offset 6"},
    GCode{610, Group::path_control, true, "exact stop"},
    GCode{640, Group::path_control, true, "continuous path"},
    GCode{800, Group::motion, true, "no motion: axis words need a motion code first"},
    GCode{900, Group::distance, true, "absolute words"},
    GCode{910, Group::distance, true, "incremental words"},
    GCode{930, Group::feed_mode, true, "inverse time: F in 1/min, in every block that moves at feed"},
    GCode{940, Group::feed_mode, true, "feed per minute"},
    GCode{950, Group::feed_mode, true, "feed per spindle revolution"},
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
