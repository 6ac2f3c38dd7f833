// SPDX-License-Identifier: Apache-2.0
// Programs of Haas mills. Expected commands are derived from the mill operator's manual (docs/haas.md names
// the pages).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "language/haas_codes.hpp"
#include "language/haas_variables.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test::haas_dialect {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

TestMachine haas_machine() {
  TestMachine machine;
  machine.dialect = ProgramDialect::haas;
  machine.lengths = {{1, 100.0}};
  machine.tools[1] = {100, 0.5, 6, 0.25};
  return machine;
}

std::vector<std::string> haas_stream(const std::string& program) {
  TestMachine machine = haas_machine();
  return stream(run(machine, program));
}

std::vector<std::string> iso_stream(const std::string& program) {
  TestMachine machine = haas_machine();
  machine.dialect = ProgramDialect::iso;
  return stream(run(machine, program));
}

AlarmNumber alarm_of(const std::string& program) {
  TestMachine machine = haas_machine();
  return run(machine, program).alarm.number;
}

std::string alarm_text_of(const std::string& program) {
  TestMachine machine = haas_machine();
  return run(machine, program).alarm.text.data();
}

TEST(HaasDialect, EveryFunctionOfTheTableIsACodeHere) {
  // G12, G13, G150 and G187 are no rows of the table of codes in this version of it.
  const std::set<double> elsewhere{150};
  int before = -1;
  for (const HaasCode& row : haas_g_codes) {
    EXPECT_GT(row.first, before);
    EXPECT_GE(row.last, row.first);
    before = row.last;
    if (row.use == HaasUse::not_here) {
      EXPECT_LE(std::strlen(row.meaning), 48u) << row.meaning;
    }
    if (row.use == HaasUse::not_here || row.use == HaasUse::no_effect || row.use == HaasUse::offset) continue;
    const auto tenths = static_cast<std::uint32_t>(std::lround(row.code * 10));
    const bool call = std::ranges::any_of(
        call_codes, [&](const auto& one) { return one.first <= tenths && tenths <= one.last; });
    EXPECT_TRUE(g_code(tenths) != nullptr || call || elsewhere.contains(row.code)) << "G" << row.first;
  }
  for (const HaasCode& row : haas_m_codes) {
    if (row.use == HaasUse::not_here) {
      EXPECT_LE(std::strlen(row.meaning), 48u) << row.meaning;
    }
  }
}

TEST(HaasDialect, FunctionsThatAreNotHereAreRefusedByName) {
  for (const HaasCode& row : haas_g_codes) {
    if (row.use != HaasUse::not_here) continue;
    const std::string text = alarm_text_of("G" + std::to_string(row.first) + " H1");
    EXPECT_THAT(text, EndsWith(std::string(", ") + row.meaning));
    EXPECT_EQ(alarm_of("G" + std::to_string(row.last) + " H1"), AlarmNumber::haas_function_missing);
  }
  for (const char* m : {"M46 Q1 P5", "M95", "M96 P10 Q5", "M109 P501"})
    EXPECT_EQ(alarm_of(m), AlarmNumber::haas_function_missing) << m;
  // Functions of other controls, whatever they would mean in an ISO program.
  for (const char* g : {"G5 P10000", "G43.4 H1", "G43.5 H1", "G24 X0", "G79", "G96 S100", "G66 P1", "G1007"})
    EXPECT_EQ(alarm_of(g), AlarmNumber::haas_g_unknown) << g;
}

TEST(HaasDialect, TheTimeOfADwellIsInSecondsWithAPoint) {
  EXPECT_THAT(haas_stream("G04 P1.5\nG04 P500\nG4 P2.\nM30"),
              ElementsAre("dwell 1.5", "dwell 0.5", "dwell 2", "end 30"));
  EXPECT_THAT(haas_stream("G0 Z5.\nG82 Z-1. R1. P0.3 F100\nG80\nM30"),
              ElementsAre("rapid Z5", "rapid Z1", "line Z-1 F100", "dwell 0.3", "rapid Z5", "end 30"));
}

// From 3 mm above the zero, where Z stands; behind G80 it stands there again.
TEST(HaasDialect, WithoutRACycleBeginsWhereZStands) {
  EXPECT_THAT(haas_stream("G0 Z3.\nG81 X1 Z-5. F100\nX2\nG80\nG0 Z2.\nG82 R1. Z-1.\nG80\nG82 Z-2.\nG80\nM30"),
              ElementsAre("rapid Z3", "rapid X1 Z3", "line X1 Z-5 F100", "rapid X1 Z3", "rapid X2 Z3",
                          "line X2 Z-5 F100", "rapid X2 Z3", "rapid X2 Z2", "rapid X2 Z1", "line X2 Z-1 F100",
                          "rapid X2 Z2", "line X2 Z-2 F100", "rapid X2 Z2", "end 30"));
  EXPECT_THAT(iso_stream("G0 Z3.\nG81 X1 Z-5. F100\n"), ElementsAre("rapid Z3", "alarm 1601 2:1"));
  EXPECT_EQ(alarm_of("G0 Z3.\nG77 X1 Z-5. Q1 F100\n"), AlarmNumber::cycle_depth_missing);
}

