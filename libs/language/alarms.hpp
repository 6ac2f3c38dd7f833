// SPDX-License-Identifier: Apache-2.0
// Alarms of the language room: numbers 1000..1999, each with one text, all of them here.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace trunnion::language {

enum class AlarmNumber : std::uint16_t {
  none = 0,
  line_too_long = 1001,
  not_utf8 = 1002,
  unknown_character = 1003,
  open_comment = 1004,
  number_missing = 1005,
  number_range = 1006,
  letter_twice = 1007,
  too_many_codes = 1008,
  misplaced_head = 1009,
  text_unreadable = 1010,
  unknown_instruction = 1011,
  statement_not_first = 1012,
  text_behind_statement = 1013,
  too_many_centres = 1014,
  argument_kind = 1015,
  too_many_arguments = 1016,
  unknown_g = 1101,
  group_twice = 1103,
  unknown_m = 1104,
  not_an_integer = 1105,
  value_range = 1106,
  unused_word = 1107,
  missing_word = 1108,
  axis_absent = 1109,
  feed_missing = 1111,
  feed_not_positive = 1112,
  codes_compete = 1113,
  surface_speed_missing = 1114,
  tool_vector_zero = 1115,
  orientation_impossible = 1116,
  tool_vector_needed = 1117,
  parameter_line = 1118,
  not_resumable = 1119,
  tool_vector_opposite = 1120,
  tool_vector_between = 1121,
  orientation_travel = 1122,
  tool_vector_travel = 1123,
  tool_vector_pole = 1124,
  tapping_spindle_missing = 1125,
  spindle_speed_above = 1126,
  dwell_point = 1127,
  arc_centre_missing = 1201,
  arc_centre_and_radius = 1202,
  arc_radius_zero = 1203,
  arc_radii_differ = 1204,
  arc_radius_too_small = 1205,
  arc_full_with_radius = 1206,
  arc_scaled_unequally = 1207,
  corner_without_move = 1208,
  corner_too_large = 1209,
  corner_chamfer_arc = 1210,
  curve_incomplete = 1251,
  curve_start = 1252,
  curve_knots = 1253,
  curve_words = 1254,
  curve_control_points = 1255,
  machine_coordinates_motion = 1301,
  machine_coordinates_rtcp = 1302,
  tool_length_unknown = 1303,
  reference_undefined = 1304,
  intermediate_missing = 1305,
  tool_undefined = 1306,
  too_many_tools_changed = 1307,
  tip_control_needed = 1308,
  subprogram_missing = 1401,
  nesting_too_deep = 1402,
  subprogram_without_end = 1403,
  end_without_begin = 1404,
  begin_without_end = 1405,
  structure_too_deep = 1406,
  label_missing = 1407,
  jump_into_structure = 1408,
  call_not_alone = 1409,
  program_alarm = 1501,
  operand_missing = 1502,
  bracket_open = 1503,
  brackets_too_deep = 1504,
  division_by_zero = 1505,
  function_domain = 1506,
  result_too_large = 1507,
  bits_of_fraction = 1508,
  variable_unknown = 1509,
  variable_read_only = 1510,
  variable_value = 1511,
  cycle_depth_missing = 1601,
  cycle_peck_missing = 1602,
  cycle_inverse_time = 1603,
  cycle_lead_missing = 1604,
  cycle_repeats = 1605,
  cycle_return_level = 1606,
  cycle_shift_missing = 1607,
  pattern_without_cycle = 1608,
  cycle_level_side = 1609,
  radius_undefined = 1701,
  compensation_start = 1702,
  compensation_radius = 1703,
  compensation_unresolved = 1704,
  compensation_interference = 1705,
  compensation_look_ahead = 1706,
  compensation_active = 1707,
  compensation_rotary = 1708,
  tool_unknown = 1709,
  factor_range = 1801,
  frame_plane = 1802,
  frame_shift = 1803,
  tilt_points = 1804,
  tilt_swing_missing = 1805,
  tilt_swing_misplaced = 1806,
  tilt_active = 1807,
  plane_rotary = 1808,
};

struct AlarmText {
  AlarmNumber number;
  std::string_view text;
};

