// SPDX-License-Identifier: Apache-2.0
// What expressions give, by precedence, function, and vacancy.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

/// The value of `expression` behind the assignments `before`, taken from variable 100.
Value evaluated(const std::string& expression, const std::string& before = "") {
  TestMachine machine;
  const std::string text = before + "\n#100=" + expression + "\n";
  StringSource source(text);
  Interpreter interpreter(machine);
  interpreter.start(source, {}, {});
  Command command;
  while (interpreter.next(command) == Step::command) {
  }
  EXPECT_EQ(interpreter.alarm().number, AlarmNumber::none)
      << expression << ": " << interpreter.alarm().text.data();
  return interpreter.variables().common[50];
}

double number(const std::string& expression, const std::string& before = "") {
  const Value value = evaluated(expression, before);
  EXPECT_TRUE(value.given) << expression;
  return value.number;
}

TEST(Expression, PrecedenceIsFanucs) {
  EXPECT_EQ(number("1+2*3"), 7);
  EXPECT_EQ(number("[1+2]*3"), 9);
  EXPECT_EQ(number("8/4/2"), 1);
  EXPECT_EQ(number("10-4-3"), 3);
  EXPECT_EQ(number("7 MOD 4 * 2"), 6);  // one level, left to right: [7 MOD 4] * 2
  EXPECT_EQ(number("2*SQRT[9]+1"), 7);  // functions first
  EXPECT_EQ(number("-2+5"), 3);
  EXPECT_EQ(number("2*-3"), -6);
  EXPECT_EQ(number("--3"), 3);
  EXPECT_EQ(number("1 OR 2 AND 2"), 3);  // AND binds as *, OR as +
  EXPECT_EQ(number("6 AND 3"), 2);
  EXPECT_EQ(number("6 OR 3"), 7);
  EXPECT_EQ(number("6 XOR 3"), 5);
  EXPECT_EQ(number("1+1 EQ 2"), 1);  // comparisons last
  EXPECT_EQ(number("[1 EQ 1] AND [2 GT 3]"), 0);
  EXPECT_EQ(number("[1 EQ 1]OR[2 GT 3]"), 1);
}

TEST(Expression, ComparisonsInWordsAndSigns) {
  for (const auto& [a, b] : {std::pair{1, 2}, {2, 2}, {3, 2}, {-1, 1}}) {
    const auto compare = [a = a, b = b](const char* sign) {
      return number(std::to_string(a) + sign + std::to_string(b));
    };
    for (const char* sign : {"EQ", " eq ", "=="}) EXPECT_EQ(compare(sign), a == b ? 1 : 0) << a << sign << b;
    for (const char* sign : {"NE", "!=", "<>"}) EXPECT_EQ(compare(sign), a != b ? 1 : 0) << a << sign << b;
    for (const char* sign : {"GT", ">"}) EXPECT_EQ(compare(sign), a > b ? 1 : 0) << a << sign << b;
    for (const char* sign : {"GE", ">="}) EXPECT_EQ(compare(sign), a >= b ? 1 : 0) << a << sign << b;
    for (const char* sign : {"LT", "<"}) EXPECT_EQ(compare(sign), a < b ? 1 : 0) << a << sign << b;
    for (const char* sign : {"LE", "<="}) EXPECT_EQ(compare(sign), a <= b ? 1 : 0) << a << sign << b;
  }
}

TEST(Expression, LogicalSignsBindLast) {
  EXPECT_EQ(number("1 == 1 && 2 == 2"), 1);
  EXPECT_EQ(number("1 == 2 && 2 == 2"), 0);
  EXPECT_EQ(number("1 == 2 || 2 == 2"), 1);
  EXPECT_EQ(number("1 || 0 && 0"), 1);  // && before ||
  EXPECT_EQ(number("2 && 4"), 1);       // true, not bits: 2 AND 4 is 0
  EXPECT_EQ(number("![1 == 2]"), 1);
  EXPECT_EQ(number("!5"), 0);
  EXPECT_EQ(number("NOT[0]"), 1);
  EXPECT_EQ(number("NOT #1", "#1=3"), 0);
}

TEST(Expression, FunctionsInDegrees) {
  EXPECT_NEAR(number("SIN[30]"), 0.5, 1e-15);
  EXPECT_NEAR(number("COS[60]"), 0.5, 1e-15);
  EXPECT_NEAR(number("TAN[45]"), 1, 1e-15);
  // Quarters are exact, or a full turn in a loop would drift.
  for (int turn = -8; turn <= 8; ++turn) {
    const std::string angle = "[" + std::to_string(90 * turn) + "]";
    const int quarter = ((turn % 4) + 4) % 4;
    EXPECT_EQ(number("SIN" + angle), quarter == 1 ? 1 : quarter == 3 ? -1 : 0) << angle;
    EXPECT_EQ(number("COS" + angle), quarter == 0 ? 1 : quarter == 2 ? -1 : 0) << angle;
  }
  EXPECT_EQ(number("ASIN[1]"), 90);
  EXPECT_EQ(number("ASIN[-1]"), -90);
  EXPECT_EQ(number("ACOS[-1]"), 180);
  EXPECT_NEAR(number("ATAN[1]"), 45, 1e-13);
  EXPECT_NEAR(number("ATAN[-1]"), -45, 1e-13);
}

