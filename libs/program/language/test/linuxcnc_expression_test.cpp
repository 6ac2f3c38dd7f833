// SPDX-License-Identifier: Apache-2.0
// Numbers, expressions and parameters of the LinuxCNC dialect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "language/linuxcnc_parameters.hpp"
#include "linuxcnc_program.hpp"

namespace trunnion::language::test {
namespace {

using ::testing::ElementsAre;

/// A value as DEBUG shows it, with six decimals, or an alarm.
std::string shown(const std::string& value, const std::string& before = "") {
  const auto texts = linuxcnc_messages(before + "#100=" + value + "\n(DEBUG,#100)");
  return texts.size() == 1 ? texts[0] : "?";
}

TEST(LinuxcncExpression, BindsAsItsTableSays) {
  EXPECT_EQ(shown("[2+3*2**2**2-7 MOD 3]"), "49.000000");  // 2 + 3 * (2^2)^2 - 1
  EXPECT_EQ(shown("[2.0/3*1.5-5.5/11.0]"), "0.500000");
  EXPECT_EQ(shown("[1 OR 0 AND 0]"), "0.000000");  // from left to right: 1 AND 0
  EXPECT_EQ(shown("[1 LT 2 AND 3+1 EQ 4]"), "1.000000");
  EXPECT_EQ(shown("[-2**2]"), "4.000000");  // the sign binds first
  EXPECT_EQ(shown("[-[2]**2]"), "4.000000");
  EXPECT_EQ(shown("[2--3]"), "5.000000");
  EXPECT_EQ(shown("[5 XOR 0]"), "1.000000");
  EXPECT_EQ(shown("[5 XOR 3]"), "0.000000");
}

TEST(LinuxcncExpression, OperatorsAreThoseOfLinuxCnc) {
  EXPECT_EQ(shown("[-7 MOD 3]"), "2.000000");  // never negative
  EXPECT_EQ(shown("[1 EQ 1.0000005]"), "1.000000");
  EXPECT_EQ(shown("[1 NE 1.0000005]"), "0.000000");
  EXPECT_EQ(shown("[1 EQ 1.00001]"), "0.000000");
  EXPECT_EQ(shown("[1.0000005 LE 1]"), "1.000000");
  EXPECT_EQ(shown("[1.0000005 GT 1]"), "1.000000");
  EXPECT_EQ(shown("[2.5 AND 0.1]"), "1.000000");
  EXPECT_EQ(shown("[1/0]"), "alarm 1505");
  EXPECT_EQ(shown("[1 MOD 0]"), "alarm 1505");
  EXPECT_EQ(shown("[[-8]**0.5]"), "alarm 1506");
  EXPECT_EQ(shown("[0**[-1]]"), "alarm 1507");
}

TEST(LinuxcncExpression, FunctionsAreThoseOfLinuxCnc) {
  EXPECT_EQ(shown("FIX[-2.8]"), "-3.000000");
  EXPECT_EQ(shown("FUP[-2.8]"), "-2.000000");
  EXPECT_EQ(shown("ROUND[-2.5]"), "-3.000000");
  EXPECT_EQ(shown("ATAN[-1]/[-1]"), "-135.000000");
  EXPECT_EQ(shown("-ATAN[1]/[0]"), "-90.000000");
  EXPECT_EQ(shown("[SIN[30]+COS[60]+TAN[45]]"), "2.000000");  // 0.5 + 0.5 + 1
  EXPECT_EQ(shown("[ACOS[0]+ASIN[1]]"), "180.000000");
  EXPECT_EQ(shown("[EXP[LN[2]]*SQRT[9]*ABS[-1]]"), "6.000000");
  EXPECT_EQ(shown("SQRT[-1]"), "alarm 1506");
  EXPECT_EQ(shown("ATAN[1]"), "alarm 1502");
  EXPECT_EQ(shown("SINE[1]"), "alarm 1502");
  EXPECT_EQ(shown("SIN 1"), "alarm 1502");
  EXPECT_EQ(shown("[1"), "alarm 1503");
  EXPECT_EQ(shown("2+3"), "alarm 1003");
}

TEST(LinuxcncExpression, BlanksMeanNothing) {
  EXPECT_THAT(linuxcnc_blocks("g 0x +0. 12 34y 7"), ElementsAre("rapid X0.1234 Y7"));
  EXPECT_THAT(linuxcnc_blocks("G0X1 2Y- 3Z. 5"), ElementsAre("rapid X12 Y-3 Z0.5"));
  EXPECT_THAT(linuxcnc_blocks("# 1 0 = [ 1 1 M O D 4 ]\nX # 10"), ElementsAre("rapid X3"));
  EXPECT_THAT(linuxcnc_blocks("X1.2.3"), ElementsAre("alarm 1003 1:5"));
  EXPECT_THAT(linuxcnc_blocks("X"), ElementsAre("alarm 1005 1:1"));
}

TEST(LinuxcncExpression, AllValuesOfABlockAreReadBeforeOneIsWritten) {
  EXPECT_THAT(linuxcnc_blocks("#3=15\n#3=6 G0 X#3\nX#3\n#4=1 #5=2\n#4=#5 #5=#4\nX#4 Y#5\n#6=15 #6=6\nX#6"),
              ElementsAre("rapid X15", "rapid X6", "rapid X2 Y1", "rapid X6 Y1"));
  EXPECT_THAT(linuxcnc_blocks("#[1+1]=5\n#3=2\nX##3\n#ATAN[1]/[1]=3\nX#45"),
              ElementsAre("rapid X5", "rapid X3"));
  EXPECT_THAT(linuxcnc_blocks("#1=2 (DEBUG,#1)"), ElementsAre("message 10000"));
  EXPECT_THAT(linuxcnc_messages("#1=2 (DEBUG,#1)"), ElementsAre("2.000000"));
}

TEST(LinuxcncExpression, NamesMustHaveBeenWritten) {
  EXPECT_EQ(shown("#<a>"), "alarm 1193");
  EXPECT_EQ(shown("#<_mine>"), "alarm 1193");
  EXPECT_EQ(shown("#77"), "0.000000");
  EXPECT_EQ(shown("[EXISTS[#<a>]*2+EXISTS[#<b>]]", "#<a>=0\n"), "2.000000");
  EXPECT_EQ(shown("[EXISTS[#<_x>]+EXISTS[#5]+EXISTS[#6000]]"), "2.000000");
  EXPECT_EQ(shown("EXISTS[#<_ini[a]b>]"), "0.000000");
  EXPECT_EQ(shown("EXISTS[1]"), "alarm 1502");
  EXPECT_EQ(shown("EXISTS[#<a>+1]"), "alarm 1503");
  EXPECT_EQ(shown("#<_ini[setup]xpos>"), "alarm 1194");
  EXPECT_EQ(shown("#<_hal[motion.time]>"), "alarm 1194");
  EXPECT_EQ(shown("#<_vmajor>"), "alarm 1194");
  EXPECT_EQ(shown("#<open"), "alarm 1503");
  EXPECT_THAT(linuxcnc_blocks("#<_x>=1"), ElementsAre("alarm 1510 1:1"));
  std::string many;
  for (int i = 0; i < 1001; ++i) many += "#<n" + std::to_string(i) + ">=1\n";
  EXPECT_THAT(linuxcnc_blocks(many), ElementsAre("alarm 1195 1001:1"));
}

TEST(LinuxcncExpression, NumberedParametersShowTheControl) {
  TestMachine machine = linuxcnc_machine();
  machine.offsets[1] = {10, 20, 30, 0, 0, 0, 0, 0, 0};
  machine.reference = {500, 400, 300, 0, 0, 0, 0, 0, 0};
  machine.further_references[2] = {50, 60, 70, 0, 0, 0, 0, 0, 0};
  machine.tools[3] = {100, 1, 4, 0.5};
  const auto value = [&](const std::string& parameter, const std::string& before = "") {
    AxisValues start{};
    start[W] = -1;  // so that W0 is a move, too
    const Interpretation result =
        run(machine, before + "#100=" + parameter + "\nG90 G53 G21 G0 W#100\nM2\n", start);
    return result.last == Step::end ? result.commands[result.commands.size() - 2].target[W] : -1e9;
  };
  EXPECT_EQ(value("#5420", "G55 G0 X5\n"), 5);
  EXPECT_EQ(value("#<_x>", "G55 G0 X5\n"), 5);
  EXPECT_EQ(value("#5021", "G55 G0 X5\n"), 15);
  EXPECT_NEAR(value("#5420", "G55 G0 X5\nG20\n"), 5 / 25.4, 1e-12);
  EXPECT_EQ(value("#5242"), 20);
  EXPECT_EQ(value("#5220", "G55\n"), 2);
  EXPECT_EQ(value("#<_coord_system>", "G59.2\n"), 592);
  EXPECT_EQ(value("#5230"), 0);
  EXPECT_EQ(value("#5161"), 500);
  EXPECT_EQ(value("#5183"), 70);
  EXPECT_EQ(value("#5400", "T3 M6\n"), 3);
  EXPECT_EQ(value("#5403", "T3 M6\n"), 101);
  EXPECT_EQ(value("#5410", "T3 M6\n"), 9);  // 2 * (4 + 0.5)
  EXPECT_EQ(value("#5403"), 0);
  EXPECT_EQ(value("#<_feed>", "F250\n"), 250);
  EXPECT_EQ(value("#<_rpm>", "S1200 M3\n"), 1200);
  EXPECT_EQ(value("[#<_spindle_on>+#<_spindle_cw>]", "S1200 M3\n"), 2);
  EXPECT_EQ(value("#<_line>", "\n\n"), 3);
  EXPECT_EQ(value("#<_motion_mode>", "G3\n"), 30);
  EXPECT_EQ(value("#<_motion_mode>", "G80\n"), 800);
  EXPECT_EQ(value("[#<_absolute>*10+#<_incremental>]", "G91\n"), 1);
  EXPECT_EQ(value("[#<_retract_r_plane>*10+#<_retract_old_z>]", "G99\n"), 10);
  EXPECT_EQ(value("#<_ijk_absolute_mode>", "G90.1\n"), 1);
  EXPECT_EQ(value("#<_call_level>"), 0);
}

TEST(LinuxcncExpression, OtherNumbersAreRefused) {
  EXPECT_EQ(shown("#0"), "alarm 1509");
  EXPECT_EQ(shown("#5001"), "alarm 1509");
  EXPECT_EQ(shown("#5231"), "alarm 1509");
  EXPECT_EQ(shown("#5399"), "alarm 1194");
  EXPECT_EQ(shown("#1.5"), "alarm 1105");
  EXPECT_EQ(shown("#-1"), "alarm 1106");
  EXPECT_THAT(linuxcnc_blocks("#5221=1"), ElementsAre("alarm 1510 1:1"));
  EXPECT_THAT(linuxcnc_blocks("#5002=1"), ElementsAre("alarm 1509 1:1"));
}

TEST(LinuxcncExpression, EveryPredefinedParameterIsReadOrRefusedByItsName) {
  for (const PredefinedParameter& row : predefined_parameters) {
    const auto texts = linuxcnc_messages("#1=#<" + std::string(row.name) + ">");
    if (row.value == LinuxcncValue::absent)
      EXPECT_THAT(texts, ElementsAre("alarm 1194")) << row.name;
    else
      EXPECT_THAT(texts, ElementsAre()) << row.name;
  }
}

// What other dialects store is there: #31 is #50030, #5000 is #54999.
TEST(LinuxcncExpression, UserParametersAreKeptAsThoseOfOtherDialects) {
  TestMachine machine = linuxcnc_machine();
  StringSource source("#31=3.5\n#5000=7\nM2\n");
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  while (interpreter.next(command) == Step::command) {
  }
  EXPECT_EQ(interpreter.variables().user[30].number, 3.5);
  EXPECT_EQ(interpreter.variables().user[4999].number, 7);
}

TEST(LinuxcncExpression, TheLastCommentOfABlockMayBeAMessage) {
  EXPECT_THAT(linuxcnc_messages("(MSG, hello #1)\n( m S g , two )\n(MSG)\n(MSGS, no)\n(MSG,x)(a comment)\n"
                                "; print, #<_line>\n(debug)"),
              ElementsAre("hello #1", "two ", "6.000000"));
  EXPECT_THAT(linuxcnc_messages("#<value>=1.123456789\n(DEBUG, a #<value> b)\n(DEBUG,%d#<value>)\n"
                                "(DEBUG,%fv #<value>, %.7f#< Value>%x %d#1)\n(DEBUG,#<none>)"),
              ElementsAre("a 1.123457 b", "1", "v 1.1235, 1.1234568%x 0", "######"));
  EXPECT_THAT(linuxcnc_messages("(ABORT, stop here)"), ElementsAre("alarm 1501"));
  EXPECT_THAT(linuxcnc_messages("(LOG, nothing)\n(LOGCLOSE)\n(PROBECLOSE)"), ElementsAre());
  EXPECT_THAT(linuxcnc_messages("(LOGOPEN,file)"), ElementsAre("alarm 1192"));
  EXPECT_THAT(linuxcnc_messages("(PROBEOPEN file)"), ElementsAre("alarm 1192"));
  EXPECT_THAT(linuxcnc_messages(";py,import os"), ElementsAre("alarm 1192"));
  EXPECT_THAT(linuxcnc_messages("(" + std::string(300, 'x') + ")\n(MSG," + std::string(300, 'y') + ")"),
              ElementsAre(std::string(96, 'y')));
}

}  // namespace
}  // namespace trunnion::language::test