/// The texts. The word at fault is appended after a colon.
inline constexpr std::array alarm_texts = {
    AlarmText{AlarmNumber::line_too_long, "line longer than 16384 bytes"},
    AlarmText{AlarmNumber::not_utf8, "text outside comments is not valid UTF-8"},
    AlarmText{AlarmNumber::unknown_character, "character has no meaning outside a comment"},
    AlarmText{AlarmNumber::open_comment, "comment is not closed in its line"},
    AlarmText{AlarmNumber::number_missing, "letter without a number"},
    AlarmText{AlarmNumber::number_range, "number too large: at most 999999999"},
    AlarmText{AlarmNumber::letter_twice, "letter twice in one block"},
    AlarmText{AlarmNumber::too_many_codes, "too many codes in one block: at most 12 G and 8 M"},
    AlarmText{AlarmNumber::misplaced_head, "program number or block skip only at the start of a line"},
    AlarmText{AlarmNumber::text_unreadable, "program text cannot be read"},
    AlarmText{AlarmNumber::unknown_instruction, "unknown instruction, or a letter without a number"},
    AlarmText{AlarmNumber::statement_not_first, "assignment or instruction only at the start of a block"},
    AlarmText{AlarmNumber::text_behind_statement, "text behind an assignment or instruction"},
    AlarmText{AlarmNumber::too_many_centres, "more than ten times I, J or K in a macro call"},
    AlarmText{AlarmNumber::argument_kind, "a number where the cycle takes a text, or a text for a number"},
    AlarmText{AlarmNumber::too_many_arguments, "more arguments than the cycle takes"},
    AlarmText{AlarmNumber::unknown_g, "unknown G code"},
    AlarmText{AlarmNumber::group_twice, "second code of the same group in one block"},
    AlarmText{AlarmNumber::unknown_m, "M code that the machine does not have (parameters 04c944 to 04c949)"},
    AlarmText{AlarmNumber::not_an_integer, "word needs a whole number"},
    AlarmText{AlarmNumber::value_range, "value of the word is out of range"},
    AlarmText{AlarmNumber::unused_word, "word has no meaning in this block"},
    AlarmText{AlarmNumber::missing_word, "code lacks a word it needs"},
    AlarmText{AlarmNumber::axis_absent, "channel does not have this axis"},
    AlarmText{AlarmNumber::feed_missing, "motion at feed without F"},
    AlarmText{AlarmNumber::feed_not_positive, "feed must be above zero"},
    AlarmText{AlarmNumber::codes_compete, "two codes of the block want the same words"},
    AlarmText{AlarmNumber::surface_speed_missing, "G96 without a surface speed S"},
    AlarmText{AlarmNumber::tool_vector_zero, "tool vector I J K has no length"},
    AlarmText{AlarmNumber::orientation_impossible, "no rotary angles give this tool direction"},
    AlarmText{AlarmNumber::tool_vector_needed, "rotary words are not allowed with G43.5: I J K"},
    AlarmText{AlarmNumber::parameter_line, "line of the parameter input G10 L50 takes N P R or G11 only"},
    AlarmText{AlarmNumber::not_resumable,
              "an interrupted rigid tapping, or a program behind lost skip moves, cannot be resumed: reset"},
    AlarmText{AlarmNumber::tapping_spindle_missing, "rigid tapping without a spindle on this machine"},
    AlarmText{AlarmNumber::spindle_speed_above, "speed above the highest of the spindle"},
    AlarmText{AlarmNumber::dwell_point,
              "decimal point in the P of a dwell: whole milliseconds, or set parameter 04c918"},
    AlarmText{AlarmNumber::tool_vector_opposite,
              "tool vector is opposite to the one before: no shortest way"},
    AlarmText{AlarmNumber::tool_vector_between,
              "tool cannot be led to this direction: out of reach on the way"},
    AlarmText{AlarmNumber::orientation_travel, "tool direction is beyond the travel of a rotary axis"},
    AlarmText{AlarmNumber::tool_vector_travel, "axis would leave its travel while the tool is led"},
    AlarmText{AlarmNumber::tool_vector_pole, "tool would come too near to a pole of the rotary axes"},
    AlarmText{AlarmNumber::arc_centre_missing, "circle without centre or radius"},
    AlarmText{AlarmNumber::arc_centre_and_radius, "circle with both centre and radius"},
    AlarmText{AlarmNumber::arc_radius_zero, "circle with radius zero"},
    AlarmText{AlarmNumber::arc_radii_differ, "radii of the start and the end of the circle differ too much"},
    AlarmText{AlarmNumber::arc_radius_too_small, "radius too small to reach the end of the circle"},
    AlarmText{AlarmNumber::arc_full_with_radius, "circle with R must end elsewhere than it starts"},
    AlarmText{AlarmNumber::arc_scaled_unequally, "circle while its axes are scaled differently"},
    AlarmText{AlarmNumber::corner_without_move,
              "chamfer ,C or rounding ,R is not followed by a move at feed in the same plane"},
    AlarmText{AlarmNumber::corner_too_large, "chamfer ,C or rounding ,R does not fit between its moves"},
    AlarmText{AlarmNumber::corner_chamfer_arc, "chamfer ,C beside a circle: use a rounding ,R"},
    AlarmText{AlarmNumber::curve_incomplete, "curve G6.2 ends without its last knots"},
    AlarmText{AlarmNumber::curve_start, "curve G6.2 must begin at the position"},
    AlarmText{AlarmNumber::curve_knots,
              "knots must not fall, and the first and last must repeat as often as the order"},
    AlarmText{AlarmNumber::curve_words, "block of a curve needs K, with X Y Z R or alone"},
    AlarmText{AlarmNumber::curve_control_points, "curve has fewer control points than its order"},
    AlarmText{AlarmNumber::machine_coordinates_motion, "machine coordinates need G0 or G1"},
    AlarmText{AlarmNumber::machine_coordinates_rtcp,
              "not allowed while tool tip control or a tilted plane is active"},
    AlarmText{AlarmNumber::tool_length_unknown, "tool length is not in the table"},
    AlarmText{AlarmNumber::reference_undefined, "reference position is not defined"},
    AlarmText{AlarmNumber::intermediate_missing, "G29 without G28 or G30 before"},
    AlarmText{AlarmNumber::tool_undefined, "tool is not in the table"},
    AlarmText{AlarmNumber::too_many_tools_changed, "program changes more than 200 tools"},
    AlarmText{AlarmNumber::tip_control_needed, "needs tool tip control G43.4 or G43.5"},
    AlarmText{AlarmNumber::subprogram_missing, "subprogram not found"},
    AlarmText{AlarmNumber::nesting_too_deep, "subprograms nested deeper than 8"},
    AlarmText{AlarmNumber::subprogram_without_end, "subprogram ends without M99"},
    AlarmText{AlarmNumber::end_without_begin, "ELSE, ENDIF, ENDW or END without its beginning"},
    AlarmText{AlarmNumber::begin_without_end, "IF, WHILE or DO without its end in this program"},
    AlarmText{AlarmNumber::structure_too_deep, "IF, WHILE and DO nested deeper than 16"},
    AlarmText{AlarmNumber::label_missing, "sequence number not found in this program"},
    AlarmText{AlarmNumber::jump_into_structure, "jump into an IF, WHILE or DO"},
    AlarmText{AlarmNumber::call_not_alone, "macro or cycle call beside another G or M code"},
    AlarmText{AlarmNumber::program_alarm, "alarm of the program"},
    AlarmText{AlarmNumber::operand_missing, "number, variable, bracket or function expected"},
    AlarmText{AlarmNumber::bracket_open, "bracket is not closed"},
    AlarmText{AlarmNumber::brackets_too_deep, "brackets nested deeper than 32"},
    AlarmText{AlarmNumber::division_by_zero, "division by zero"},
    AlarmText{AlarmNumber::function_domain, "argument outside the domain of the function"},
    AlarmText{AlarmNumber::result_too_large, "result is too large"},
    AlarmText{AlarmNumber::bits_of_fraction, "AND, OR and XOR need whole numbers"},
    AlarmText{AlarmNumber::variable_unknown, "variable does not exist"},
    AlarmText{AlarmNumber::variable_read_only, "variable cannot be written"},
    AlarmText{AlarmNumber::variable_value, "value is not allowed in this variable"},
    AlarmText{AlarmNumber::cycle_depth_missing, "cycle without depth or R level"},
    AlarmText{AlarmNumber::cycle_peck_missing, "cycle needs Q of at least 0.001 mm"},
    AlarmText{AlarmNumber::cycle_inverse_time, "cycle is not possible with G93"},
    AlarmText{AlarmNumber::cycle_lead_missing, "tapping needs F and S"},
    AlarmText{AlarmNumber::cycle_repeats,
              "repetitions: K or L, not both, and not of an incremental polar radius"},
    AlarmText{AlarmNumber::cycle_return_level, "back boring G87 needs G98"},
    AlarmText{AlarmNumber::cycle_shift_missing, "boring needs a shift: Q, or I J"},
    AlarmText{AlarmNumber::pattern_without_cycle, "hole pattern without an active cycle"},
    AlarmText{AlarmNumber::cycle_level_side,
              "R level is at the depth or behind it, where the tool would go in rapid"},
    AlarmText{AlarmNumber::radius_undefined, "tool radius D is not in the table"},
    AlarmText{AlarmNumber::compensation_start, "compensation must begin and end with a straight line"},
    AlarmText{AlarmNumber::compensation_radius, "inside arc is not larger than the tool radius"},
    AlarmText{AlarmNumber::compensation_unresolved, "tool does not fit between two moves"},
    AlarmText{AlarmNumber::compensation_interference, "tool would cut into the contour nearby"},
    AlarmText{AlarmNumber::compensation_look_ahead, "too many blocks without a move in the plane"},
    AlarmText{AlarmNumber::compensation_active, "not possible while cutter radius compensation is active"},
    AlarmText{AlarmNumber::compensation_rotary,
              "rotary axes cannot move with compensation and tool tip control"},
    AlarmText{AlarmNumber::tool_unknown, "tool is not in the tool table"},
    AlarmText{AlarmNumber::factor_range, "scaling factor must be 0.001 to 1000 (its unit: 040916)"},
    AlarmText{AlarmNumber::frame_plane, "plane cannot change while rotation or polar coordinates are active"},
    AlarmText{AlarmNumber::frame_shift, "not possible while G16 G51 G51.1 G68 or a tilted plane is active"},
    AlarmText{AlarmNumber::tilt_points, "tilted plane is not defined: three points not on a line"},
    AlarmText{AlarmNumber::tilt_swing_missing, "block behind G68.1 G68.2 G68.3 must be G53.1 or G53.2 alone"},
    AlarmText{AlarmNumber::tilt_swing_misplaced,
              "G53.1 and G53.2 must be alone in the block behind G68.1 G68.2 G68.3"},
    AlarmText{AlarmNumber::tilt_active, "not possible while a tilted plane is active"},
    AlarmText{AlarmNumber::plane_rotary,
              "rotary axes turn in a tilted plane only with tool tip control G43.4 or G43.5"},
};

