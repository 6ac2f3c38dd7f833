// SPDX-License-Identifier: Apache-2.0
#include "language/linuxcnc_codes.hpp"

#include "language/code_row.hpp"

namespace trunnion::language {
namespace {

constexpr std::array linuxcnc_rows = {
    GCode{own_code + 40, Group::one_block, AxisWords::passed,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::dwell>, "dwell of P seconds, before the motion",
          Origin::linuxcnc, "0.3", "G4 P0.5"},
    GCode{
        own_code + 50, Group::motion, AxisWords::move,
        run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{50}>,
        "cubic spline in XY: I J from the start to its control point, P Q from the end to the other; behind "
        "a G5 without I J tangential",
        Origin::linuxcnc, "0.3", "G5 X1 Y1 I0 J3 P0 Q-3 F100\nX2 P0 Q-3"},
    GCode{own_code + 51, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{51}>,
          "quadratic spline in XY: I J from the start to its control point", Origin::linuxcnc, "0.3",
          "G0 X-2 Y4\nG5.1 X2 I2 J-8 F100"},
    GCode{own_code + 52, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{52}>,
          "NURBS in XY of order L (3 or 4): this block and those behind it give points X Y with weights P",
          Origin::linuxcnc, "0.3", "G5.2 P1 L3 F100\nX0 Y1 P1\nX2 Y2\nX2 Y0\nX0 Y0 P2\nG5.3"},
    GCode{own_code + 53, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_curves, &LinuxcncCurves::close>, "end of the points of G5.2",
          Origin::linuxcnc, "0.3", "G5.2 X1 Y1 F100\nX2 Y0\nG5.3"},
    GCode{own_code + 70, Group::diameter, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_diameter, true>,
          "X words are diameters: only where parameter 040032 says so", Origin::linuxcnc, "0.3", "G7"},
    GCode{own_code + 80, Group::diameter, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_diameter, false>,
          "X words are radii: only where parameter 040032 says so", Origin::linuxcnc, "0.3", "G8"},
    GCode{own_code + 100, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::change_table>,
          "tables: L1 tool P (Z length, R radius), L10 and L11 the same so that Z gets this coordinate, L2 "
          "work offset P0..9 (R rotation), L20 the same so that the position gets these coordinates",
          Origin::linuxcnc, "0.3", "G10 L2 P1 X5"},
    GCode{own_code + 280, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::go_to_first>,
          "the axes named over the point given to the reference position, without words all of them straight "
          "there",
          Origin::linuxcnc, "0.3", "G28 X1"},
    GCode{own_code + 300, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::go_to_second>,
          "as G28 to the second reference position", Origin::linuxcnc, "0.3", "G30 X1"},
    GCode{own_code + 330, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{330}>,
          "thread with the lead K along its way, from the index mark; without F", Origin::linuxcnc, "0.3",
          "S100 M3\nG33 Z-5 K1"},
    GCode{own_code + 331, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{331}>,
          "rigid tapping along X, Y or Z with the lead K, and out again I times as fast", Origin::linuxcnc,
          "0.3", "S100 M3\nG33.1 Z-5 K1 I2"},
    GCode{own_code + 382, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{382}>,
          "move until skip input 1 finds a contact, alarm without one", Origin::linuxcnc, "0.3",
          "G38.2 Z-5 F100"},
    GCode{own_code + 383, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{383}>,
          "move until skip input 1 finds a contact; #5070 says whether", Origin::linuxcnc, "0.3",
          "G38.3 Z-5 F100"},
    GCode{own_code + 410, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_side, CutterSide::left>,
          "cutter radius compensation, tool left of the path; radius of tool D, without it of that in the "
          "spindle",
          Origin::linuxcnc, "0.3", "G41 D1"},
    GCode{own_code + 411, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_diameter_side, CutterSide::left>,
          "the same with the diameter D", Origin::linuxcnc, "0.3", "G41.1 D8"},
    GCode{own_code + 420, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_side, CutterSide::right>,
          "cutter radius compensation, tool right of the path; radius of tool D, without it of that in the "
          "spindle",
          Origin::linuxcnc, "0.3", "G42 D1"},
    GCode{own_code + 421, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_diameter_side, CutterSide::right>,
          "the same with the diameter D", Origin::linuxcnc, "0.3", "G42.1 D8"},
    GCode{own_code + 430, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_length>,
          "tool length H along Z, without it or with H0 of the tool in the spindle", Origin::linuxcnc, "0.3",
          "G43 H1"},
    GCode{own_code + 431, Group::tool_length, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::set_length_by_words>, "tool length Z",
          Origin::linuxcnc, "0.3", "G43.1 Z50"},
    GCode{own_code + 432, Group::tool_length, AxisWords::shared,
          run<&BlockHandlers::linuxcnc_tools, &LinuxcncTools::add_length>,
          "the length of tool H, or Z, is added to the tool length", Origin::linuxcnc, "0.3",
          "G43 H1\nG43.2 Z0.1"},
    GCode{own_code + 520, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::set_local>,
          "shift of all work offsets by these words, in place of that of G92", Origin::linuxcnc, "0.3",
          "G52 X5"},
    GCode{own_code + 530, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::move_in_machine_coordinates>,
          "G0 or G1 to machine coordinates; not with G91", Origin::linuxcnc, "0.3", "G53 G0 X1"},
    GCode{own_code + 540, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 0>, "work offset 1", Origin::linuxcnc,
          "0.3", "G54"},
    GCode{own_code + 550, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 1>, "work offset 2", Origin::linuxcnc,
          "0.3", "G55"},
    GCode{own_code + 560, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 2>, "work offset 3", Origin::linuxcnc,
          "0.3", "G56"},
    GCode{own_code + 570, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 3>, "work offset 4", Origin::linuxcnc,
          "0.3", "G57"},
    GCode{own_code + 580, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 4>, "work offset 5", Origin::linuxcnc,
          "0.3", "G58"},
    GCode{own_code + 590, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 5>, "work offset 6", Origin::linuxcnc,
          "0.3", "G59"},
    GCode{own_code + 591, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 6>, "work offset 7: G54.1 P1",
          Origin::linuxcnc, "0.3", "G59.1"},
    GCode{own_code + 592, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 7>, "work offset 8: G54.1 P2",
          Origin::linuxcnc, "0.3", "G59.2"},
    GCode{own_code + 593, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::select, 8>, "work offset 9: G54.1 P3",
          Origin::linuxcnc, "0.3", "G59.3"},
    GCode{own_code + 760, Group::motion, AxisWords::move,
          run<&BlockHandlers::linuxcnc_motion, &LinuxcncMotion::set_motion, std::uint16_t{760}>,
          "thread in passes along Z with the pitch P (G18): I to the crest, J first cut, K height, R "
          "degression, "
          "Q slide angle, H spring passes, E taper at the ends L (1 entry, 2 exit)",
          Origin::linuxcnc, "0.3", "G18 S100 M3\nG76 P1 Z-10 I-2 J0.2 K0.6 R2 Q29.5 H1 E0.5 L2"},
    GCode{own_code + 920, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::shift>,
          "shift of all work offsets that gives the position these coordinates", Origin::linuxcnc, "0.3",
          "G92 X0"},
    GCode{own_code + 921, Group::one_block, AxisWords::passed,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::clear_shift>, "shift of G92 and G52 off",
          Origin::linuxcnc, "0.3", "G92.1"},
    GCode{own_code + 922, Group::one_block, AxisWords::passed,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::suspend_shift>,
          "the same, but G92.3 knows it", Origin::linuxcnc, "0.3", "G92 X1\nG92.2"},
    GCode{own_code + 923, Group::one_block, AxisWords::passed,
          run<&BlockHandlers::linuxcnc_frames, &LinuxcncFrames::resume_shift>, "the shift before G92.2",
          Origin::linuxcnc, "0.3", "G92 X1\nG92.2\nG92.3"},
    GCode{own_code + 960, Group::spindle_mode, AxisWords::move,
          run<&BlockHandlers::linuxcnc_modes, &LinuxcncModes::set_surface_speed>,
          "constant surface speed: S in m/min (ft/min with G20), at most D 1/min", Origin::linuxcnc, "0.3",
          "G96 S100 D2000"},
};

constexpr std::uint8_t no_linuxcnc_code = 0xff;
/// Tenths of LinuxCNC to a row: of the shared codes first, then of its own.
constexpr auto linuxcnc_index = [] {
  std::array<std::uint8_t, 1000> index{};
  index.fill(no_linuxcnc_code);
  for (std::size_t i = 0; i < linuxcnc_shared_codes.size(); ++i)
    index[linuxcnc_shared_codes[i].tenths] = static_cast<std::uint8_t>(i);
  for (std::size_t i = 0; i < linuxcnc_rows.size(); ++i)
    index[linuxcnc_rows[i].tenths - own_code] = static_cast<std::uint8_t>(linuxcnc_shared_codes.size() + i);
  return index;
}();
static_assert(linuxcnc_shared_codes.size() + linuxcnc_rows.size() < no_linuxcnc_code);

const char* missing_name(std::span<const LinuxcncMissingCode> rows, std::uint32_t number) {
  for (const LinuxcncMissingCode& row : rows)
    if (number >= row.first && number <= row.last) return row.name;
  return nullptr;
}

}  // namespace

constinit const std::span<const GCode> linuxcnc_own_codes = linuxcnc_rows;

const GCode* linuxcnc_g_code(std::uint32_t tenths) {
  if (tenths >= linuxcnc_index.size() || linuxcnc_index[tenths] == no_linuxcnc_code) return nullptr;
  const std::size_t place = linuxcnc_index[tenths];
  if (place >= linuxcnc_shared_codes.size()) return &linuxcnc_rows[place - linuxcnc_shared_codes.size()];
  return g_code(linuxcnc_shared_codes[place].code);
}

const char* linuxcnc_missing_g(std::uint32_t tenths) { return missing_name(linuxcnc_missing_codes, tenths); }

const char* linuxcnc_missing_m(std::uint32_t number) {
  return missing_name(linuxcnc_missing_m_codes, number);
}

}  // namespace trunnion::language
