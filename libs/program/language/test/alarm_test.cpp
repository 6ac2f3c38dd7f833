// SPDX-License-Identifier: Apache-2.0
// Every alarm, with the place it points at.
#include <gtest/gtest.h>

#include <set>

#include "motion_alarms.hpp"

namespace trunnion::language::test {
namespace {

using Wrong = WrongMotion;

std::string repeated(std::string_view part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

std::vector<Wrong> wrong_programs() {
  using enum AlarmNumber;
  const std::string deep = [] {
    std::string text = "M98 P1\nM30\n";
    for (int i = 1; i <= 9; ++i) {
      text += "O" + std::to_string(i) + "\nM98 P" + std::to_string(i + 1) + "\nM99\n";
    }
    return text;
  }();
  std::vector<Wrong> wrong = {
      {line_too_long, "G0\n" + std::string(16385, ' ') + "\n", 2, 1, ""},
      {not_utf8, "G0 X1 (\xc3\xa4)\xff", 1, 10, ""},
      {not_utf8, "\xed\xa0\x80", 1, 1, ""},  // a surrogate
      {unknown_character, "G0 X1 @5", 1, 7, ": @"},
      {unknown_character, "(\xe5\x8f\xb0) \xe5\x8f\xb0", 1, 5, ": \xe5\x8f\xb0"},
      {unknown_character, std::string("G0\0X1", 5), 1, 3, ": ?"},
      {unknown_character, "G0 X1 )", 1, 7, ": )"},
      {unknown_character, "$SC_PARTS=0", 1, 1, ": $, variables of SINUMERIK are not known"},
      {foreign_word, "$P_UIFR[1]=CTRANS(X,150)", 1, 1, ": $, Siemens: write #_"},
      {foreign_word, "T=\"3D_PROBE\"", 1, 1, ": T, Siemens: write T_"},
      {unknown_character, "X5 5", 1, 4, ": 5, a letter is missing before the number"},
      {unknown_character, "N10 21 G40", 1, 5, ": 21, a letter is missing before the number"},
      {unknown_character, "01000\nG0 X1", 1, 1, ": 01000, is the first 0 meant as the letter O?"},
      {open_comment, "G0\r\nX1 (open\nX2)", 2, 4, ": ("},
      {number_missing, "G0 X Y1", 1, 4, ": X"},
      {number_missing, "G0 X-", 1, 4, ": X-"},
      {number_missing, "DO #1", 1, 1, ": DO"},
      {number_missing, "WHILE 1 DO1\nEND", 2, 1, ": END"},
      {number_missing, "N#1 G0", 1, 1, ": N"},
      {number_missing, "O\n", 1, 1, ": O"},
      {number_range, "G0 X1234567890", 1, 4, ": X1234567890"},
      {number_range, "O1234567890", 1, 1, ": O1234567890"},
      {letter_twice, "G0 X1 Y1 X2", 1, 10, ": X2"},
      {too_many_codes, "M10 M11 M12 M13 M14 M15 M16 M17 M18", 1, 33, ": M18"},
      {too_many_codes, repeated("G0", 21), 1, 41, ": G0"},
      {misplaced_head, "G0 O1234", 1, 4, ": O1234"},
      {misplaced_head, "G0 X#1/2 Y1", 1, 7, ": /"},
      {misplaced_head, "G0 X[#1]/2 Y1", 1, 9, ": /"},
      {misplaced_head, "G0 X1 /2 (c)", 1, 7, ": /"},
      {misplaced_head, "//3 X1", 1, 2, ": /, comments are in ( ) or behind ;"},
      {misplaced_head, "G90 // MEAN", 1, 6, ": /, comments are in ( ) or behind ;"},
      {misplaced_head, "/1/ X1", 1, 3, ": /"},
      {misplaced_head, "N1 :1234", 1, 4, ": :"},
      {misplaced_head, "/N1/G0", 1, 4, ": /"},
      {misplaced_head, "N1//G0", 1, 4, ": /, comments are in ( ) or behind ;"},
      {misplaced_head, "G0 %", 1, 4, ": %"},
      {unknown_g, "G0 X1\nG77 X2", 2, 1, ": G77"},
      {unknown_g, "G43.45", 1, 1, ": G43.45"},
      {unknown_g, "G-1", 1, 1, ": G-1"},
      {unknown_g, "G100000000", 1, 1, ": G100000000"},
      {foreign_word, "G12.1", 1, 1, ": G12.1, Fanuc: not on this control yet"},
      {foreign_word, "G0 X1 G112", 1, 7, ": G112, Siemens, Haas: not on this control yet"},
      {foreign_word, "G150 P1 D1", 1, 1, ": G150, Haas: write G65 P90150, G12 or G13"},
      {group_twice, "G0 G1 X1", 1, 4, ": G1"},
      {group_twice, "G1 G81 Z-1 R1", 1, 4, ": G81"},
      {group_twice, "G90 G90", 1, 5, ": G90"},
      {group_twice, "G4 G28 X1", 1, 4, ": G28"},
      {group_twice, "M3 M5", 1, 4, ": M5"},
      {group_twice, "M0 M30", 1, 4, ": M30"},
      {group_twice, "M8 M8", 1, 4, ": M8"},
      {unknown_m, "M10000", 1, 1, ": M10000"},
      {unknown_m, "M3.5", 1, 1, ": M3.5"},
      {dwell_point, "G4 P.5", 1, 4, ": P.5"},
      {dwell_point, "G4 P2.", 1, 4, ": P2."},
      {dwell_point, "G4 P[3/2]", 1, 4, ": P"},
      {dwell_point, "G82 Z-1 R1 P.5 F100", 1, 12, ": P.5"},
      {foreign_word, "T1.5", 1, 1, ": T1.5, Fagor: write T_ D_"},
      {not_an_integer, "G43 H1.5", 1, 5, ": H1.5"},
      {not_an_integer, "M98 P1.5", 1, 5, ": P1.5"},
      {not_an_integer, "G95 S100 G84 Z-4 R1 F1 K1.25", 1, 24,
       ": K1.25, K and L are repetitions, the lead is F"},
      {not_an_integer, "G95 S100 G74 Z-4 R1 F1 L1.5", 1, 24,
       ": L1.5, K and L are repetitions, the lead is F"},
      {not_an_integer, "G81 Z-4 R1 F1 K1.25", 1, 15, ": K1.25"},
      {not_an_integer, "O1.5", 1, 1, ": O1.5"},
      {value_range, "T65536", 1, 1, ": T65536"},
      {value_range, "S-1", 1, 1, ": S-1"},
      {value_range, "G4 P-1", 1, 4, ": P-1"},
      {value_range, "G4 X100000", 1, 4, ": X100000"},
      {value_range, "M98 P1 L-1", 1, 8, ": L-1"},
      {value_range, "G2 I1 L0 F1", 1, 7, ": L0"},
      {value_range, "G31 P5 X1 F1", 1, 5, ": P5"},
      {unused_word, "G31 L1 P2 X1 F1", 1, 8, ": P2"},
      // 10 mm at a lead of 0.001 mm are 10,000 turns; 9999 are the most.
      {value_range, "G2 X10 Z10 I5 J0 K.001 F1", 1, 18, ": K.001"},
      {unused_word, "G1 X1 F1 R5", 1, 10, ": R5"},
      {unused_word, "G0 X61.882 Y-31.018 I-.868 J-.496 K.0003", 1, 21,
       ": I-.868, a tool direction I J K needs G43.5"},
      {unused_word, "G1 X1 F1 I5", 1, 10, ": I5"},
      {unused_word, "G0 G45 H3 Z2.", 1, 8, ": H3, the offset of G45 to G48 is D"},
      {unused_word, "G0 X1\nG2 X3 I1 K1 F1", 2, 10, ": K1"},
      {unused_word, "H1", 1, 1, ": H1"},
      {unused_word, "G4 P1 X1", 1, 7, ": X1"},
      {unused_word, "G4 P100 M98", 1, 4, ": P100"},
      {unused_word, "E1 D1", 1, 1, ": E1"},
      {missing_word, "G43", 1, 1, ": G43, needs H"},
      {missing_word, "G90 G4", 1, 5, ": G4, needs P, X or U"},
      {missing_word, "G28", 1, 1, ": G28, needs axes: X0 Y0 Z0, or Z0 with G91"},
      {missing_word, "G90.1 G2 X2 I1 F1", 1, 13, ": I1, needs J"},
      {missing_word, "M98", 1, 1, ": M98, needs P"},
      {axis_absent, "G0 X1 W1", 1, 7, ": W1"},
      {axis_absent, "G28 W1", 1, 5, ": W1"},
      {axis_absent, "G53 W1", 1, 5, ": W1"},
      {feed_missing, "G1 X1", 1, 4, ": X1"},
      {feed_missing, "G1 F5 X1\nG93 X2", 2, 5, ": X2"},
      {feed_missing, "G93 G1 F5 X1\nX2", 2, 1, ": X2"},
      {feed_missing, "G1 F5 X1\nG95 X2", 2, 5, ": X2"},
      {feed_missing, "G53 G1 X1", 1, 1, ": G53"},
      {feed_not_positive, "F0", 1, 1, ": F0"},
      {value_range, "G90 G10 L11 P#4120 R-1.", 1, 13, ": P, #4120 is 0"},
      {value_range, "G31 P[#1-2.] X1 F1", 1, 5, ": P, the value is -2"},
      {not_an_integer, "#1=2.5\nM98 P#1", 2, 5, ": P, #1 is 2.5"},
      {subprogram_missing, "#101=77\nG65 P#101", 2, 5, ": P, #101 is 77"},
      {missing_word, "M98 P#101", 1, 1, ": M98, needs P: #101 is vacant"},
      {feed_missing, "G1 X1 F#9", 1, 4, ": X1, needs F: #9 is vacant"},
      {missing_word, "G43 H[#101]", 1, 1, ": G43, needs H"},
      {feed_not_positive, "G1 X1 F-5", 1, 7, ": F-5"},
      {arc_centre_missing, "G2 X1 F1", 1, 4, ": X1"},
      {arc_centre_missing, "G2 X10 R5 F1\nX20", 2, 1, ": X20, R, I, J and K hold for their block alone"},
      {arc_centre_and_radius, "G2 X1 I1 R1 F1", 1, 10, ": R1"},
      {arc_radius_zero, "G2 X1 I0 J0 F1", 1, 10, ": J0"},
      {arc_radius_zero, "G2 X1 R0 F1", 1, 7, ": R0"},
      // Start radius 5, end radius |(10.11, 0) - (5, 0)| = 5.11: 0.11 apart, 0.1 allowed.
      {arc_radii_differ, "G2 X10.11 I5 F1", 1, 11, ": I5, 5.0000 and 5.1100 mm, 0.1100 mm apart"},
      // 0.2 inch and 0.205 inch.
      {arc_radii_differ, "G20 G2 X.405 I.2 F1", 1, 14, ": I.2, 5.0800 and 5.2070 mm, 0.1270 mm apart"},
      // Half the chord is 5; 0.1 less is the smallest radius.
      {arc_radius_too_small, "G2 X10 R4.89 F1", 1, 8, ": R4.89"},
      {arc_full_with_radius, "G2 X0 R5 F1", 1, 7, ": R5"},
      {machine_coordinates_motion, "G3 G53 X1 F1", 1, 4, ": G53"},
      {machine_coordinates_rtcp, "G43.4 H1\nG53 G0 X1", 2, 1, ": G53"},
      {machine_coordinates_rtcp, "G43.4 H1\nG28 X1", 2, 1, ": G28"},
      {tool_length_unknown, "G43 H7", 1, 5, ": H7"},
      {tool_length_unknown, "G43.4 H7", 1, 7, ": H7"},
      {subprogram_missing, "G0 X1\nX2 M98 P77\nX3", 2, 8, ": P77"},
      {nesting_too_deep, deep, 25, 1, ": M98"},  // O8 begins in line 24 = 2 + 7 * 3 + 1
      {subprogram_without_end, "M98 P5\nM30\nO5\nG0 X1\n", 5, 1, ""},
      {subprogram_without_end, "M98 P5\nM30\nO5\nG0 X1\nO6\nM99", 5, 1, ""},
      {unknown_instruction, "G0 X1\nTANGON P0", 2, 1, ": TANGON"},
      {foreign_word, "G0 X1\nTRAORI", 2, 1, ": TRAORI, Siemens: write G43.4 H_"},
      {unknown_instruction, "G0 XY1", 1, 4, ": XY"},
      {statement_not_first, "G0 X1 #5=1", 1, 7, ": #5"},
      {statement_not_first, "X#1 ENDW", 1, 5, ": ENDW"},
      {statement_not_first, "G0 IF[1]", 1, 4, ": IF"},
      {text_behind_statement, "#1=1 X5", 1, 6, ": X5"},
      {text_behind_statement, "ENDIF X5", 1, 7, ": X5"},
      {text_behind_statement, "#1=1 2", 1, 6, ": 2"},
      {too_many_centres, "G65 P1" + repeated(" I1", 31), 1, 8 + 30 * 3, ": I1"},
      {argument_kind, "CYCLE9960(1,2)", 1, 13, ": 2"},
      {cycle_foreign, "CYCLE81(10,0,2,-5)", 1, 1, ": CYCLE, write G81 X Y Z R F"},
      {cycle_foreign, "N10 CYCLE150(30,10000,\"\")", 1, 5,
       ": CYCLE, trunnion calibrate status has the protocol"},
      {foreign_word, "MCALL CYCLE83(1)", 1, 1, ": MCALL, Siemens: write G81 and others, or G66"},
      {too_many_arguments, "CYCLE800(1" + repeated(",", 16) + ")", 1, 27, ": )"},
      {call_not_alone, "G12 G17 I5", 1, 1, ": G12"},
      {call_not_alone, "G90 G37 Z5 M8", 1, 5, ": G37"},
      {subprogram_missing, "G37 Z5", 1, 1, ": G37"},
      {too_many_arguments, "CYCLE1234(1" + repeated(",1", 33) + ")", 1, 11 + 33 * 2, ": 1"},
      {end_without_begin, "G0 X1\nENDIF", 2, 1, ": ENDIF"},
      {end_without_begin, "N1 ENDW", 1, 4, ": ENDW"},
      {end_without_begin, "END1", 1, 1, ": END"},
      {end_without_begin, "ELSE", 1, 1, ": ELSE"},
      {end_without_begin, "ELSEIF 1", 1, 1, ": ELSEIF"},
      {end_without_begin, "WHILE [#1 LT 1] DO1\n#1=1\nEND2", 3, 1, ": END"},
      {end_without_begin, "WHILE 1\nIF 1\nENDW\nENDIF", 3, 1, ": ENDW"},
      {begin_without_end, "IF [1 EQ 2]\nG0 X1\n", 1, 1, ": IF"},
      {begin_without_end, "IF 1\nG0 X1\nELSE\nX2\n", 3, 1, ": ELSE"},
      {begin_without_end, "G0 X1\nWHILE 0\nX2\nO2\nENDW", 2, 1, ": WHILE"},
      {begin_without_end, "G0 X1\nWHILE 1\nX2\n", 2, 1, ""},
      {structure_too_deep, repeated("IF 1\n", 17), 17, 1, ": IF"},
      {label_missing, "GOTO 10\nN20 M30", 1, 1, ": GOTO, N10"},
      {label_missing, "IF[1EQ1]GOTO10\nM30\nO2\nN10", 1, 1, ": IF, N10"},
      {label_missing, "M98 P1\nM30\nO1\nM99 P10", 4, 5, ": P10"},
      {jump_into_structure, "GOTO 10\nWHILE 0\nN10\nENDW", 1, 1, ": GOTO"},
      {call_not_alone, "G0 G65 P1", 1, 4, ": G65"},
      {call_not_alone, "G65 P1 M3 M4", 1, 1, ": G65"},
      {call_not_alone, "G67 X1", 1, 1, ": G67"},
      {call_not_alone, "M130 M8", 1, 1, ": M130"},
      {missing_word, "G65 A1", 1, 1, ": G65, needs P"},
      {value_range, "G65 P0", 1, 5, ": P0"},
      {value_range, "G66 P1 L0", 1, 8, ": L0"},
      {not_an_integer, "G65 P1.5", 1, 5, ": P1.5"},
      {not_an_integer, "GOTO #1", 1, 6, ": #1"},
      {not_an_integer, "GOTO 1.5", 1, 6, ": 1.5"},
      {value_range, "GOTO -1", 1, 6, ": -1"},
      {subprogram_missing, "G65 P77 A1", 1, 5, ": P77"},
      {subprogram_missing, "G1009 A1", 1, 1, ": G1009"},
      {subprogram_missing, "M130", 1, 1, ": M130"},
      {program_alarm, "#1=1\n#3000=12 (TOOL BROKEN)", 2, 1, ": #3000=12 (TOOL BROKEN)"},
      // What is no UTF-8 is Windows-1252: d6 and d0 are O with a diaeresis and Eth.
      {program_alarm, "#3000=1 (\xd6\xd0)", 1, 1, ": #3000=1 (\xc3\x96\xc3\x90)"},
      {call_by_name, "M98 <SUB>", 1, 5, ": <"},
      {words_behind_percent, "% X5", 1, 3, ": X5"},
      {words_behind_percent, "G0 X1\n% (end) #1=2", 2, 9, ": #1"},
      {comment_in_comment, "(ONE ((TWO) THREE) X1", 1, 6, ": ("},
      {comment_in_comment, "G0 X1 (2 ((3) G1 X5)", 1, 10, ": ("},
      {two_tools, "T1 T2 M6", 1, 4, ": T2"},
      {letter_twice, "T1 T2 T3 M6", 1, 7, ": T3"},
      {letter_twice, "G65 P1 T1 T2", 1, 11, ": T2"},
      {length_of_another_tool, "T1 M6\nG43 H1\nT2 M6\nG43 Z5", 4, 1,
       ": G43, H1 was for T1, T2 is in the spindle"},
      {colon_in_program, ":10 G0 X1\n:20 G1 Z-5 F1", 2, 1, ": :"},
      {operand_missing, "#1=", 1, 4, ""},
      {operand_missing, "#1 5", 1, 4, ": 5"},
      {operand_missing, "#=5", 1, 2, ": ="},
      {operand_missing, "#1=[2+*3]", 1, 7, ": *"},
      {operand_missing, "#1=SINE[3]", 1, 4, ": SINE"},
      {operand_missing, "#1=SIN 3", 1, 4, ": SIN"},
      {operand_missing, "#1=POW[2]", 1, 4, ": POW"},
      {operand_missing, "#1=AR[2]", 1, 6, ": ["},
      {bracket_open, "G0 X[1+2", 1, 5, ": ["},
      {bracket_open, "#1=SIN[30", 1, 7, ": ["},
      {bracket_open, "#1=[1,2]", 1, 4, ": ["},
      {brackets_too_deep, "#1=" + repeated("[", 33) + "1" + repeated("]", 33), 1, 36, ": ["},
      {brackets_too_deep, "#1=" + repeated("SIN[", 33) + "1", 1, 4 + 32 * 4 + 3, ": ["},
      {division_by_zero, "#1=5/[3-3]", 1, 5, ": /"},
      {division_by_zero, "#1=5/#2", 1, 5, ": /"},
      {division_by_zero, "#1=5 MOD 0", 1, 6, ": MOD"},
      {function_domain, "G0 X[SQRT[-1]]", 1, 6, ": SQRT"},
      {function_domain, "#1=LN[0]", 1, 4, ": LN"},
      {function_domain, "#1=ASIN[1.1]", 1, 4, ": ASIN"},
      {function_domain, "#1=ACOS[-1.1]", 1, 4, ": ACOS"},
      {function_domain, "#1=TAN[-90]", 1, 4, ": TAN"},
      {function_domain, "#1=ATAN[0]/[0]", 1, 4, ": ATAN"},
      {function_domain, "#1=POW[-1,0.5]", 1, 4, ": POW"},
      {function_domain, "#1=POW[0,-1]", 1, 4, ": POW"},
      {result_too_large, "#1=POW[10,300] #1=#1*#1", 1, 21, ": *"},
      {result_too_large, "#1=EXP[1000]", 1, 4, ": EXP"},
      {number_range, "G0 X[POW[10,300]]", 1, 4, ": X"},
      {bits_of_fraction, "#1=1.5 AND 1", 1, 8, ": AND"},
      {bits_of_fraction, "#1=1 OR POW[2,60]", 1, 6, ": OR"},
      {variable_unknown, "#1=#200", 1, 4, ": #200"},
      {text_behind_statement, "#1=#1.5", 1, 6, ": .5"},
      {variable_unknown, "#1=#[1.5]", 1, 5, ": ["},
      {variable_unknown, "#[0-1]=1", 1, 2, ": ["},
      {variable_unknown, "#99999999999999999999=1", 1, 2, ": 99999999999999999999"},
      {variable_unknown, "#1=#4099", 1, 4, ": #4099"},
      {variable_unknown, "#1=AR[#60]", 1, 4, ": AR"},
      {variable_read_only, "#5001=1", 1, 1, ": #5001"},
      {spindle_without_mark, "#4822=1", 1, 1, ": #4822, spindle 1"},
      {variable_value, "#3006=-1", 1, 1, ": #3006"},
      {variable_value, "#2601=-1", 1, 1, ": #2601"},
      {variable_value, "#3004=8", 1, 1, ": #3004"},
      {variable_value, "#3901=1.5", 1, 1, ": #3901"},
      {variable_value, "#1100=2", 1, 1, ": #1100"},
      {variable_value, "#1132=65536", 1, 1, ": #1132"},
      {variable_read_only, "#1000=1", 1, 1, ": #1000"},
      {variable_unknown, "#1=#1016", 1, 4, ": #1016"},
      {completion_waited, "#3003=3", 1, 1, ": #3003"},
      {settings_variable, "#1=#3005", 1, 4, ": #3005"},
      {parts_required, "#3902=5", 1, 1, ": #3902"},
      {servo_deviation_unknown, "G0 X#5101", 1, 5, ": #5101"},
      {parameter_unavailable, "#1=PRM[1320]", 1, 4, ": PRM"},
      {print_places, "DPRNT[X#1]", 1, 8, ": #1"},
      {print_places, "DPRNT[X#1[5]]", 1, 8, ": #1"},
      {print_places, "DPRNT[X#1[00]]", 1, 8, ": #1"},
      {print_places, "DPRNT[X#1[55]]", 1, 8, ": #1"},
      {print_too_long, "DPRNT[" + std::string(201, 'A') + "]", 1, 207, ": A"},
      {binary_print, "BPRNT[X#1[3]]", 1, 1, ": BPRNT"},
      {variable_names, "SETVN 500[TOOL]", 1, 1, ": SETVN"},
      {bracket_open, "DPRNT[A", 1, 6, ": ["},
      {operand_missing, "DPRNT A", 1, 7, ": A"},
      {statement_not_first, "G0 DPRNT[A]", 1, 4, ": DPRNT"},
      {text_behind_statement, "DPRNT[A] X1", 1, 10, ": X1"},
      {text_behind_statement, "POPEN X1", 1, 7, ": X1"},
      {variable_unknown, "DPRNT[#200[53]]", 1, 7, ": #200"},
      {variable_unknown, "#5231=1", 1, 1, ": #5231"},
      {text_behind_statement, "#3006=1 #1=2", 1, 9, ": #1"},
      {tool_undefined, "#2007=1", 1, 1, ": #2007"},
      {dialect_unknown, "O1 (PART)\n(DIALECT: HAAZ)\nG0 X1", 2, 11, ": HAAZ"},
      {line_tap_axes, "S100 F100 G184 A5", 1, 11, ": G184"},
      {line_tap_axes, "S100 F100 G174 X0", 1, 11, ": G174"},
      {tool_unknown, "T4 M6\nT99 M6", 2, 1, ": T99"},
      {spindle_speed_above, "S50000 M3\nG4 P1 S50001", 2, 7, ": S50001, at most 50000 1/min (10a948)"},
      {spindle_speed_above, "#1=50000\nM3 S[#1+0.5]", 2, 4, ": S, at most 50000 1/min (10a948)"},
  };
  for (const Wrong& motion : wrong_motion()) wrong.push_back(motion);
  return wrong;
}

TestMachine machine_without_w() {
  TestMachine machine;
  machine.axis_mask = 0b011111111;
  machine.highest_speed = 50000;
  machine.axis_feed = 4000;
  machine.lengths = {{1, 50.0}};
  machine.cycle_m_codes[3] = 130;
  machine.tools[1] = {50, 0, 5, 0};
  return machine;
}

void expect_alarm(TestMachine& machine, const Wrong& wrong) {
  const Interpretation result = run(machine, wrong.program);
  SCOPED_TRACE(wrong.program);
  ASSERT_EQ(result.last, Step::alarm);
  EXPECT_EQ(result.alarm.number, wrong.number) << result.alarm.text.data();
  EXPECT_EQ(result.alarm.line, wrong.line);
  EXPECT_EQ(result.alarm.column, wrong.column);
  EXPECT_EQ(std::string(result.alarm.text.data()), std::string(alarm_text(wrong.number)) + wrong.word);
}

TEST(Alarm, PointsAtTheWordThatIsWrong) {
  for (const Wrong& wrong : wrong_programs()) {
    TestMachine machine = machine_without_w();
    expect_alarm(machine, wrong);
  }
}

TEST(Alarm, ConstantSurfaceSpeedNeedsALimitOfTheSpeed) {
  TestMachine machine = machine_without_w();
  machine.highest_speed = 0;
  expect_alarm(machine, {AlarmNumber::surface_speed_limit, "G96 S100", 1, 1, ": G96"});
  expect_alarm(machine, {AlarmNumber::surface_speed_limit, "G92 S3000\nG96 S100\nG92 S0", 3, 5, ": S0"});
}

struct FailingSource : TextSource {
  ReadResult read(std::uint64_t offset, char* buffer, std::size_t) override {
    if (offset != 0) return {ReadStatus::failed, 0};
    std::copy_n("G0 X1\n", 6, buffer);
    return {ReadStatus::bytes, 6};
  }
};

TEST(Alarm, TextThatCannotBeReadIsOne) {
  TestMachine machine;
  FailingSource text;
  const Interpretation result = run(machine, text);
  EXPECT_EQ(result.commands.size(), 1u);
  EXPECT_EQ(result.alarm.number, AlarmNumber::text_unreadable);
  EXPECT_EQ(result.alarm.line, 2u);
}

TEST(Alarm, EveryNumberOfTheTableHasATest) {
  // A channel gives the first nine, the interpreter never does. The last three have tests of their own.
  std::set<AlarmNumber> tested{
      AlarmNumber::not_resumable,           AlarmNumber::zone_entered,
      AlarmNumber::tapping_spindle_missing, AlarmNumber::tapping_spindle_synchronized,
      AlarmNumber::tapping_spindle_turns,   AlarmNumber::thread_too_short,
      AlarmNumber::axes_without_reference,  AlarmNumber::homing_axis_locked,
      AlarmNumber::tap_removal_thread,      AlarmNumber::print_refused,
      AlarmNumber::text_unreadable,         AlarmNumber::homed_unknown,
      AlarmNumber::surface_speed_limit};
  for (const Wrong& wrong : wrong_programs()) tested.insert(wrong.number);
  for (const AlarmText& entry : alarm_texts) {
    // num_dialect_test.cpp, haas_dialect_test.cpp and linuxcnc_*_test.cpp have those of their dialects.
    const auto number = static_cast<int>(entry.number);
    const bool num = number >= 1150 && number <= 1171, haas = number >= 1531 && number <= 1539;
    const bool linuxcnc = (number >= 1190 && number <= 1199) || (number >= 1640 && number <= 1659);
    EXPECT_TRUE(tested.contains(entry.number) || num || haas || linuxcnc) << entry.text;
    // The buffer holds the longest text with ": " and a word of 32 bytes.
    EXPECT_LE(entry.text.size() + 2 + 32 + 1, Alarm{}.text.size());
  }
}

TEST(Alarm, LongWordIsCutToTheBuffer) {
  TestMachine machine;
  const Interpretation result = run(machine, "G0 X" + std::string(500, '9'));
  EXPECT_EQ(result.alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(std::string(result.alarm.text.data()).size(),
            alarm_text(AlarmNumber::number_range).size() + 2 + 32);
}

TEST(Alarm, BlockWithAFaultMakesNoCommandAndChangesNothing) {
  TestMachine machine = machine_without_w();
  const Interpretation result = run(machine, "G0 X1\nG55 G91 T2 M8 S100 G43 H1 X5 R7\n");
  EXPECT_EQ(result.commands.size(), 1u);
  EXPECT_EQ(result.last, Step::alarm);
  EXPECT_EQ(result.modal.work_offset, 0);
  EXPECT_TRUE(result.modal.absolute);
  EXPECT_EQ(result.modal.selected_tool, 0);
  EXPECT_EQ(result.modal.spindle_speed, 0);
  EXPECT_EQ(result.modal.length_offset, 0);
}

// Behind a line of manual data input with a fault, the next one finds everything as the line before left it.
TEST(Alarm, LineWithAFaultLeavesNothingToTheNextLine) {
  struct Case {
    std::string good, faulty, next, expected;
  };
  const std::array cases{
      // The cycle's depth stays -4.
      Case{"F100 G81 Z-4 R1 L0\n", "G81 Z-9 R3 L0 Q.0005\n", "X5\n", "line X5 Z-4"},
      // Nothing was passed on the way to the reference position: G29 goes over X1.
      Case{"G28 X1\n", "G28 X7 V3 K1\n", "G29 X2\n", "rapid X1"},
      // G52 of the faulty line does not shift.
      Case{"G52 X10\n", "G52 X20 R1\n", "G0 X1\n", "rapid X11"},
      // Polar coordinates keep the radius 10.
      Case{"G16 G0 X10 Y0\n", "G0 X20 Y0 R1\n", "G0 Y90\n", "rapid Y10"},
      // The parameter input stays open, so that the next line is one of it.
      Case{"G10 L50\n", "G11 R1\n", "N900 R2\n", "table"},
  };
  for (const Case& c : cases) {
    TestMachine machine;
    Interpreter interpreter(machine);
    std::vector<Command> commands;
    const auto line = [&](const std::string& text, Beginning beginning) {
      StringSource source(text);
      interpreter.start(source, interpreter.position(), interpreter.modal(), no_variables, beginning);
      commands.clear();
      Command command;
      Step step = interpreter.next(command);
      for (; step == Step::command || step == Step::working; step = interpreter.next(command))
        if (step == Step::command) commands.push_back(command);
      return step;
    };
    ASSERT_EQ(line(c.good, Beginning::program), Step::end) << c.good << interpreter.alarm().text.data();
    ASSERT_EQ(line(c.faulty, Beginning::line), Step::alarm) << c.faulty;
    ASSERT_EQ(line(c.next, Beginning::line), Step::end) << c.next << interpreter.alarm().text.data();
    std::string all;
    for (const std::string& text : stream(Interpretation{commands, Step::end, {}, {}})) all += text + "; ";
    EXPECT_NE(all.find(c.expected), std::string::npos) << c.faulty << all;
  }
}

// A skip move of a block with a fault was not given out, so there is no position to wait for.
TEST(Alarm, SkipMoveWithAFaultDoesNotWaitForItsEnd) {
  TestMachine machine;
  StringSource text("G31 X10 F100 Q5\n");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::unused_word);
}

TEST(Alarm, StaysUntilStart) {
  TestMachine machine;
  StringSource text("G77");
  Interpreter interpreter(machine);
  interpreter.start(text, {}, {});
  Command command;
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  EXPECT_EQ(interpreter.next(command), Step::alarm);
  StringSource good("M30");
  interpreter.start(good, {}, {});
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::none);
  EXPECT_EQ(interpreter.next(command), Step::command);
  EXPECT_EQ(command.kind, CommandKind::end);
}

}  // namespace
}  // namespace trunnion::language::test