TEST(HaasDialect, M97CallsWhatBeginsAtASequenceNumber) {
  EXPECT_THAT(haas_stream("G0 X1\nM97 P1000 L2\nX3\nM30\nN1000 G91 Y1\nG90 M99\n"),
              ElementsAre("rapid X1", "rapid X1 Y1", "rapid X1 Y2", "rapid X3 Y2", "end 30"));
  // Before the call, and in the program of the call only.
  EXPECT_THAT(haas_stream("GOTO 2\nN1 X1\nM99\nN2 M97 P1\nM30"), ElementsAre("rapid X1", "end 30"));
  EXPECT_THAT(haas_stream("M98 P5\nM30\nO5\nM97 P10\nM99\nN10 X1\nM99\nO6\nN10 X2\nM99"),
              ElementsAre("rapid X1", "end 30"));
  EXPECT_THAT(
      haas_stream("M98 P5\nM98 P6\nM30\nO5\nM97 P10\nM99\nN10 X1\nM99\nO6\nM97 P10\nM99\nN10 X2\nM99"),
      ElementsAre("rapid X1", "rapid X2", "end 30"));
  // A loop calls it again and again, and it calls another one.
  EXPECT_THAT(haas_stream("WHILE[#1LT2]DO1\n#1=#1+1\nM97P9\nEND1\nM30\nN9G91X1\nM97P8\nG90M99\nN8Y1\nM99"),
              ElementsAre("rapid X1", "rapid X1 Y1", "rapid X2 Y1", "rapid X2 Y2", "end 30"));
  EXPECT_THAT(haas_stream("M97 P7\nM30\n"), ElementsAre("alarm 1407 1:5"));
  EXPECT_THAT(haas_stream("M97\nM30\n"), ElementsAre("alarm 1108 1:1"));
  EXPECT_THAT(haas_stream("M97 P7 H5\nM30\nN7 X1\nN5 M99\n"), ElementsAre("alarm 1107 1:8"));
  EXPECT_THAT(haas_stream("M97 P7\nM30\nN7 X1\n"), ElementsAre("rapid X1", "alarm 1403 4:1"));
  EXPECT_EQ(alarm_of("M97 P7\nM30\nN7 M97 P7\nM99"), AlarmNumber::nesting_too_deep);
  EXPECT_EQ(alarm_of("M97 P7\nM30\nIF[1EQ1]\nN7 X1\nM99\nENDIF"), AlarmNumber::jump_into_structure);
}

TEST(HaasDialect, TextInFrontOfTheMarkOfTheTapeIsPassed) {
  EXPECT_THAT(haas_stream("PLATE 12\n%\nO00012\nG0 X1.\nM30\n%\n"), ElementsAre("rapid X1", "end 30"));
  TestMachine machine = haas_machine();
  machine.dialect = ProgramDialect::iso;
  EXPECT_THAT(stream(run(machine, "PLATE 12\n%\n(DIALECT: HAAS)\nG04 P1.5\nM30\n%\n")),
              ElementsAre("dwell 1.5", "end 30"));
}

TEST(HaasDialect, TextInFrontOfTheMarkIsNoProgram) {
  EXPECT_THAT(haas_stream("Information listing created by\n\n%\nO1234\nG0 X1\nM30\n%\n"),
              ElementsAre("rapid X1", "end 30"));
  EXPECT_THAT(haas_stream("%\nONONAME ( PART )\nG0 X1\nM30\n"), ElementsAre("rapid X1", "end 30"));
}

TEST(HaasDialect, M98CallsAProgramOfTheMemory) {
  TestMachine machine = haas_machine();
  machine.programs["O0100"] = std::make_unique<StringSource>("O00100\nG91 X1\nG90 M99\n");
  EXPECT_THAT(stream(run(machine, "M98 P100 L2\nM30")), ElementsAre("rapid X1", "rapid X2", "end 30"));
  // The digits before the last four do not count, as they do in the older form of Fanuc.
  EXPECT_THAT(stream(run(machine, "M98 P30100\nM30")), ElementsAre("alarm 1401 1:5"));
}