TEST(Expression, ArcTangentOfTwoCoversTheCircle) {
  for (const char* form : {"ATAN[%d]/[%d]", "ATAN[%d,%d]", "ATAN[ %d ] / [ %d ]"}) {
    for (const auto& [y, x, angle] : {std::tuple{0, 1, 0.0},
                                      {1, 1, 45.0},
                                      {1, 0, 90.0},
                                      {1, -1, 135.0},
                                      {0, -1, 180.0},
                                      {-1, -1, 225.0},
                                      {-1, 0, 270.0},
                                      {-1, 1, 315.0}}) {
      char text[40];
      std::snprintf(text, sizeof text, form, y, x);
      EXPECT_NEAR(number(text), angle, 1e-12) << text;
    }
  }
  // Just below the positive axis is not 360.
  EXPECT_LT(number("ATAN[-0.00000000000001]/[900000000]"), 360);
  EXPECT_NEAR(number("ATAN[1]/4"), 11.25, 1e-13);  // no bracket: a quotient
}

TEST(Expression, Rounding) {
  EXPECT_EQ(number("ROUND[2.5]"), 3);
  EXPECT_EQ(number("ROUND[-2.5]"), -3);
  EXPECT_EQ(number("FIX[2.9]"), 2);
  EXPECT_EQ(number("FIX[-2.9]"), -2);
  EXPECT_EQ(number("FUP[2.1]"), 3);
  EXPECT_EQ(number("FUP[-2.1]"), -3);
  EXPECT_EQ(number("FUP[2]"), 2);
  EXPECT_EQ(number("INT[-2.9]"), -2);
  EXPECT_EQ(number("ABS[-2.5]"), 2.5);
  EXPECT_EQ(number("SIGN[-2.5]"), -1);
  EXPECT_EQ(number("SIGN[0]"), 0);
  EXPECT_EQ(number("-7 MOD 4"), -3);  // the sign of the first
}

TEST(Expression, PowersAndLogarithms) {
  EXPECT_EQ(number("SQRT[2]"), std::sqrt(2.0));
  EXPECT_EQ(number("SQR[9]"), 3);
  EXPECT_NEAR(number("LN[EXP[2]]"), 2, 1e-15);
  EXPECT_EQ(number("POW[2,10]"), 1024);
  EXPECT_EQ(number("POW[-2,3]"), -8);
  EXPECT_EQ(number("POW[0,0]"), 1);
  EXPECT_EQ(number("PI"), std::numbers::pi);
}

TEST(Expression, VacantIsNotZeroButCountsAsZero) {
  EXPECT_FALSE(evaluated("#1").given);
  EXPECT_FALSE(evaluated("[#1]").given);
  EXPECT_FALSE(evaluated("#2", "#2=5\n#2=#0").given);  // an assignment can empty a variable
  EXPECT_EQ(number("#1+5"), 5);
  EXPECT_EQ(number("#1*5"), 0);
  EXPECT_EQ(number("-#1"), 0);
  EXPECT_EQ(number("#1 EQ #0"), 1);
  EXPECT_EQ(number("#1 NE #0"), 0);
  EXPECT_EQ(number("#1 EQ 0"), 0);
  EXPECT_EQ(number("#1 NE 0"), 1);
  EXPECT_EQ(number("#1 GE 0"), 1);
  EXPECT_EQ(number("#1 LT 0"), 0);
  EXPECT_EQ(number("#1 EQ #0", "#1=0"), 0);
}

TEST(Expression, VariablesNameVariables) {
  const std::string before = "#1=2 #2=101 #101=7 #4=0.1+0.2";
  EXPECT_EQ(number("#[#2]", before), 7);
  EXPECT_EQ(number("#[#[#1]]", before), 7);
  EXPECT_EQ(number("#[#2-100+#1-1]", before), 101);  // #2
  EXPECT_EQ(number("#[20*#4-4]", before), 101);      // 20 * 0.30000000000000004 - 4 is 2 but for rounding
  EXPECT_EQ(number("#[100+1]", "#[100+1]=3"), 3);
}

TEST(Expression, LettersAndBlanksAreFree) {
  EXPECT_EQ(number("#1eq2and3", "#1=2"), 1);  // 2 EQ [2 AND 3]
  EXPECT_EQ(number(" [ # 1 + sin [ 90 ] ] ", "# 1 = 2"), 3);
  EXPECT_EQ(number("5(comment)"), 5);
  EXPECT_EQ(number("5;comment"), 5);
}

TEST(Expression, LongChainsNeedNoStack) {
  std::string text = "1";
  for (int i = 0; i < 4000; ++i) text += "+1";
  EXPECT_EQ(number(text), 4001);
  EXPECT_EQ(number(std::string(10000, '-') + "1"), 1);
}

}  // namespace
}  // namespace trunnion::language::test