constexpr std::string_view alarm_text(AlarmNumber number) {
  for (const AlarmText& entry : alarm_texts) {
    if (entry.number == number) return entry.text;
  }
  return "";
}

/// A fault inside one line, before the line's text is looked up.
struct Fault {
  AlarmNumber number = AlarmNumber::none;
  std::uint16_t offset = 0;      ///< byte of the line, from 0
  const char* detail = nullptr;  ///< static text that ends the message, at most 48 characters
  explicit operator bool() const { return number != AlarmNumber::none; }
};

/// The detail of a missing word: "needs P". `letter` is A to Z.
const char* needs(char letter);

/// Subprograms, macros and cycles inside each other.
inline constexpr std::size_t max_nesting = 8;

/// A place in a text: a call that led to an alarm.
struct CallSite {
  std::uint32_t program = 0;  ///< as Command::program
  std::uint32_t line = 0;     ///< from 1
};

/// An alarm with its place. The caller knows the file name and formats `file:line:column: text`.
struct Alarm {
  AlarmNumber number = AlarmNumber::none;
  std::uint32_t program = 0;                  ///< as Command::program
  std::uint32_t line = 0;                     ///< from 1
  std::uint32_t column = 0;                   ///< in characters (code points) from 1
  std::array<char, 192> text{};               ///< what is wrong and the word at fault, ends with a zero
  std::uint8_t calls = 0;                     ///< how many calls led here
  std::array<CallSite, max_nesting> chain{};  ///< their places, the main program's first
};

/// Composes the alarm for a fault in `line_text`, which may be empty when the line is not at hand. The
/// fault's detail, or else `detail` (at most 48 printable characters) ends the text.
Alarm make_alarm(const Fault& fault, std::string_view line_text, std::uint32_t program, std::uint32_t line,
                 std::string_view detail = {});

}  // namespace trunnion::language
