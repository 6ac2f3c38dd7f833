// SPDX-License-Identifier: Apache-2.0
// Every standard function against values that follow from its definition in IEC 61131-3:2013, tables 22
// to 36.
#include <set>
#include <tuple>

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
    {"STRING", "MAX('abd', 'abc', 'ab')", "'abd'"},
    {"STRING", "MIN('abd', 'abc', 'ab')", "'ab'"},
    {"STRING", "LIMIT('b', 'abc', 'd')", "'b'"},
    {"STRING", "LIMIT('b', 'longer than both', 'd')", "'d'"},
    {"STRING", "LIMIT('b', 'c', 'longer than both')", "'c'"},
    {"STRING", "CONCAT(MAX('a', 'bc'), 'd')", "'bcd'"},
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
    // Table 25: a binary transfer; IEEE 754 has 16#40400000 for 3.0, 16#3FF0000000000000 for 1.0 of 64 bits
    {"DWORD", "REAL_TO_DWORD(REAL#3.0)", "1077936128"},
    {"REAL", "DWORD_TO_REAL(DWORD#16#40400000)", "3.0"},
    {"LWORD", "LREAL_TO_LWORD(LREAL#1.0)", "4607182418800017408"},
    {"LREAL", "LWORD_TO_LREAL(LWORD#16#4008000000000000)", "3.0"},
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
    {"INT", "TRUNC_INT(-1.9)", "-1"},
    {"USINT", "TRUNC_USINT(REAL#300.5)", "255"},
    {"LINT", "LREAL_TRUNC_LINT(1.0E10)", "10000000000"},
    // binary coded decimals (table 22): digits that do not fit are cut off
    {"UINT", "BCD_TO_UINT(WORD#16#0042)", "42"},
    {"UINT", "BCD_TO_UINT(16#9876)", "9876"},
    {"USINT", "WORD_BCD_TO_USINT(WORD#16#0099)", "99"},
    {"ULINT", "BYTE_BCD_TO_ULINT(b15 AND BYTE#9)", "9"},
    {"ULINT", "LWORD_BCD_TO_ULINT(LWORD#16#9999999999999999)", "9999999999999999"},
    {"WORD", "TO_BCD_WORD(UINT#1234)", "4660"},  // 16#1234
    {"WORD", "TO_BCD_WORD(1234)", "4660"},
    {"BYTE", "UINT_TO_BCD_BYTE(UINT#345)", "69"},                         // 16#45
    {"LWORD", "ULINT_TO_BCD_LWORD(ULINT#12345678901)", "1250999896321"},  // 16#12345678901
    // the order of bytes (table 37)
    {"UINT", "TO_BIG_ENDIAN(UINT#16#1234)", "13330"},  // 16#3412
    {"UINT", "FROM_BIG_ENDIAN(UINT#13330)", "4660"},
    {"UINT", "TO_LITTLE_ENDIAN(UINT#4660)", "4660"},
    {"UINT", "FROM_LITTLE_ENDIAN(UINT#4660)", "4660"},
    {"INT", "TO_BIG_ENDIAN(INT#128)", "-32768"},                                    // 16#0080, 16#8000
    {"DWORD", "TO_BIG_ENDIAN(DWORD#16#01020304)", "67305985"},                      // 16#04030201
    {"LWORD", "FROM_BIG_ENDIAN(LWORD#16#0102030405060708)", "578437695752307201"},  // 16#0807060504030201
    {"BYTE", "TO_BIG_ENDIAN(b15)", "15"},
    {"DWORD", "REAL_TO_DWORD(TO_BIG_ENDIAN(REAL#1.0))", "32831"},  // 16#3F800000, 16#0000803F
    {"LREAL", "FROM_BIG_ENDIAN(TO_BIG_ENDIAN(LREAL#0.1))", "0.1"},
    {"TIME", "FROM_BIG_ENDIAN(TO_BIG_ENDIAN(T#90s))", "T#1m30s"},
    // validation (table 38)
    {"BOOL", "IS_VALID(f0)", "TRUE"},
    {"BOOL", "IS_VALID(REAL#1.0 / f0)", "FALSE"},
    {"BOOL", "IS_VALID(f0 / f0)", "FALSE"},
    {"BOOL", "IS_VALID(LREAL#1.0E308)", "TRUE"},
    {"BOOL", "IS_VALID(LREAL#-1.0 / l0)", "FALSE"},
    {"BOOL", "IS_VALID(SQRT(l0 - LREAL#1.0))", "FALSE"},
    {"BOOL", "IS_VALID_BCD(WORD#16#1990)", "TRUE"},
    {"BOOL", "IS_VALID_BCD(WORD#16#A000)", "FALSE"},
    {"BOOL", "IS_VALID_BCD(b15)", "FALSE"},
    {"BOOL", "IS_VALID_BCD(LWORD#16#9999999999999999)", "TRUE"},
    {"BOOL", "IS_VALID_BCD(LWORD#16#F999999999999999)", "FALSE"},
    // operators as functions (tables 29 and 31)
    {"BYTE", "AND(BYTE#16#0F, BYTE#16#3C)", "12"},
    {"BYTE", "AND(b15, BYTE#16#0C, BYTE#16#06)", "4"},
    {"WORD", "OR(WORD#1, WORD#4, WORD#16)", "21"},
    {"BOOL", "XOR(TRUE, TRUE, TRUE)", "TRUE"},
    {"BYTE", "XOR(IN2 := BYTE#5, IN1 := b15)", "10"},
    {"BOOL", "OR(FALSE, FALSE) = AND(TRUE, FALSE)", "TRUE"},
    {"BOOL", "NOT OR(FALSE, i0 = 0)", "FALSE"},
    {"INT", "MOD(INT#-7, INT#4)", "-3"},
    {"INT", "MOD(IN2 := INT#4, IN1 := INT#7)", "3"},
    {"INT", "MOD(INT#17, INT#10) + 1 * 2", "9"},
    {"BYTE", "NOT(BYTE#16#F0)", "15"},
    {"BYTE", "NOT(IN := b15)", "240"},
    {"BYTE", "NOT(b15) AND BYTE#16#30", "48"},
    // the type in the name of an operation (table 21): of SINT and BYTE these would be -2 and 0
    {"INT", "ADD_INT(s127, s127)", "254"},
    {"WORD", "SHL_WORD(b15, 12)", "61440"},
    {"REAL", "DIV_REAL(1, 4)", "0.25"},
    {"LREAL", "SQRT_LREAL(REAL#2.25)", "1.5"},
    {"LREAL", "EXPT_LREAL(IN2 := 3, IN1 := 2)", "8.0"},
    {"DINT", "SEL_DINT(i0 = 0, 1, s127)", "127"},
    {"BOOL", "GT_LREAL(1, 0.5)", "TRUE"},
    // LTIME (table 35)
    {"LINT", "LTIME_TO_LINT(ADD_LTIME(LT#1us, LT#5ns))", "1005"},
    {"LINT", "LTIME_TO_LINT(ADD_LTIME(T#1ms, LT#5ns))", "1000005"},
    {"LINT", "LTIME_TO_LINT(SUB_LTIME(LT#1us, LT#2us))", "-1000"},
    {"LINT", "LTIME_TO_LINT(MUL_LTIME(LT#3ns, 4))", "12"},
    {"LINT", "LTIME_TO_LINT(MUL_LTIME(LT#1us, 1.5))", "1500"},
    {"LINT", "LTIME_TO_LINT(DIV_LTIME(LT#10ns, INT#4))", "2"},
    {"LTOD", "ADD_LTOD_LTIME(LTOD#23:00:00, LT#30m)", "TOD#23:30:00"},
    {"LTOD", "SUB_LTOD_LTIME(LTIME_OF_DAY#01:00:00, LT#30m)", "TOD#00:30:00"},
    {"LTIME", "SUB_LTOD_LTOD(LTOD#01:00:00, LTOD#00:30:00)", "LT#30m"},
    {"LTIME", "SUB_LDATE_LDATE(LD#2024-03-01, LDATE#2024-02-28)", "LT#2d"},
    {"LDT", "ADD_LDT_LTIME(LDT#2024-02-28-23:59:59, LT#1s)", "DT#2024-02-29-00:00:00"},
    {"LDT", "SUB_LDT_LTIME(LDATE_AND_TIME#2024-03-01-00:00:00, LT#1s)", "DT#2024-02-29-23:59:59"},
    {"LTIME", "SUB_LDT_LDT(LDT#2024-03-01-00:00:00, LDT#2024-02-29-00:00:00)", "LT#1d"},
    {"LDT", "CONCAT_DATE_LTOD(CONCAT_LDATE(2024, 2, 29), CONCAT_LTOD(13, 4, 5, 0))",
     "DT#2024-02-29-13:04:05"},
    {"LDT", "CONCAT_LDT(2024, 2, 29, 13, 4, 5, 0)", "DT#2024-02-29-13:04:05"},
    {"LTOD", "LDT_TO_LTOD(DT_TO_LDT(DT#2024-02-29-13:00:00))", "TOD#13:00:00"},
    {"DATE", "LDT_TO_DATE(LDT#2024-02-29-13:00:00)", "D#2024-02-29"},
};

