// SPDX-License-Identifier: Apache-2.0
// Input nobody should write, by name. alarm_test.cpp has every alarm, golden/alarms.nc the stream before it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

using testing::ElementsAre;

struct Case {
  const char* name;
  std::string program;
  AlarmNumber number;
  unsigned line, column;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class BadInputCase : public testing::TestWithParam<Case> {};

TEST_P(BadInputCase, IsAnAlarmWithNumberLineAndColumn) {
  TestMachine machine;
  machine.tools[1] = {50, 0, 5, 0};
  const Interpretation result = run(machine, GetParam().program);
  ASSERT_EQ(result.last, Step::alarm);
  EXPECT_EQ(result.alarm.number, GetParam().number) << result.alarm.text.data();
  EXPECT_EQ(result.alarm.line, GetParam().line);
  EXPECT_EQ(result.alarm.column, GetParam().column);
}

// The arcs: from X0 to X10.11 about X5 the radii are 5 and 5.11, 0.1 (000011) may lie between them; half the
// chord to X10 is 5, so a radius of 4.89 is too small by more than that. The step of 3 between two left turns
// is narrower than the tool of radius 5.
INSTANTIATE_TEST_SUITE_P(
    All, BadInputCase,
    testing::Values(
        Case{"unclosed_bracket", "G0 X1\nG0 X[1+2\n", AlarmNumber::bracket_open, 2, 5},
        Case{"division_by_zero", "#1=0\n#2=5/#1\n", AlarmNumber::division_by_zero, 2, 5},
        Case{"square_root_of_a_negative", "G0 X1\n#1=SQRT[-4]\n", AlarmNumber::function_domain, 2, 4},
        Case{"undefined_program", "G0 X1\nM98 P77\n", AlarmNumber::subprogram_missing, 2, 5},
        Case{"recursion", "M98 P1\nM30\nO1\nM98 P1\nM99\n", AlarmNumber::nesting_too_deep, 4, 1},
        Case{"recursion_of_a_macro", "G65 P1\nM30\nO1\nG65 P1\nM99\n", AlarmNumber::nesting_too_deep, 4, 1},
        Case{"number_of_1e300_in_digits", "G0 X1" + std::string(300, '0') + "\n", AlarmNumber::number_range,
             1, 4},
        Case{"number_of_1e300_computed", "G0 X1\nX[POW[10,300]]\n", AlarmNumber::number_range, 2, 1},
        Case{"number_of_1e300_with_exponent", "G0 X1e300\n", AlarmNumber::unused_word, 1, 6},
        Case{"overflow", "#1=POW[10,300]\n#1=#1*#1\n", AlarmNumber::result_too_large, 2, 6},
        Case{"letter_twice", "G0 X1 Y2 X3\n", AlarmNumber::letter_twice, 1, 10},
        Case{"two_g_codes_of_one_group", "G90 G0 G1 X1\n", AlarmNumber::group_twice, 1, 8},
        Case{"two_m_codes_of_one_group", "M3 M5\n", AlarmNumber::group_twice, 1, 4},
        Case{"arc_end_off_the_circle", "G2 X10.11 I5 F1\n", AlarmNumber::arc_radii_differ, 1, 11},
        Case{"radius_too_small", "G2 X10 R4.89 F1\n", AlarmNumber::arc_radius_too_small, 1, 8},
        Case{"compensation_that_cannot_be_resolved", "G41 D1 G1 X10 F1\nX30\nY3\nX0\n",
             AlarmNumber::compensation_unresolved, 4, 1},
        Case{"compensation_in_a_narrow_arc", "G41 D1 G1 X10 F1\nG3 X14 I2\n",
             AlarmNumber::compensation_radius, 2, 1},
        Case{"bytes_that_are_no_utf8", "G0 X1\nX2 \xff\n", AlarmNumber::not_utf8, 2, 4},
        Case{"line_of_a_megabyte", "G0 X1\n" + std::string(std::size_t{1} << 20, 'X') + "\nX2\n",
             AlarmNumber::line_too_long, 2, 1},
        Case{"system_variable_of_hnc8", "G0 X1\n#1=#1200\n", AlarmNumber::variable_unknown, 2, 4},
        Case{"system_variable_of_hnc8_written", "G0 X1\n#1193=2\n", AlarmNumber::variable_unknown, 2, 1},
        Case{"system_variable_of_hnc8_by_number", "#1=1000\nG0 X#[#1+41]\n", AlarmNumber::variable_unknown, 2,
             5}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(BadInput, ALoneCarriageReturnEndsALine) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1\rX2\rM30\r")), ElementsAre("rapid X1", "rapid X2", "end 30"));
}

TEST(BadInput, BytesThatAreNoUtf8AreAnAlarmButInComments) {
  TestMachine machine;
  EXPECT_THAT(stream(run(machine, "G0 X1\nX2 \xff\n")), ElementsAre("rapid X1", "alarm 1002 2:4"));
  EXPECT_THAT(stream(run(machine, "G0 X1 (\xd6\xd0)\n")), ElementsAre("rapid X1", "end 0"));
}

TEST(BadInput, ALineOfAMegabyteIsAnAlarmWhateverIsInIt) {
  TestMachine machine;
  for (const char filling : {' ', 'X', '(', '1', '\xff'}) {
    const std::string line(std::size_t{1} << 20, filling);
    EXPECT_THAT(stream(run(machine, "G0 X1\n" + line + "\nX2\n")), ElementsAre("rapid X1", "alarm 1001 2:1"));
  }
}

TEST(BadInput, NumbersBeyondAllMeasureAreAlarmsAndNeverInfinite) {
  TestMachine machine;
  const std::string digits(300, '9');
  EXPECT_EQ(run(machine, "G0 X" + digits + "\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "#1=" + digits + digits + "\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "G0 X[POW[10,300]]\n").alarm.number, AlarmNumber::number_range);
  EXPECT_EQ(run(machine, "#1=POW[10,300]*POW[10,300]\n").alarm.number, AlarmNumber::result_too_large);
  // E is a letter, not an exponent.
  EXPECT_EQ(run(machine, "G0 X1e300\n").alarm.number, AlarmNumber::unused_word);
}

}  // namespace
}  // namespace trunnion::language::test