TEST(HaasDialect, WorkOffsetsGoOnBehindG59) {
  TestMachine machine = haas_machine();
  machine.more_offsets[1] = {10, 0, 0, 0, 0, 0, 0, 0, 0};
  machine.more_offsets[5] = {15, 0, 0, 0, 0, 0, 0, 0, 0};
  machine.more_offsets[20] = {20, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT(stream(run(machine, "G110 G0 X1\nG129 X1\nG154 P5 X2\nG114 X3\nG54 X0\nM30")),
              ElementsAre("rapid X11", "rapid X21", "rapid X17", "rapid X18", "rapid", "end 30"));
  // P of the block stays that of the cycle.
  EXPECT_THAT(
      stream(run(machine, "G0 Z1.\nG110 G82 X0 Z-1. R1. P.5 F100\nG80\nM30")),
      ElementsAre("rapid Z1", "rapid X10 Z1", "line X10 Z-1 F100", "dwell 0.5", "rapid X10 Z1", "end 30"));
  EXPECT_EQ(alarm_of("G154 P49"), AlarmNumber::value_range);
  EXPECT_EQ(alarm_of("G154"), AlarmNumber::missing_word);
}

TEST(HaasDialect, PecksMayGetSmaller) {
  // 4, 4 - 1 = 3 and 2 mm reach 9 mm; between them the tool goes back 1 mm.
  EXPECT_THAT(haas_stream("G0 Z1.\nG73 Z-9. R0 I4. J1. K2. F100\nG80\nM30"),
              ElementsAre("rapid Z1", "rapid", "line Z-4 F100", "rapid Z-3", "line Z-7 F100", "rapid Z-6",
                          "line Z-9 F100", "rapid Z1", "end 30"));
  // 4, then 2 each, which is the least: 4 - 3 = 1 would be less.
  EXPECT_THAT(haas_stream("G0 Z1.\nG83 Z-8. R0 I4. J3. K2. F100\nG80\nM30"),
              ElementsAre("rapid Z1", "rapid", "line Z-4 F100", "rapid", "rapid Z-3", "line Z-6 F100",
                          "rapid", "rapid Z-5", "line Z-8 F100", "rapid Z1", "end 30"));
  EXPECT_EQ(alarm_of("G83 Z-8. R0 I4. J3. F100"), AlarmNumber::cycle_peck_missing) << "J without K ends at 0";
}

TEST(HaasDialect, G73GoesOutBehindTheDepthOfK) {
  // Pecks of 2 mm; behind 4 mm the tool goes out to R, and back to 1 mm above the ground.
  EXPECT_THAT(haas_stream("G0 Z1.\nG73 Z-6. R0 Q2. K4. F100\nG80\nM30"),
              ElementsAre("rapid Z1", "rapid", "line Z-2 F100", "rapid Z-1", "line Z-4 F100", "rapid",
                          "rapid Z-3", "line Z-6 F100", "rapid Z1", "end 30"));
  EXPECT_EQ(alarm_of("G81 Z-1. R0 K3 F100"), AlarmNumber::unused_word) << "L is how often, K is nothing";
}

TEST(HaasDialect, HolesAreOnACircleAnArcOrALine) {
  const std::string cycle = "G81 Z-1. R1. F100 L0\n", end = "\nG80\nM30";
  // 10 mm at 0 and 180 degrees about the position.
  const std::vector<std::string> circle = {"rapid X10",          "rapid X10 Z1", "line X10 Z-1 F100",
                                           "rapid X10",          "rapid X-10",   "rapid X-10 Z1",
                                           "line X-10 Z-1 F100", "rapid X-10",   "end 30"};
  EXPECT_EQ(haas_stream(cycle + "G70 I10. L2" + end), circle);
  EXPECT_EQ(haas_stream("G81 Z-1. R1. F100 G70 I10. L2" + end), circle) << "with the cycle in one block";
  // At 90 degrees, and 90 degrees back from there.
  EXPECT_THAT(haas_stream(cycle + "G71 I10. J90. K-90. L2" + end),
              ElementsAre("rapid Y10", "rapid Y10 Z1", "line Y10 Z-1 F100", "rapid Y10", "rapid X10",
                          "rapid X10 Z1", "line X10 Z-1 F100", "rapid X10", "end 30"));
  EXPECT_THAT(haas_stream(cycle + "G72 X2. I5. J0 L2" + end),
              ElementsAre("rapid X2", "rapid X2 Z1", "line X2 Z-1 F100", "rapid X2", "rapid X7",
                          "rapid X7 Z1", "line X7 Z-1 F100", "rapid X7", "end 30"));
  EXPECT_THAT(alarm_text_of(cycle + "G70 I10."), EndsWith(": G70, needs L"));
  EXPECT_THAT(alarm_text_of(cycle + "G71 I10. L3"), EndsWith(": G71, needs K"));
  EXPECT_EQ(alarm_of("G70 I10. L3"), AlarmNumber::pattern_without_cycle);
}

TEST(HaasDialect, ATapMayComeOutFaster) {
  // 500 mm/min at 500 1/min are 1 mm per revolution; J2 comes out at 1000 1/min.
  EXPECT_THAT(haas_stream("S500\nG84 Z-5. R1. F500. J2\nG80\nM30"),
              ElementsAre("S500", "rapid Z1", "tap Z-5 lead1", "tap Z1 lead1 S1000", "rapid", "end 30"));
  EXPECT_THAT(haas_stream("S500\nG74 Z-5. R1. F500.\nG80\nM30"),
              ElementsAre("S500", "rapid Z1", "tap Z-5 lead-1", "tap Z1 lead-1", "rapid", "end 30"));
  EXPECT_EQ(alarm_of("S500\nG84 Z-5. R1. F500. J0"), AlarmNumber::value_range);
  EXPECT_EQ(alarm_of("S500\nG84 Z-5. R1. F500. J10"), AlarmNumber::value_range);
  TestMachine machine = haas_machine();
  machine.highest_speed = 900;
  const Interpretation result = run(machine, "S500\nG84 Z-5. R1. F500. J2");
  EXPECT_EQ(result.alarm.number, AlarmNumber::spindle_speed_above);
  EXPECT_THAT(result.alarm.text.data(), EndsWith("S times J 1000, at most 900 1/min (10a948)"));
}

TEST(HaasDialect, TapsMayGoAlongAnyLine) {
  EXPECT_THAT(haas_stream("S100 M3\nG184 X3. Z-4. F200.\nM30"),
              ElementsAre("S100", "M3", "M5", "tap X3 Z-4 lead2", "tap lead2", "M3", "end 30"));
  EXPECT_THAT(haas_stream("G91 G95 S100 G174 Y-4. F.5\nM30"),
              ElementsAre("S100", "tap Y-4 lead-0.5", "tap lead-0.5", "end 30"));
  EXPECT_EQ(alarm_of("S100 G184 X3. B1. F200."), AlarmNumber::line_tap_axes);
  EXPECT_EQ(alarm_of("S100 G184 X3."), AlarmNumber::cycle_lead_missing);
  EXPECT_EQ(alarm_of("G184 X3. F100."), AlarmNumber::cycle_lead_missing);
  EXPECT_EQ(alarm_of("S100 G93 G184 X3. F100."), AlarmNumber::cycle_inverse_time);
}

TEST(HaasDialect, OtherNumbersMeanTheSame) {
  const std::pair<const char*, const char*> same[] = {
      {"G98 G77 Z-1. R-2. Q.5 F100.\nG80\nM30", "G98 G87 Z-1 R-2 Q0.5 F100\nG80\nM30"},
      {"M3 S9\nG87 Z-1. R1. F100.\nG80\nM30", "M3 S9\nG88 Z-1 R1 F100\nG80\nM30"},
      {"G101 X0\nG0 X5.\nG100 X0\nX5.\nM30", "G51.1 X0\nG0 X5\nG50.1 X0\nX5\nM30"},
      {"G234 H1\nG1 X1. A5. F100.\nG49\nM30", "G43.4 H1\nG1 X1 A5 F100\nG49\nM30"},
      {"T1 M16\nM30", "T1 M6\nM30"},
      {"T1 M06\nM30", "M6 T1\nM30"},
      {"G103 P1\nG255\nG0 X1.\nG103\nM30", "G0 X1\nM30"},
      {"G53\nG53 G0 X1.\nG0 G53\nM30", "G53 G0 X1\nM30"},
      {"M19 P90\nM19 R12.5\nM30", "M19 P90\nM19 R12.5\nM30"},
      {"M88\nM104\nM36\nM89\nM30", "M88\nM104\nM36\nM89\nM30"},
      {"G65 P9 X2. L2\nM30\nO9\nG91 X#24\nG90 M99", "G65 P9 X2 L2\nM30\nO9\nG91 X#24\nG90 M99"},
  };
  for (const auto& [haas, iso] : same) EXPECT_EQ(haas_stream(haas), iso_stream(iso)) << haas;
  EXPECT_EQ(alarm_of("G101 X5."), AlarmNumber::value_range) << "the mirror is about zero";
}

TEST(HaasDialect, G28WithoutAnAxisIsForAll) {
  TestMachine machine = haas_machine();
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  EXPECT_THAT(stream(run(machine, "G0 X1.\nG28\nM30")),
              ElementsAre("rapid X1", "rapid X500 Y400 Z300", "end 30"));
  EXPECT_THAT(stream(run(machine, "G28 G91 Z2.\nM30")), ElementsAre("rapid Z2", "rapid Z300", "end 30"));
}

TEST(HaasDialect, OffsetsOfToolsAreDiameters) {
  const std::string program = "G10 L10 P3 R10.\nG10 L12 P3 R10.\nG10 L13 P3 R1.\n#2401=14\nM30";
  EXPECT_THAT(haas_stream(program),
              ElementsAre("table2 3 10", "table4 3 5", "table5 3 0.5", "table4 1 7", "end 30"));
  TestMachine machine = haas_machine();
  machine.radius_offsets = true;
  EXPECT_THAT(stream(run(machine, program)),
              ElementsAre("table2 3 10", "table4 3 10", "table5 3 1", "table4 1 14", "end 30"));
  EXPECT_EQ(alarm_of("G10 L2 P0 X1."), AlarmNumber::value_range) << "P0 is G52";
}

TEST(HaasDialect, VariablesHaveTheNumbersOfTheControl) {
  // Length 100, its wear 0.5, diameter 12 and its wear 0.5 of tool 1; ISO has the wear first.
  EXPECT_THAT(haas_stream("G0 X#2001\nX#2201\nX#2401\nX#2601\nM30"),
              ElementsAre("rapid X100", "rapid X0.5", "rapid X12", "rapid X0.5", "end 30"));
  EXPECT_THAT(iso_stream("G0 X#2201\nX#2001\nX#2601\nM30"),
              ElementsAre("rapid X100", "rapid X0.5", "rapid X6", "end 30"));
  EXPECT_THAT(haas_stream("#2201=0.1\n#14021=5\n#7001=6\n#5241=7\nM30"),
              ElementsAre("table3 1 0.1", "table1 7 X5", "table1 6 X6", "table1 1 X7", "end 30"));
  EXPECT_THAT(haas_stream("#10101=7\n#500=8\nG0 X#101 Y#10500\nM30"), ElementsAre("rapid X7 Y8", "end 30"));
  EXPECT_THAT(haas_stream("F200. S9 T1\nG0 X#4106 Y#4119 Z#4120\nM30"),
              ElementsAre("S9", "T1", "rapid X200 Y9 Z1", "end 30"));
  EXPECT_THAT(haas_stream("IF [#5405 GE 6000] THEN #3000=15 (EXPIRED)\nG0 X[#5500+1]\nM30"),
              ElementsAre("rapid X1", "end 30"));
  EXPECT_THAT(iso_stream("G0 X#5405\n"), ElementsAre("alarm 1509 1:5"));
  EXPECT_THAT(haas_stream("#3006=1 (LOOK)\nM30"), ElementsAre("message 1", "M0", "end 30"));
  for (const char* number : {"1601", "3027", "3030", "3201", "4104.5", "4201", "5007", "5201", "5501", "6001",
                             "7387", "10001", "10700", "20001", "50001"})
    EXPECT_NE(alarm_of(std::string("G0 X#[") + number + "]"), AlarmNumber::none) << number;
  EXPECT_THAT(haas_stream("#1=#5501\nM30"), ElementsAre("alarm 1509 1:4"));
  EXPECT_THAT(haas_stream("#5201=1\nM30"), ElementsAre("alarm 1509 1:1"));
}

TEST(HaasDialect, AProgramOfAnotherDialectHasItsOwnVariables) {
  TestMachine machine = haas_machine();
  machine.programs["O9000"] = std::make_unique<StringSource>("(DIALECT: ISO)\nY#2201\nM99\n");
  EXPECT_THAT(stream(run(machine, "G0 X#2001\nM98 P9000\nZ#2001\nM30")),
              ElementsAre("rapid X100", "rapid X100 Y100", "rapid X100 Y100 Z100", "end 30"));
}

TEST(HaasDialect, TheSystemVariablesAreAscendingAndApart) {
  std::uint32_t before = 0;
  for (const HaasVariables& range : haas_variables) {
    EXPECT_GT(range.first, before);
    EXPECT_GE(range.last, range.first);
    before = range.last;
  }
  EXPECT_EQ(haas_system_number(33), 33);
  EXPECT_EQ(haas_system_number(14001), 7001);
  EXPECT_LT(haas_system_number(3027), 0);
}

}  // namespace
}  // namespace trunnion::language::test::haas_dialect