// Literals of whole numbers are ANY_INT, those with a point ANY_REAL (IEC 61131-3:2013, table 5): a function
// of literals only takes the type of what takes its value.
const Row literal_rows[] = {
    {"INT", "SEL(b15 = BYTE#15, 3, 4)", "4"},
    {"INT", "MUX(i0, 3, 4)", "3"},
    {"INT", "ABS(-5)", "5"},
    {"INT", "MAX(1, 3, 2)", "3"},
    {"INT", "MIN(3, 1, 2)", "1"},
    {"INT", "LIMIT(0, 5, 3)", "3"},
    {"USINT", "SEL(i0 = 0, 3, 255)", "255"},
    {"WORD", "SEL(i0 = 0, 16#1, 16#FFFF)", "65535"},
    {"ULINT", "MAX(18446744073709551615, 1)", "18446744073709551615"},
    {"ULINT", "ABS(-9223372036854775808)", "9223372036854775808"},
    {"INT", "i0 + SEL(i0 = 0, 3, 4) * 2", "8"},
    {"INT", "-SEL(i0 = 0, 3, 4)", "-4"},
    {"REAL", "SEL(i0 = 0, 3, 4)", "4.0"},
    {"REAL", "MUX(i0, 1.5, 2)", "1.5"},
    {"REAL", "ABS(-1.5)", "1.5"},
    {"REAL", "ABS(-0.1)", "0.1"},
    {"REAL", "MAX(1, 2.5)", "2.5"},
    {"REAL", "MAX(3, 2.5)", "3.0"},
    {"REAL", "LIMIT(0, 0.5, 1)", "0.5"},
    {"REAL", "SQRT(2.25)", "1.5"},
    {"REAL", "SQRT(4)", "2.0"},
    {"REAL", "f0 + SQRT(2.25) * 2.0", "3.0"},
    {"REAL", "2.0 ** 3", "8.0"},
    {"REAL", "EXPT(2.0, 3)", "8.0"},
    {"LREAL", "SQRT(2.25)", "1.5"},
    {"LREAL", "SEL(i0 = 0, 1.5, 2)", "2.0"},
    {"DINT", "SEL(i0 = 0, 3, 2147483647)", "2147483647"},
    {"BOOL", "f0 < SQRT(2.25)", "TRUE"},
    {"BOOL", "u1 = SEL(i0 = 0, 0, 1)", "TRUE"},
    {"BOOL", "u1 = 1 AND SEL(i0 = 0, 0, 1)", "TRUE"},
    {"BOOL", "GT(SEL(i0 = 0, 3, 4), 3)", "TRUE"},
    {"BYTE", "SHL(b15, SEL(i0 = 0, 0, 1))", "30"},
};

