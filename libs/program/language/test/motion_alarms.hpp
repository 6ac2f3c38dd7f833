// SPDX-License-Identifier: Apache-2.0
// Programs that are wrong in their motion, and the alarm each of them gives.
#pragma once

#include <string>
#include <vector>

#include "test_machine.hpp"

namespace trunnion::language::test {

struct WrongMotion {
  AlarmNumber number;
  std::string program;
  unsigned line;
  unsigned column;
  std::string word;  ///< as the text ends
};

inline std::vector<WrongMotion> wrong_motion() {
  using enum AlarmNumber;
  std::string many_tools;
  for (int i = 1; i <= 201; ++i) many_tools += "G10 L10 P" + std::to_string(i) + " R1\n";
  std::string standing = "G41 D1 G1 X10 F1\nX30\n";
  for (int i = 0; i < 64; ++i) standing += "M8\n";
  const std::string tilt = "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J10 K0\n";
  return {
      {codes_compete, "G52 X1 G51 P2", 1, 8, ": G51"},
      {codes_compete, "G28 G51.1 X0", 1, 5, ": G51.1"},
      {surface_speed_missing, "G96", 1, 1, ": G96"},
      {surface_speed_missing, "G96 S0", 1, 1, ": G96"},
      {tool_vector_zero, "G43.5 H1\nG1 F1 I0 J0 K0", 2, 13, ": K0"},
      {tool_vector_opposite, "G43.5 H1\nG0 K-1", 2, 4, ": K-1"},
      {orientation_impossible, "G43.4 H1\nG68.2 X0 Y0 Z0 I90 J120 K-90\nG53.2", 3, 1,
       ": G53.2, nearest I0.984808 J0.000000 K-0.173648"},
      {orientation_travel, "G43.4 H1\nG68.2 X0 Y0 Z0 I90 J99 K-90\nG53.1", 3, 1, ": G53.1"},
      {tool_vector_travel, "G43.5 H1\nG1 F1 J-1", 2, 7, ": J-1"},
      {tool_vector_travel, "G43.5 H1\nG0 X9001 I1 K1", 2, 13, ": K1, X would go to 9001.0000"},
      {tool_vector_pole, "G43.5 H1\nG1 F1 I0.001 K1", 2, 14, ": K1"},
      {tool_vector_needed, "G43.5 H1\nG2 X1 I1 C5 F1", 2, 10, ": C5"},
      {arc_centre_missing, "G43.5 H1\nG2 X1 F1", 2, 4, ": X1"},
      {orientation_impossible, "G43.5 H1\nG1 F1 I0.1 K-1", 2, 12, ": K-1"},
      {tool_vector_opposite, "G43.5 H1\nG1 F1 I1\nI-1", 3, 1, ": I-1"},
      {tool_vector_between, "G43.5 H1\nG1 F1 J1\nI1 K-0.1", 3, 4, ": K-0.1"},
      {tool_vector_needed, "G43.5 H1\nG0 A1", 2, 4, ": A1"},
      {parameter_line, "G10 L50\nG0 X1", 2, 1, ": G0"},
      {parameter_line, "G10 L50\nN1", 2, 1, ": N1"},
      {arc_scaled_unequally, "G51 X0 Y0 Z0 I2\nG2 X1 R1 F1", 2, 7, ": R1"},
      {corner_without_move, "G1 X9 ,C1 F1\nM8", 2, 1, ": M8"},
      {corner_too_large, "G1 X9 ,R5 F1\nY4", 2, 1, ": Y4, 5 mm in line 1, moves 9 and 4 mm"},
      {corner_chamfer_arc, "G1 X9 ,C1 F1\nG2 X12 R3", 2, 1, ": G2, 1 mm in line 1, moves 9 and 3.142 mm"},
      {reference_missed, "G27 X5", 1, 5, ": X5, X would be at 5.0000, not at 0.0000"},
      {reference_missed, "G43 H1\nG27 Z0", 2, 5, ": Z0, Z would be at 50.0000, not at 0.0000"},
      {missing_word, "G27", 1, 1, ": G27, needs an axis"},
      {missing_word, "G54.4", 1, 1, ": G54.4, needs P"},
      {value_range, "G54.4 P8", 1, 7, ": P8"},
      {compensation_active, "G41 D1\nG54.4 P1", 2, 1, ": G54.4"},
      {missing_word, "G10 L23 P1", 1, 1, ": G10, needs X, Y, Z, A, B or C"},
      {value_range, "G10 L23 P0 X1", 1, 9, ": P0"},
      {machine_coordinates_rtcp, "G43.4 H1\nG27 X0", 2, 1, ": G27"},
      {compensation_active, "G41 D1\nG27 X0", 2, 1, ": G27"},
      {offset_move, "G2 G45 X1 D1", 1, 4, ": G45"},
      {frame_shift, "G68 X0 Y0 R10\nG46 G0 X1 D1", 2, 1, ": G46"},
      {compensation_active, "G41 D1\nG47 G0 X1", 2, 1, ": G47"},
      {radius_undefined, "G48 G0 X1 D7", 1, 11, ": D7"},
      {feed_missing, "G45 G1 X1 D1", 1, 1, ": G45"},
      {missing_word, "G45 G0 D1", 1, 1, ": G45, needs an axis"},
      {missing_word, "G22 X1", 1, 1, ": G22, needs I"},
      {missing_word, "G22 K1", 1, 1, ": G22, needs Z"},
      {missing_word, "G22", 1, 1, ": G22, needs X I, Y J or Z K"},
      {value_range, "G22 X1 I1", 1, 5, ": X1, the zone has no extent"},
      {unused_word, "G22 X1 I0 A5", 1, 11, ": A5"},
      {group_twice, "G22 G23", 1, 5, ": G23"},
      {angle_undetermined, "G1 X1 ,A90 F1", 1, 7, ": ,A90, it never reaches the coordinate"},
      {angle_open, "G1 ,A9 F1\nX1 Y2", 2, 1, ": X1"},
      {curve_incomplete, "G6.2 P2 K0 F1\nG0 X1", 2, 1, ": G0"},
      {curve_incomplete, "G6.2 P2 K0 F1\nK0 X1", 3, 1, ""},
      {curve_start, "G6.2 P2 K0 X5 F1", 1, 1, ": G6.2"},
      {curve_knots, "G6.2 P2 K0 F1\nK1 X1", 2, 1, ": K1"},
      {curve_knots, "G6.2 P2 K0 F1\nK0 X1\nK-1 X2", 3, 1, ": K-1"},
      {curve_words, "G6.2 P2 K0 F1\nX1", 2, 1, ": X1"},
      {curve_control_points, "G6.2 P3 K0 F1\nK0", 2, 1, ": K0"},
      {value_range, "G6.2 P5 K0 F1", 1, 6, ": P5"},
      {value_range, "G6.2 P2 K0 R0 F1", 1, 12, ": R0"},
      {reference_undefined, "G30 P3 X1", 1, 5, ": P3"},
      {intermediate_missing, "G29 X1", 1, 1, ": G29"},
      {tool_undefined, "G10 L11 P77 R1", 1, 9, ": P77"},
      {too_many_tools_changed, many_tools, 201, 9, ": P201"},
      {tip_control_needed, "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.2", 2, 1, ": G53.2"},
      {tip_control_needed, "G53.3 L1 F1", 1, 1, ": G53.3"},
      {cycle_depth_missing, "G81 X1 Z-1 F1", 1, 1, ": G81"},
      {cycle_depth_missing, "G81 X1 R1 F1", 1, 1, ": G81"},
      {cycle_peck_missing, "G83 X1 Z-1 R1 F1", 1, 1, ": G83"},
      {cycle_peck_missing, "G83 X1 Z-1 R1 Q0 F1", 1, 15, ": Q0"},
      {cycle_inverse_time, "G93 G81 X1 Z-1 R1 F1", 1, 5, ": G81"},
      {cycle_lead_missing, "G84 X1 Z-1 R1 F1", 1, 1, ": G84"},
      {cycle_lead_missing, "S100 G84 X1 Z-1 R1", 1, 6, ": G84"},
      {feed_missing, "G81 X1 Z-1 R1", 1, 1, ": G81"},
      {cycle_repeats, "G81 X1 Z-1 R1 K2 L2 F1", 1, 18, ": L2"},
      {cycle_repeats, "G16 G81 Z-1 R1 L0 F1\nG91 X1 Y10 L2", 2, 5, ": X1"},
      {cycle_return_level, "G99 G87 X1 Z-1 R-5 Q1 F1", 1, 5, ": G87"},
      {cycle_shift_missing, "G76 X1 Z-1 R1 F1", 1, 1, ": G76"},
      {cycle_level_side, "G0 Z5\nG81 X1 Z-1 R-2 F1", 2, 12, ": R-2, R -2.000 mm, depth -1.000 mm"},
      {tap_removal_axis, "S200 G84.9 X1 Z12 K1.25", 1, 6, ": G84.9"},
      {tap_removal_axis, "S200 G84.9 A12 K1.25", 1, 6, ": G84.9"},
      {tap_removal_axis, "S200 G84.9 Y1 Z12 K1.25", 1, 6, ": G84.9"},
      {tap_removal_axis, "G51.1 Z0\nS200 G84.9 Z12 K1.25", 2, 6, ": G84.9"},
      {tap_removal_lead, "G84.9 Z12 K1.25", 1, 1, ": G84.9"},
      {tap_removal_lead, "S200 G84.9 Z12 K0", 1, 16, ": K0"},
      {tap_removal_spindle, "S200 M3 G84.9 Z12 K1.25", 1, 9, ": G84.9"},
      {tap_removal_direction, "S200 G84.9 Z-12 K1.25", 1, 6, ": G84.9"},
      {missing_word, "S200 G84.9 Z12", 1, 6, ": G84.9, needs K"},
      {missing_word, "S200 G84.9 K1.25", 1, 6, ": G84.9, needs an axis"},
      {pattern_without_cycle, "G70 X0 Y0 I1 J0 K4", 1, 1, ": G70"},
      {value_range, "G81 Z-1 R1 L0 F1\nG78 X0 Y0 I1 J0 K-4", 2, 17, ": K-4"},
      {value_range, "G81 Z-1 R1 L0 F1\nG70 X0 Y0 I1 J0 K0", 2, 17, ": K0"},
      {missing_word, "G81 Z-1 R1 L0 F1\nG71 X0 Y0 I1 J0 K4", 2, 1, ": G71, needs P"},
      {radius_undefined, "G41 D7", 1, 5, ": D7"},
      {compensation_start, "G41 D1\nG2 X10 R10 F1", 2, 1, ": G2"},
      {compensation_radius, "G41 D1 G1 X10 F1\nG3 X14 I2", 2, 1, ": G3"},
      // The step of 3 between two left turns is shorter than the tool of radius 5 is wide.
      {compensation_unresolved, "G41 D1 G1 X10 F1\nX30\nY3\nX0", 4, 1, ": X0"},
      // The first wall is cut by the third.
      {compensation_interference, "G41 D1 G1 X1 F1\nX30\nY20\nX1 Y1\nG40 X-20", 2, 1, ", that of line 4"},
      {compensation_look_ahead, standing, 66, 1, ": M8"},
      {compensation_active, "G41 D1\nG28 X1", 2, 1, ": G28"},
      {compensation_active, "G41 D1\nG18", 2, 1, ": G18"},
      {compensation_active, "G41 D1\nG55", 2, 1, ": G55"},
      {compensation_active, "G41 D1\nG43 H1", 2, 1, ": G43"},
      {compensation_active, "G41 D1\nG81 X1 Z-1 R1 F1", 2, 1, ": G81"},
      {compensation_active, "G41 D1\nG92 X1", 2, 1, ": G92"},
      {compensation_rotary, "G43.5 H1\nG41 D1\nG1 X5 I1 K1 F1", 3, 1, ": G1"},
      {compensation_rotary, "G43.4 H1\nG41 D1 G1 X10 F1 A5", 2, 1, ": G41"},
      {factor_range, "G51 P0", 1, 5, ": P0"},
      {factor_range, "G51 I2 J0", 1, 8, ": J0"},
      {missing_word, "G51 X1", 1, 1, ": G51, needs P"},
      {missing_word, "G68 X1 Y1", 1, 1, ": G68, needs R"},
      {frame_plane, "G68 X0 Y0 R10\nG18", 2, 1, ": G18"},
      {frame_shift, "G68 X0 Y0 R10\nG92 X0", 2, 1, ": G92"},
      {tilt_points, "G43.4 H1\nG68.1 Q5", 2, 7, ": Q5"},
      {missing_word, "G43.4 H1\nG68.2 X0 Y0 Z0 I0 J0", 2, 1, ": G68.2, needs K"},
      {tilt_missing, "G43.4 H1\nG68.4 X0 Y0 Z0 I0 J10 K0", 2, 1, ": G68.4"},
      {missing_word, tilt + "G68.4 X0 Y0 Z0 I0 J0", 3, 1, ": G68.4, needs K"},
      {tilt_swing_missing, tilt + "G68.4 X0 Y0 Z0 I0 J5 K0\nG0 X1", 4, 1, ": G0"},
      {tilt_swing_missing, tilt + "G0 X1", 3, 1, ": G0"},
      {tilt_swing_missing, tilt + "G53.1 X1", 3, 1, ": G53.1"},
      {tilt_swing_missing, tilt + "M30", 3, 1, ": M30"},
      {tilt_swing_missing, tilt, 3, 1, ""},
      {tilt_swing_misplaced, "G53.1", 1, 1, ": G53.1"},
      {tilt_swing_misplaced, "G43.4 H1\nG53.2", 2, 1, ": G53.2"},
      {tilt_active, tilt + "G53.2\nG49", 4, 1, ": G49"},
      {plane_rotary, "G68.2 X0 Y0 Z0 I0 J10 K0\nG53.1\nG0 C10", 3, 1, ": G0"},
      {value_range, "G54.1 P49", 1, 7, ": P49, this control has P1 to P48"},
      {value_range, "G92.1 X1", 1, 7, ": X1"},
      {missing_word, "G54.1", 1, 1, ": G54.1, needs P"},
      {value_range, "G10 L2 P7 X1", 1, 8, ": P7"},
      {value_range, "G10 L30 P1 R1", 1, 5, ": L30"},
      {value_range, "G5.1 Q4", 1, 6, ": Q4"},
      {missing_word, "G92", 1, 1, ": G92, needs an axis or S"},
      {thread_lead_missing, "S100 M3\nG33 Z-5", 2, 5, ": Z-5"},
      {thread_lead_missing, "S100 M3\nG33 F0 Z-5", 2, 5, ": F0"},
      {thread_lead_missing, "F100 S100 M3\nG33 Z-5", 2, 5, ": Z-5"},  // a feed is no lead
      {thread_spindle_stopped, "S100\nG33 Z-5 F1", 2, 5, ": Z-5"},
      {thread_spindle_stopped, "M3\nG33 Z-5 F1", 2, 5, ": Z-5"},
      {thread_spindle_stopped, "S100 M3\nG33 Z-5 F1\nM5\nZ-9", 4, 1, ": Z-9"},
      // 2 mm at 1901 1/min; X goes a fifth of the way. 95 % of 4000.
      {thread_speed, "S1901 M3\nG33 X1 Z-5 F2", 2, 5, ": X1, Z 3802 mm/min, at most 3800"},
      {thread_impossible, "S100 M3 G43.4 H1\nG33 Z-5 F1", 2, 5, ": Z-5, tool tip control is active"},
      {thread_impossible, "S100 M3\nG33 Z-5 C9 F1", 2, 9, ": C9, a rotary axis moves"},
      {thread_impossible, "S100 M3\nG41 D1\nG33 Z-5 F1", 3, 5, ": Z-5, cutter compensation is active"},
      {thread_impossible, "S100 M3 G93\nG33 Z-5 F1", 2, 5, ": Z-5, G93 is active"},
      {thread_impossible, "G96 S100 M3\nG33 Z-5 F1", 2, 5, ": Z-5, G96 is active"},
      // The square of the lead is 1 - 2 * 0.1 * 5 at the end.
      {thread_lead_change, "S100 M3\nG34 Z-5 F1 K-0.1", 2, 5, ": Z-5"},
      {missing_word, "S100 M3\nG34 Z-5 F1", 2, 5, ": Z-5, needs K"},
      {value_range, "S100 M3\nG33 Z-5 F1 Q360", 2, 12, ": Q360, degrees, from 0 to below 360"},
      {unused_word, "S100 M3\nG33 Z-5 F1 K1", 2, 12, ": K1"},
      {group_twice, "G33 G34 Z1", 1, 5, ": G34"},
      {group_twice, "G54 G55", 1, 5, ": G55"},
      {group_twice, "G41 G40", 1, 5, ": G40"},
  };
}

}  // namespace trunnion::language::test
