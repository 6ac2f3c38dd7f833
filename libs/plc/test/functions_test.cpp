// SPDX-License-Identifier: Apache-2.0
// Every standard function against values that follow from its definition in IEC 61131-3:2013, tables 22
// to 36.
#include <set>

#include "plc/library/functions.hpp"
#include "plc/syntax/token.hpp"
#include "translated.hpp"

namespace trunnion::st {
namespace {

struct Row {
  const char* type;  ///< of the result
  const char* expression;
  const char* expected;
};

const Row rows[] = {
    // 6.6.2.5.6, numerical: abs
    {"INT", "ABS(INT#-5)", "5"},
    {"INT", "ABS(INT#-32768)", "-32768"},  // wraps around as -x does
    {"DINT", "ABS(DINT#7)", "7"},
    {"UINT", "ABS(UINT#9)", "9"},
    {"REAL", "ABS(REAL#-1.5)", "1.5"},
    {"LREAL", "ABS(-2.5)", "2.5"},
    {"TIME", "ABS(T#-3s)", "T#3s"},
    {"LREAL", "SQRT(9.0)", "3.0"},
    {"REAL", "SQRT(REAL#2.25)", "1.5"},
    {"LREAL", "LN(1.0)", "0.0"},
    {"LREAL", "LOG(1000.0)", "3.0"},
    {"LREAL", "EXP(0.0)", "1.0"},
    {"LREAL", "SIN(0.0)", "0.0"},
    {"LREAL", "COS(0.0)", "1.0"},
    {"LREAL", "TAN(0.0)", "0.0"},
    {"LREAL", "ASIN(0.0)", "0.0"},
    {"LREAL", "ACOS(1.0)", "0.0"},
    {"LREAL", "ATAN(0.0)", "0.0"},
    {"LREAL", "ATAN2(0.0, 1.0)", "0.0"},
    {"LREAL", "ATAN2(1.0, 1.0) * 4.0 - 2.0 * ASIN(1.0)", "0.0"},  // pi - pi
    {"LREAL", "FLOOR(-1.5)", "-2.0"},
    {"LREAL", "CEIL(-1.5)", "-1.0"},
    {"LREAL", "EXPT(2.0, 10)", "1024.0"},
    {"REAL", "EXPT(REAL#2.0, REAL#0.5) * EXPT(REAL#2.0, REAL#0.5)", "1.9999999"},
    {"LREAL", "2.0 ** 3", "8.0"},
    {"LREAL", "-2.0 ** 2", "4.0"},  // the sign binds more tightly (table 71)
    // arithmetic
    {"INT", "ADD(INT#1, INT#2, INT#3)", "6"},
    {"INT", "MUL(INT#2, INT#3, INT#4)", "24"},
    {"INT", "SUB(INT#2, INT#5)", "-3"},
    {"INT", "DIV(INT#-7, INT#2)", "-3"},
    {"INT", "INT#-7 MOD INT#2", "-1"},
    {"INT", "INT#7 MOD INT#-2", "1"},
    {"INT", "i0 MOD i0", "0"},  // table 24: MOD by zero is zero
    {"REAL", "REAL#1.0 / REAL#4.0", "0.25"},
    {"SINT", "s127 + SINT#1", "-128"},
    {"USINT", "USINT#0 - u1", "255"},
    {"INT", "MOVE(INT#4)", "4"},
    // comparison
    {"BOOL", "GT(INT#3, INT#2, INT#1)", "TRUE"},
    {"BOOL", "GT(INT#3, INT#2, INT#2)", "FALSE"},
    {"BOOL", "GE(INT#3, INT#2, INT#2)", "TRUE"},
    {"BOOL", "EQ(INT#2, INT#2, INT#2)", "TRUE"},
    {"BOOL", "LE(INT#1, INT#1, INT#2)", "TRUE"},
    {"BOOL", "LT(INT#1, INT#1)", "FALSE"},
    {"BOOL", "NE(INT#1, INT#2)", "TRUE"},
    {"BOOL", "'abc' < 'abd'", "TRUE"},
    {"BOOL", "'ab' < 'abc'", "TRUE"},
    {"BOOL", "'b' > 'abc'", "TRUE"},
    {"BOOL", "'abc' = 'abc'", "TRUE"},
    {"BOOL", "'abc' <> 'abc'", "FALSE"},
    {"BOOL", "T#1m = T#60s", "TRUE"},
    {"BOOL", "ULINT#18446744073709551615 > ul1", "TRUE"},
    // bit shift (table 26)
    {"BYTE", "SHL(BYTE#2#10010001, 1)", "34"},
    {"BYTE", "SHR(BYTE#2#10010001, 1)", "72"},
    {"BYTE", "ROL(BYTE#2#10010001, 1)", "35"},
    {"BYTE", "ROR(BYTE#2#10010001, 1)", "200"},
    {"BYTE", "SHL(BYTE#16#FF, 8)", "0"},
    {"BYTE", "ROL(BYTE#16#81, 9)", "3"},
    {"WORD", "ROR(WORD#1, 1)", "32768"},
    {"LWORD", "SHL(LWORD#1, 63)", "9223372036854775808"},
    {"LWORD", "ROR(LWORD#1, 1)", "9223372036854775808"},
    {"BYTE", "NOT BYTE#16#0F", "240"},
    {"BYTE", "b15 AND NOT BYTE#1", "14"},
    {"WORD", "b15 OR WORD#16#100", "271"},
    {"BYTE", "b15 XOR BYTE#16#FF", "240"},
    {"BOOL", "TRUE XOR FALSE", "TRUE"},
    // selection (table 27)
    {"INT", "SEL(FALSE, INT#1, INT#2)", "1"},
    {"INT", "SEL(TRUE, INT#1, INT#2)", "2"},
    {"INT", "SEL(G := TRUE, IN0 := INT#1, IN1 := INT#2)", "2"},
    {"STRING", "SEL(TRUE, 'a', 'bcd')", "'bcd'"},
    {"INT", "MAX(INT#1, INT#3, INT#2)", "3"},
    {"INT", "MIN(INT#3, INT#1, INT#2)", "1"},
    {"INT", "LIMIT(INT#0, INT#5, INT#3)", "3"},
    {"INT", "LIMIT(INT#0, INT#-5, INT#3)", "0"},
    {"INT", "LIMIT(MN := INT#0, IN := INT#2, MX := INT#3)", "2"},
    {"LREAL", "MAX(1.5, 2.5)", "2.5"},
    {"TIME", "MIN(T#1s, T#2s)", "T#1s"},
    {"INT", "MUX(0, INT#10, INT#20, INT#30)", "10"},
    {"INT", "MUX(K := 1, IN0 := INT#10, IN1 := INT#20)", "20"},
    {"INT", "MAX(IN2 := INT#1, IN1 := INT#3)", "3"},
    {"INT", "MUX(2, INT#10, INT#20, INT#30)", "30"},
    {"INT", "MUX(i0 + 1, INT#10, INT#20)", "20"},
    // strings (table 29)
    {"INT", "LEN('ASTRING')", "7"},
    {"STRING", "LEFT('ASTR', 3)", "'AST'"},
    {"STRING", "RIGHT('ASTR', 3)", "'STR'"},
    {"STRING", "MID('ASTR', 2, 2)", "'ST'"},
    {"STRING", "CONCAT('AB', 'CD', 'E')", "'ABCDE'"},
    {"STRING", "INSERT('ABC', 'XY', 2)", "'ABXYC'"},
    {"STRING", "INSERT('ABC', 'XY', 0)", "'XYABC'"},
    {"STRING", "DELETE('ABXYC', 2, 3)", "'ABC'"},
    {"STRING", "REPLACE('ABCDE', 'X', 2, 3)", "'ABXE'"},
    {"INT", "FIND('ABCBC', 'BC')", "2"},
    {"INT", "FIND('ABC', 'X')", "0"},
    {"STRING", "LEFT('AB', 9)", "'AB'"},
    {"STRING", "MID('AB', 1, 5)", "''"},
    {"INT", "LEN('')", "0"},
    // times (tables 30, 35)
    {"TIME", "ADD_TIME(T#1s, T#500ms)", "T#1s500ms"},
    {"TIME", "SUB_TIME(T#1s, T#2s)", "T#-1s"},
    {"TIME", "MUL_TIME(T#1.5s, 2)", "T#3s"},
    {"TIME", "DIV_TIME(T#3s, 2)", "T#1s500ms"},
    {"TIME", "T#1s * 1.5", "T#1s500ms"},
    {"TOD", "ADD_TOD_TIME(TOD#23:00:00, T#30m)", "TOD#23:30:00"},
    {"TOD", "SUB_TOD_TIME(TOD#01:00:00, T#30m)", "TOD#00:30:00"},
    {"TIME", "SUB_TOD_TOD(TOD#01:00:00, TOD#00:30:00)", "T#30m"},
    {"TIME", "SUB_DATE_DATE(D#2024-03-01, D#2024-02-28)", "T#2d"},
    {"DT", "ADD_DT_TIME(DT#2024-02-28-23:59:59, T#1s)", "DT#2024-02-29-00:00:00"},
    {"DT", "SUB_DT_TIME(DT#2024-03-01-00:00:00, T#1s)", "DT#2024-02-29-23:59:59"},
    {"TIME", "SUB_DT_DT(DT#2024-03-01-00:00:00, DT#2024-02-29-00:00:00)", "T#1d"},
    // conversion (table 22, 23): rounds to the nearest, halves to even; truncation to zero
    {"INT", "REAL_TO_INT(REAL#1.5)", "2"},
    {"INT", "REAL_TO_INT(REAL#2.5)", "2"},
    {"INT", "REAL_TO_INT(REAL#-1.5)", "-2"},
    {"DINT", "LREAL_TO_DINT(1.6)", "2"},
    {"DINT", "TRUNC(-1.6)", "-1"},
    {"INT", "LREAL_TRUNC_INT(1.9)", "1"},
    {"SINT", "LREAL_TO_SINT(1000.0)", "127"},
    {"USINT", "LREAL_TO_USINT(-3.0)", "0"},  // saturates
    {"SINT", "DINT_TO_SINT(d200)", "-56"},
    {"USINT", "INT_TO_USINT(INT#-1 + i0)", "255"},  // the low bits
    {"DWORD", "REAL_TO_DWORD(REAL#3.0)", "3"},
    {"UINT", "WORD_TO_UINT(WORD#16#FFFF)", "65535"},
    {"INT", "WORD_TO_INT(WORD#16#FFFF)", "-1"},
    {"BOOL", "INT_TO_BOOL(INT#4)", "TRUE"},
    {"INT", "BOOL_TO_INT(TRUE)", "1"},
    {"BYTE", "WORD_TO_BYTE(WORD#16#1234)", "52"},
    {"REAL", "INT_TO_REAL(INT#3)", "3.0"},
    {"LREAL", "ULINT_TO_LREAL(ul1)", "1.0"},
    {"REAL", "LREAL_TO_REAL(0.1)", "0.1"},
    {"LREAL", "REAL_TO_LREAL(REAL#0.5)", "0.5"},
    {"DINT", "TIME_TO_DINT(T#1.5s)", "1500"},
    {"TIME", "DINT_TO_TIME(DINT#1500)", "T#1s500ms"},
    {"LREAL", "TIME_TO_LREAL(T#1.5ms)", "1.5"},
    {"LINT", "LTIME_TO_LINT(LT#5us)", "5000"},
    {"LTIME", "TIME_TO_LTIME(T#1s)", "LT#1s"},
    {"STRING", "INT_TO_STRING(INT#-12)", "'-12'"},
    {"STRING", "REAL_TO_STRING(REAL#1.5)", "'1.5'"},
    {"STRING", "BOOL_TO_STRING(TRUE)", "'TRUE'"},
    {"STRING", "TIME_TO_STRING(T#90s)", "'T#1m30s'"},
    {"INT", "STRING_TO_INT(' 42 ')", "42"},
    {"INT", "STRING_TO_INT('-42')", "-42"},
    {"REAL", "STRING_TO_REAL('1.5')", "1.5"},
    {"LREAL", "STRING_TO_LREAL('2.5e1')", "25.0"},
    {"BOOL", "STRING_TO_BOOL('TRUE')", "TRUE"},
    {"INT", "STRING_TO_INT('x')", "0"},
    {"DATE", "DT_TO_DATE(DT#2024-02-29-13:00:00)", "D#2024-02-29"},
    {"TOD", "DT_TO_TOD(DT#2024-02-29-13:00:00)", "TOD#13:00:00"},
    {"INT", "TO_INT(DINT#7)", "7"},
    {"STRING", "TO_STRING(DINT#7)", "'7'"},
};

constexpr const char* variables =
    "VAR i0 : INT; s127 : SINT := 127; u1 : USINT := 1; ul1 : ULINT := 1; b15 : BYTE := 15; d200 : DINT := "
    "200;";

TEST(StandardFunctions, GiveTheValuesOfTheirDefinition) {
  for (const auto& row : rows) {
    SCOPED_TRACE(row.expression);
    Translated program(std::string(variables) + " result : " + row.type + "; END_VAR",
                       std::string("result := ") + row.expression + ";");
    EXPECT_EQ(program.scan(), "");
    EXPECT_EQ(program.get("result"), row.expected);
  }
}

// Constants are folded by the translator: the same expression of variables is computed by the machine.
TEST(StandardFunctions, AllOfThemAreInTheTable) {
  std::set<std::string> used;
  for (const auto& row : rows) {
    const std::string text = row.expression;
    for (std::size_t at = text.find('('); at != std::string::npos; at = text.find('(', at + 1)) {
      auto start = at;
      while (start > 0 &&
             (std::isalnum(static_cast<unsigned char>(text[start - 1])) || text[start - 1] == '_'))
        --start;
      used.insert(text.substr(start, at - start));
    }
  }
  for (const auto& function : standard_functions())
    if (function.group != FunctionGroup::test && function.group != FunctionGroup::clock) {
      EXPECT_TRUE(used.contains(std::string(function.name))) << function.name;
    }
}

TEST(StandardFunctions, TheTimeOfThePlcIsTheSameWithinAScan) {
  Translated program("VAR a, b : LTIME; END_VAR", "a := PLC_TIME(); b := PLC_TIME();");
  program.scan();
  program.scan(7000000);
  EXPECT_EQ(program.get("a"), "LT#7ms");
  EXPECT_EQ(program.get("b"), "LT#7ms");
}

}  // namespace
}  // namespace trunnion::st