constexpr const char* function_variables =
    "VAR i0 : INT; s127 : SINT := 127; u1 : USINT := 1; ul1 : ULINT := 1; b15 : BYTE := 15; d200 : DINT := "
    "200; f0 : REAL; l0 : LREAL;";

void expect_value(const Row& row) {
  SCOPED_TRACE(row.expression);
  Translated program(std::string(function_variables) + " result : " + row.type + "; END_VAR",
                     std::string("result := ") + row.expression + ";");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("result"), row.expected);
}

TEST(StandardFunctions, GiveTheValuesOfTheirDefinition) {
  for (const auto& row : rows) expect_value(row);
}

TEST(StandardFunctions, OfLiteralsFitTheTypeThatTakesTheirValue) {
  for (const auto& row : literal_rows) expect_value(row);
}

TEST(StandardFunctions, OfLiteralsAreLimitsAndStepOfALoop) {
  Translated program("VAR i, n : INT; b : BOOL; END_VAR",
                     "FOR i := SEL(b, 1, 0) TO SEL(b, 3, 4) BY SEL(b, 1, 2) DO n := n + 1; END_FOR;");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("n"), "3");  // 1, 2, 3
  program.set("b", "TRUE");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("n"), "6");  // and 0, 2, 4
}

// Constants are folded by the translator: the same expression of variables is computed by the
// machine.
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
    if (function.group != FunctionGroup::test && function.group != FunctionGroup::clock &&
        function.group != FunctionGroup::ladder) {
      EXPECT_TRUE(used.contains(std::string(function.name))) << function.name;
    }
}

