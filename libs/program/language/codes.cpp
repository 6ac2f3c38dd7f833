// SPDX-License-Identifier: Apache-2.0
#include "language/codes.hpp"

#include "language/block_handlers.hpp"

namespace trunnion::language {
namespace {

/// What a row names: a function of a handler, and what it is called with.
template <auto handler, auto function, auto... arguments>
Fault run(BlockHandlers& handlers, std::uint16_t at) {
  return ((handlers.*handler).*function)(at, arguments...);
}

constexpr std::array rows = {
    GCode{0, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 0>,
          "rapid traverse", Origin::iso, "0.1", "G0 X1"},
    GCode{10, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 1>,
          "straight line at feed", Origin::iso, "0.1", "G1 X1 F100"},
    GCode{20, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 2>,
          "circle or helix clockwise; centre I J K from the start, or R; L turns, or the lead of the helix "
          "under the third centre letter",
          Origin::iso, "0.1", "G2 X2 I1 F100"},
    GCode{30, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 3>,
          "circle or helix counter-clockwise; words as G2", Origin::iso, "0.1", "G3 X2 I1 F100"},
    GCode{40, Group::one_block, AxisWords::taken, run<&BlockHandlers::positioning, &Positioning::dwell>,
          "dwell: P milliseconds, or X or U seconds", Origin::iso, "0.1", "G4 P500"},
    GCode{50, Group::smoothing, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_contour_control>,
          "machining mode: P0 default, P10000 high precision as G5.1 Q1, P1 to P3 as Q2", Origin::fanuc,
          "0.3", "G5 P10000"},
    GCode{51, Group::smoothing, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_smoothing>,
          "machining mode: Q0 default, Q1 high precision, Q2 and Q3 high speed and high precision; R1..R5 of "
          "Q1 as Q2; the axes that Q2 and Q3 name with 0 do not move",
          Origin::fanuc, "0.2", "G5.1 Q1"},
    GCode{62, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 62>,
          "NURBS curve: P order 2..4, K knot, R weight, X Y Z control point per block; as many blocks with K "
          "alone as the order end it",
          Origin::fanuc, "0.2", "G6.2 P2 K0 X0 F100\nK0 X1\nK1\nK1"},
    GCode{80, Group::smoothing, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_look_ahead>,
          "machining mode: P0 default, P1 high precision as G5.1 Q1", Origin::fanuc, "0.3", "G8 P1"},
    GCode{90, Group::exact_stop, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::stop_exactly>,
          "exact stop at the end of this block", Origin::iso, "0.2", "G9 G1 X1 F100"},
    GCode{100, Group::one_block, AxisWords::taken, run<&BlockHandlers::tables, &TableCodes::change_table>,
          "tables: L2 P1..6 and L20 P1..48 work offsets, L2 P0 the external one, L23 P1..7 setting errors of "
          "G54.4, L10 length, L11 or L1 its "
          "wear, L12 radius, L13 its wear of tool P to R, L50 parameter P to R; without L length Z and "
          "radius R of tool P; G91 adds",
          Origin::fanuc, "0.2", "G10 L2 P1 X5"},
    GCode{110, Group::one_block, AxisWords::move,
          run<&BlockHandlers::tables, &TableCodes::end_parameter_input>, "end of the parameter input G10 L50",
          Origin::fanuc, "0.2", "G10 L50\nN10 R1\nG11"},
    GCode{150, Group::polar, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_polar, false>,
          "polar coordinates off", Origin::fanuc, "0.2", "G15"},
    GCode{160, Group::polar, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_polar, true>,
          "polar coordinates: first axis of the plane radius, second angle", Origin::fanuc, "0.2", "G16"},
    GCode{170, Group::plane, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_plane, Plane::xy>,
          "plane XY", Origin::iso, "0.1", "G17"},
    GCode{180, Group::plane, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_plane, Plane::zx>,
          "plane ZX", Origin::iso, "0.1", "G18"},
    GCode{190, Group::plane, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_plane, Plane::yz>,
          "plane YZ", Origin::iso, "0.1", "G19"},
    GCode{200, Group::units, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_units, false>,
          "inch: linear words and feeds", Origin::iso, "0.1", "G20"},
    GCode{210, Group::units, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_units, true>,
          "millimetre", Origin::iso, "0.1", "G21"},
    GCode{
        220, Group::stroke_zone, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_zone>,
        "forbidden zone on, a box in machine coordinates: corner X Y Z, opposite corner I J K; inside it, or "
        "outside by 04c730",
        Origin::fanuc, "0.3", "G22 X100 I50 Z-200 K-300"},
    GCode{230, Group::stroke_zone, AxisWords::move, run<&BlockHandlers::frames, &FrameCodes::clear_zone>,
          "forbidden zone off", Origin::fanuc, "0.3", "G23"},
    GCode{240, Group::mirror, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_mirror, true>,
          "mirror on about the coordinates given", Origin::hnc, "0.2", "G24 X0"},
    GCode{250, Group::mirror, AxisWords::shared, run<&BlockHandlers::frames, &FrameCodes::set_mirror, false>,
          "mirror off, of the axes named or of all", Origin::hnc, "0.2", "G25 X0"},
    GCode{270, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::check_reference>,
          "in rapid to the point given, which must be the reference position of the axes named",
          Origin::fanuc, "0.3", "G27 X500"},
    GCode{280, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::return_to_reference>,
          "the named axes over the point given to the reference position, in rapid", Origin::iso, "0.1",
          "G28 X1"},
    GCode{
        282, Group::one_block, AxisWords::taken, run<&BlockHandlers::positioning, &Positioning::home>,
        "search of the references of the axes named, one after the other: X Y Z, U V W, A B C; F its speed, "
        "at most the axis' own",
        Origin::g2core, "0.3", "G28.2 X0 Z0"},
    GCode{290, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::return_from_reference>,
          "from the reference position over the point of the last G28 or G30 to the point given, in rapid",
          Origin::fanuc, "0.2", "G28 X1\nG29 X2"},
    GCode{300, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::return_to_numbered_reference>,
          "as G28 to reference position P2..P4 (2 without P)", Origin::fanuc, "0.2", "G30 P2 X1"},
    GCode{310, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_until_skip>,
          "line that ends when skip input L (1 without L) comes", Origin::hnc, "0.2", "G31 L1 X1 F100"},
    GCode{320, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 33>,
          "as G33", Origin::fanuc, "0.3", "S100 M3\nG32 Z-1 F0.5"},
    GCode{330, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 33>,
          "thread: line that follows the turning spindle; F lead in a revolution of the axis that goes "
          "farthest, Q angle of the start behind the index mark in degrees",
          Origin::iso, "0.3", "S100 M3\nG33 Z-1 F0.5 Q180"},
    GCode{340, Group::motion, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_motion, 34>,
          "thread with variable lead: as G33, K change of the lead in each revolution", Origin::iso, "0.3",
          "S100 M3\nG34 Z-1 F0.5 K0.1"},
    GCode{400, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_cutter_side, CutterSide::off>,
          "cutter radius compensation off; I J K: the direction in which the contour would continue",
          Origin::iso, "0.1", "G40"},
    GCode{410, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_cutter_side, CutterSide::left>,
          "cutter radius compensation, tool left of the path; D radius", Origin::iso, "0.2", "G41 D1"},
    GCode{420, Group::cutter_compensation, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_cutter_side, CutterSide::right>,
          "cutter radius compensation, tool right of the path; D radius", Origin::iso, "0.2", "G42 D1"},
    GCode{430, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_length, LengthUse::added>, "tool length H along Z",
          Origin::iso, "0.1", "G43 H1"},
    GCode{434, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_length, LengthUse::tip>,
          "tool tip control (RTCP) with tool length H, rotary angles programmed", Origin::hnc, "0.1",
          "G43.4 H1"},
    GCode{435, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_length, LengthUse::vector>,
          "tool tip control (RTCP) with tool length H, tool vector I J K programmed", Origin::hnc, "0.2",
          "G43.5 H1"},
    GCode{440, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_length, LengthUse::subtracted>,
          "tool length H along Z, subtracted", Origin::iso, "0.2", "G44 H1"},
    GCode{450, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_by_offset, 1>,
          "G0 or G1 that goes farther by the radius D, along each linear axis named", Origin::fanuc, "0.3",
          "G45 G0 X10 D1"},
    GCode{460, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_by_offset, -1>, "as G45, less far by it",
          Origin::fanuc, "0.3", "G46 G0 X10 D1"},
    GCode{470, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_by_offset, 2>, "as G45, farther by twice of it",
          Origin::fanuc, "0.3", "G47 G0 X10 D1"},
    GCode{480, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_by_offset, -2>,
          "as G45, less far by twice of it", Origin::fanuc, "0.3", "G48 G0 X10 D1"},
    GCode{490, Group::tool_length, AxisWords::move,
          run<&BlockHandlers::tool, &ToolCodes::set_length, LengthUse::off>,
          "tool length and tool tip control off", Origin::iso, "0.1", "G49"},
    GCode{500, Group::scaling, AxisWords::move, run<&BlockHandlers::frames, &FrameCodes::clear_scaling>,
          "scaling off", Origin::fanuc, "0.2", "G50"},
    GCode{501, Group::mirror, AxisWords::shared, run<&BlockHandlers::frames, &FrameCodes::set_mirror, false>,
          "mirror off, of the axes named or of all", Origin::fanuc, "0.2", "G50.1 X0"},
    GCode{510, Group::scaling, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_scaling>,
          "scaling about X Y Z (the position where not given): factor P, or I J K per axis; negative ones "
          "mirror",
          Origin::fanuc, "0.2", "G51 X0 Y0 P2"},
    GCode{511, Group::mirror, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_mirror, true>,
          "mirror on about the coordinates given", Origin::fanuc, "0.2", "G51.1 X0"},
    GCode{520, Group::one_block, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_local_offset>,
          "local offset: added to every work offset", Origin::fanuc, "0.2", "G52 X5"},
    GCode{530, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::move_in_machine_coordinates>,
          "G0 or G1 to machine coordinates of the control point, absolute", Origin::iso, "0.1", "G53 G0 X1"},
    GCode{531, Group::one_block, AxisWords::taken, run<&BlockHandlers::planes, &TiltedPlanes::swing, false>,
          "swing to the tilted plane, rotary axes only; alone in the block behind G68.1..3", Origin::hnc,
          "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.1"},
    GCode{532, Group::one_block, AxisWords::taken, run<&BlockHandlers::planes, &TiltedPlanes::swing, true>,
          "swing to the tilted plane, the tool tip stays; alone in the block behind G68.1..3", Origin::hnc,
          "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.2"},
    GCode{533, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::planes, &TiltedPlanes::move_along_tool>,
          "move along the tool by L, positive away from its tip; needs tool tip control", Origin::hnc, "0.2",
          "G43.4 H1\nG53.3 L5 F100"},
    GCode{536, Group::one_block, AxisWords::taken, run<&BlockHandlers::planes, &TiltedPlanes::swing, true>,
          "as G53.2", Origin::fanuc, "0.3", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.6"},
    GCode{540, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_first_work_offset>,
          "work offset 1; P1..P48 as G54.1, when no other code takes P", Origin::iso, "0.1", "G54"},
    GCode{541, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_additional_work_offset>,
          "additional work offset P1..P48", Origin::fanuc, "0.2", "G54.1 P1"},
    GCode{544, Group::setting_error, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_setting_error>,
          "setting error P1..P7 of the workpiece: words are in the workpiece as it is clamped, shifted and "
          "turned, "
          "with tool tip control the tool's direction too; P0 off",
          Origin::fanuc, "0.3", "G54.4 P1\nG43.4 H1\nG1 X1 F100\nG54.4 P0"},
    GCode{550, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 1>, "work offset 2", Origin::iso, "0.1",
          "G55"},
    GCode{560, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 2>, "work offset 3", Origin::iso, "0.1",
          "G56"},
    GCode{570, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 3>, "work offset 4", Origin::iso, "0.1",
          "G57"},
    GCode{580, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 4>, "work offset 5", Origin::iso, "0.1",
          "G58"},
    GCode{590, Group::work_offset, AxisWords::move,
          run<&BlockHandlers::frames, &FrameCodes::set_work_offset, 5>, "work offset 6", Origin::iso, "0.1",
          "G59"},
    GCode{600, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::positioning, &Positioning::approach_from_one_side>,
          "single-direction positioning: rapid, every axis arrives from its set side", Origin::fanuc, "0.2",
          "G60 X1"},
    GCode{610, Group::path_control, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::stop_at_every_end>, "exact stop", Origin::iso, "0.1",
          "G61"},
    GCode{611, Group::path_control, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_accurate_path>,
          "continuous path with the machining mode of G5.1 Q1, until the next code of the group",
          Origin::fanuc, "0.3", "G61.1"},
    GCode{620, Group::path_control, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::follow_path>,
          "as G64 without P", Origin::fanuc, "0.3", "G62",
          "the limits of the axes slow every corner, and no override of corners adds to them"},
    GCode{630, Group::path_control, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::follow_path>,
          "as G64 without P", Origin::fanuc, "0.3", "G63",
          "overrides and feed hold act as always; G84 taps in step with the spindle"},
    GCode{640, Group::path_control, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_continuous_path>,
          "continuous path; P mm off the corners at most, Q mm off collinear points", Origin::iso, "0.1",
          "G64"},
    GCode{680, Group::rotation, AxisWords::taken, run<&BlockHandlers::frames, &FrameCodes::set_rotation>,
          "rotation in the plane about the point given (the position where not given) by R or P degrees; G91 "
          "adds to the angle",
          Origin::fanuc, "0.2", "G68 X0 Y0 R30"},
    GCode{681, Group::rotation, AxisWords::taken,
          run<&BlockHandlers::planes, &TiltedPlanes::tilt_to_stored_plane>,
          "tilted plane number Q of the table; P0 shortest, P1 positive, P2 negative "
          "swing",
          Origin::hnc, "0.2", "G43.4 H1\nG68.1 Q1\nG53.2"},
    GCode{682, Group::rotation, AxisWords::taken,
          run<&BlockHandlers::planes, &TiltedPlanes::tilt_by_angles, true>,
          "tilted plane at X Y Z, turned by I about Z, J about the new X, K about the new Z; P as G68.1",
          Origin::hnc, "0.2", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG53.2"},
    GCode{
        683, Group::rotation, AxisWords::taken,
        run<&BlockHandlers::planes, &TiltedPlanes::tilt_by_angles, false>,
        "tilted plane at X Y Z, turned by I about X, then J about Y, then K about Z, axes fixed; P as G68.1",
        Origin::hnc, "0.2", "G43.4 H1\nG68.3 X0 Y0 Z0 I10 J0 K0\nG53.2"},
    GCode{684, Group::rotation, AxisWords::taken, run<&BlockHandlers::planes, &TiltedPlanes::tilt_in_plane>,
          "tilted plane in the one that is active: words as G68.2, from its origin and its axes",
          Origin::fanuc, "0.3", "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\nG68.4 X1 Y0 Z0 I90 J5 K0\nG53.2"},
    GCode{690, Group::rotation, AxisWords::move, run<&BlockHandlers::planes, &TiltedPlanes::clear_rotation>,
          "rotation and tilted plane off", Origin::fanuc, "0.2", "G69"},
    GCode{700, Group::one_block, AxisWords::taken, run<&BlockHandlers::cycles, &DrillingCycles::drill_circle>,
          "active drilling cycle on a circle: centre, radius I, first angle J, K holes (negative: clockwise)",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG70 X0 Y0 I10 J0 K4"},
    GCode{710, Group::one_block, AxisWords::taken, run<&BlockHandlers::cycles, &DrillingCycles::drill_arc>,
          "active drilling cycle on an arc: centre, radius I, first angle J, angle P between holes, K holes",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG71 X0 Y0 I10 J0 P15 K4"},
    GCode{730, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 73>,
          "chip-breaking drilling: Q per peck", Origin::fanuc, "0.2", "G73 Z-4 R1 Q2 F100"},
    GCode{740, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 74>,
          "rigid tapping, left-hand thread, at S; G94: lead = F / S, G95: lead = F; Q per peck; J1..6: the "
          "spindle is the axis A B C U V W",
          Origin::fanuc, "0.2", "G95 S100 G74 Z-4 R1 F1"},
    GCode{760, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 76>,
          "fine boring: oriented stop at the bottom, shift Q or I J K of the plane, rapid out", Origin::fanuc,
          "0.2", "G76 Z-4 R1 Q1 F100"},
    GCode{780, Group::one_block, AxisWords::taken, run<&BlockHandlers::cycles, &DrillingCycles::drill_line>,
          "active drilling cycle on a line: first hole, spacing I, angle J, K holes", Origin::hnc, "0.2",
          "G81 Z-1 R1 L0 F100\nG78 X0 Y0 I10 J0 K4"},
    GCode{790, Group::one_block, AxisWords::taken, run<&BlockHandlers::cycles, &DrillingCycles::drill_grid>,
          "active drilling cycle on a grid, to and fro: first hole, spacing I times P, spacing J times K",
          Origin::hnc, "0.2", "G81 Z-1 R1 L0 F100\nG79 X0 Y0 I10 P3 J10 K4"},
    GCode{800, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 80>,
          "cycle off", Origin::iso, "0.1", "G80"},
    GCode{810, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 81>,
          "drilling", Origin::iso, "0.2", "G81 Z-4 R1 F100"},
    GCode{820, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 82>,
          "drilling with dwell P", Origin::iso, "0.2", "G82 Z-4 R1 P100 F100"},
    GCode{830, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 83>,
          "deep drilling: Q per peck, out to R between", Origin::iso, "0.2", "G83 Z-4 R1 Q2 F100"},
    GCode{840, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 84>,
          "rigid tapping, right-hand thread; words as G74", Origin::iso, "0.2", "G95 S100 G84 Z-4 R1 F1"},
    GCode{849, Group::one_block, AxisWords::taken, run<&BlockHandlers::tap_removal, &TapRemoval::run>,
          "removal of a tap: one axis word, how far out from the position; K lead, negative left-hand; S",
          Origin::num, "0.3", "S200 G84.9 Z12 K1.25"},
    GCode{850, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 85>,
          "boring, out at feed", Origin::iso, "0.2", "G85 Z-4 R1 F100"},
    GCode{860, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 86>,
          "boring, spindle stops, rapid out", Origin::iso, "0.2", "G86 Z-4 R1 F100"},
    GCode{870, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 87>,
          "back boring: R the bottom, Z the end of the bore, shift Q or I J K of the plane; needs G98",
          Origin::fanuc, "0.2", "G87 Z-4 R-9 Q1 F100"},
    GCode{880, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 88>,
          "boring with dwell P, spindle stops, program stop, rapid out", Origin::iso, "0.2",
          "G88 Z-4 R1 P100 F100"},
    GCode{890, Group::cycle, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_cycle, 89>,
          "boring with dwell P, out at feed", Origin::iso, "0.2", "G89 Z-4 R1 P100 F100"},
    GCode{900, Group::distance, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_distance, true>,
          "absolute words", Origin::iso, "0.1", "G90"},
    GCode{910, Group::distance, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_distance, false>,
          "incremental words", Origin::iso, "0.1", "G91"},
    GCode{920, Group::one_block, AxisWords::taken,
          run<&BlockHandlers::frames, &FrameCodes::shift_coordinates>,
          "shift of all work offsets that gives the position these coordinates; S limit of the spindle with "
          "G96",
          Origin::fanuc, "0.2", "G92 X0"},
    GCode{921, Group::one_block, AxisWords::shared, run<&BlockHandlers::frames, &FrameCodes::clear_shift>,
          "G52 and G92 off, of all axes or of those that are named with 0", Origin::fanuc, "0.2", "G92.1 X0"},
    GCode{930, Group::feed_mode, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_feed_mode, FeedMode::inverse_time>,
          "inverse time: F in 1/min, in every block that moves at feed", Origin::iso, "0.1", "G93"},
    GCode{940, Group::feed_mode, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_feed_mode, FeedMode::per_minute>, "feed per minute",
          Origin::iso, "0.1", "G94"},
    GCode{950, Group::feed_mode, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_feed_mode, FeedMode::per_revolution>,
          "feed per spindle revolution", Origin::iso, "0.1", "G95"},
    GCode{
        960, Group::spindle_mode, AxisWords::move,
        run<&BlockHandlers::modal, &ModalCodes::set_spindle_mode, SpindleMode::surface>,
        "constant surface speed: S in m/min (ft/min with G20), the speed follows X within the limit of G92 S",
        Origin::iso, "0.2", "G96 S100"},
    GCode{970, Group::spindle_mode, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_spindle_mode, SpindleMode::speed>,
          "constant spindle speed: S in 1/min; without S behind G96 the speed that it has", Origin::iso,
          "0.2", "G97 S100"},
    GCode{980, Group::return_level, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_return_level, true>,
          "cycles end at the level they were called at", Origin::iso, "0.2", "G98"},
    GCode{990, Group::return_level, AxisWords::move,
          run<&BlockHandlers::modal, &ModalCodes::set_return_level, false>, "cycles end at R", Origin::iso,
          "0.2", "G99"},
    GCode{1590, Group::one_block, AxisWords::taken, run<&BlockHandlers::positioning, &Positioning::home>,
          "as G28.2; a letter alone names an axis", Origin::num, "0.3", "G159 X Z"},
    GCode{1870, Group::smoothing, AxisWords::move, run<&BlockHandlers::modal, &ModalCodes::set_finish>,
          "machining mode: P1 default, P2 as G5.1 Q2, P3 as G5.1 Q1; E mm off the corners at most; without P "
          "or E that of the machine",
          Origin::haas, "0.3", "G187 P3 E0.01"},
};

/// A code of other controls, and what does its work here.
struct RefusedCode {
  std::uint16_t tenths;
  const char* remedy;
};

constexpr std::array refused_codes = {
    RefusedCode{431, "write G43.4 H, or G43 H in a tilted plane"},
    RefusedCode{542, "write G43.4 H: the zero turns with the table"},
};

constexpr std::uint8_t no_code = 0xff;
constexpr std::size_t g_numbers = 1900;  // tenths below it can be codes
static_assert(rows.back().tenths < g_numbers && rows.size() < no_code);
constexpr auto g_index = [] {
  std::array<std::uint8_t, g_numbers> index{};
  index.fill(no_code);
  for (std::size_t i = 0; i < rows.size(); ++i) index[rows[i].tenths] = static_cast<std::uint8_t>(i);
  return index;
}();

}  // namespace

constinit const std::span<const GCode> g_codes = rows;

const GCode* g_code(std::uint32_t tenths) {
  if (tenths >= g_index.size() || g_index[tenths] == no_code) return nullptr;
  return &rows[g_index[tenths]];
}

const char* g_remedy(std::uint32_t tenths) {
  for (const RefusedCode& code : refused_codes) {
    if (code.tenths == tenths) return code.remedy;
  }
  return nullptr;
}

}  // namespace trunnion::language