// Days of the week and leap years: ISO 8601, the Gregorian calendar.
TEST(StandardFunctions, DatesAreMadeOfTheirPartsAndSplit) {
  for (const auto& [parts, date, weekday] : {std::tuple{"2026, 11, 23", "D#2026-11-23", "1"},
                                             {"2000, 2, 29", "D#2000-02-29", "2"},
                                             {"1970, 1, 1", "D#1970-01-01", "4"},
                                             {"2023, 2, 29", "D#2023-03-01", "3"},
                                             {"2100, 3, 1", "D#2100-03-01", "1"}}) {
    Translated program("VAR d : DATE; y, m, day, w : INT; again : DATE; END_VAR",
                       "d := CONCAT_DATE(" + std::string(parts) +
                           "); SPLIT_DATE(IN := d, YEAR => y, MONTH => m, DAY => day);\n"
                           "again := CONCAT_DATE(y, m, day); w := DAY_OF_WEEK(d);");
    EXPECT_EQ(program.scan(), "");
    EXPECT_EQ(program.get("d"), date);
    EXPECT_EQ(program.get("again"), date)
        << program.get("y") << " " << program.get("m") << " " << program.get("day");
    EXPECT_EQ(program.get("w"), weekday) << date;
  }
  Translated program(
      "VAR x : DT; t : TOD; h, m, s, ms, y, mo, d : INT; END_VAR",
      "x := CONCAT_DT(2026, 2, 28, 23, 59, 58, 7); t := CONCAT_TOD(1, 2, 3, 4);\n"
      "SPLIT_DT(IN := x, YEAR => y, MONTH => mo, DAY => d, HOUR => h, MINUTE => m, SECOND => s, "
      "MILLISECOND => ms);");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("x"), "DT#2026-02-28-23:59:58.007000000");
  EXPECT_EQ(program.get("t"), "TOD#01:02:03.004000000");
  std::string all;
  for (const char* name : {"y", "mo", "d", "h", "m", "s", "ms"}) all += program.get(name) + " ";
  EXPECT_EQ(all, "2026 2 28 23 59 58 7 ");
}

TEST(StandardFunctions, LongDatesAreSplitAsTheOthers) {
  Translated program(
      "VAR h, m, s, ms, y, mo, d, y1, m1, d1, h2, mi2, s2, ms2 : INT; END_VAR",
      "SPLIT_LDT(IN := LDT#2026-02-28-23:59:58.007, YEAR => y, MONTH => mo, DAY => d, HOUR => h, MINUTE => "
      "m,\n"
      "SECOND => s, MILLISECOND => ms); SPLIT_LDATE(IN := LD#1999-12-31, YEAR => y1, MONTH => m1, DAY => "
      "d1);\n"
      "SPLIT_LTOD(IN := LTOD#01:02:03.004, HOUR => h2, MINUTE => mi2, SECOND => s2, MILLISECOND => ms2);");
  EXPECT_EQ(program.scan(), "");
  std::string all;
  for (const char* name : {"y", "mo", "d", "h", "m", "s", "ms", "y1", "m1", "d1", "h2", "mi2", "s2", "ms2"})
    all += program.get(name) + " ";
  EXPECT_EQ(all, "2026 2 28 23 59 58 7 1999 12 31 1 2 3 4 ");
}

TEST(StandardFunctions, EveryDayOfFiveCenturiesIsSplitIntoWhatItIsMadeOf) {
  // From 1700-01-01, 98615 days before 1970-01-01, to 2199-12-31, 84005 days behind it.
  Translated program(
      "VAR i, wrong : DINT; d : DATE; y, m, day : INT; END_VAR",
      "FOR i := -98615 TO 84005 DO d := DT_TO_DATE(DT#1970-01-01-00:00:00 + T#1d * i);\n"
      "SPLIT_DATE(IN := d, YEAR => y, MONTH => m, DAY => day);\n"
      "IF CONCAT_DATE(y, m, day) <> d OR m < 1 OR m > 12 OR day < 1 OR day > 31 THEN wrong := wrong + 1; "
      "END_IF; END_FOR;");
  EXPECT_EQ(program.run.machine().run(0, 0, 100000000).kind, FaultKind::none);
  EXPECT_EQ(program.get("wrong"), "0");
  EXPECT_EQ(program.get("y"), "2199");
  EXPECT_EQ(program.get("m"), "12");
  EXPECT_EQ(program.get("day"), "31");
}

TEST(StandardFunctions, BinaryCodedDecimalsHaveFourBitsForEachDigit) {
  Translated program(
      "VAR a : USINT; b : UINT; c : UDINT; d : BYTE; e : WORD; f : DWORD; END_VAR",
      "a := BYTE_BCD_TO_USINT(16#42); b := WORD_BCD_TO_UINT(16#9876); c := DWORD_BCD_TO_UDINT(16#12345678);\n"
      "d := USINT_TO_BCD_BYTE(42); e := UINT_TO_BCD_WORD(12345); f := UDINT_TO_BCD_DWORD(87654321);");
  EXPECT_EQ(program.scan(), "");
  EXPECT_EQ(program.get("a"), "42");
  EXPECT_EQ(program.get("b"), "9876");
  EXPECT_EQ(program.get("c"), "12345678");
  EXPECT_EQ(program.get("d"), "66");          // 16#42
  EXPECT_EQ(program.get("e"), "9029");        // 16#2345: the 1 does not fit
  EXPECT_EQ(program.get("f"), "2271560481");  // 16#87654321
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
