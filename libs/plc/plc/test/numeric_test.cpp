// SPDX-License-Identifier: Apache-2.0
// The numerical functions (IEC 61131-3:2013, tables 28 and 29) at values that tell them apart, in REAL and
// LREAL. Mathematical constants from tables (M. Abramowitz, I. Stegun, Handbook of Mathematical Functions),
// to 17 digits.
#include <cmath>

#include "translated.hpp"

namespace trunnion::st {
namespace {

struct Numeric {
  const char* expression;  ///< of x and y
  double x, y, value;
};

const Numeric numeric_rows[] = {
    {"SQRT(x)", 0.5, 0, 0.70710678118654752},
    {"SQRT(x)", 2, 0, 1.4142135623730950},
    {"LN(x)", 0.5, 0, -0.69314718055994531},
    {"LN(x)", 2, 0, 0.69314718055994531},
    {"LOG(x)", 0.5, 0, -0.30102999566398120},
    {"LOG(x)", 2, 0, 0.30102999566398120},
    {"EXP(x)", 0.5, 0, 1.6487212707001281},
    {"EXP(x)", 2, 0, 7.3890560989306502},
    {"SIN(x)", 0.5, 0, 0.47942553860420300},
    {"SIN(x)", 2, 0, 0.90929742682568170},
    {"COS(x)", 0.5, 0, 0.87758256189037272},
    {"COS(x)", 2, 0, -0.41614683654714239},
    {"TAN(x)", 0.5, 0, 0.54630248984379051},
    {"TAN(x)", 2, 0, -2.1850398632615190},
    {"ASIN(x)", 0.5, 0, 0.52359877559829887},  // pi / 6
    {"ASIN(x)", -1, 0, -1.5707963267948966},   // -pi / 2
    {"ACOS(x)", 0.5, 0, 1.0471975511965977},   // pi / 3
    {"ACOS(x)", -1, 0, 3.1415926535897932},
    {"ATAN(x)", 0.5, 0, 0.46364760900080612},
    {"ATAN(x)", 2, 0, 1.1071487177940905},
    {"ATAN2(x, y)", 1, 2, 0.46364760900080612},  // the angle of (2, 1)
    {"ATAN2(x, y)", 1, -2, 2.6779450445889871},  // pi - 0.4636...
    {"ATAN2(x, y)", -1, -2, -2.6779450445889871},
    {"ATAN2(x, y)", -1, 2, -0.46364760900080612},
    {"ATAN2(x, y)", 1, 0, 1.5707963267948966},
    {"ATAN2(X := y, Y := x)", 1, 2, 0.46364760900080612},
    {"EXPT(x, y)", 2, -2, 0.25},
    {"EXPT(x, y)", -2, 3, -8},
    {"EXPT(x, y)", 2, 0.5, 1.4142135623730950},
    {"EXPT(x, y)", 2, -0.5, 0.70710678118654752},
    {"EXPT(x, n)", 2, -2, 0.25},  // n is y as INT
    {"EXPT(x, n)", -2, 3, -8},
    {"x ** y", 2, -0.5, 0.70710678118654752},
    {"FLOOR(x)", 2.5, 0, 2},
    {"FLOOR(x)", -2.5, 0, -3},
    {"CEIL(x)", 2.5, 0, 3},
    {"CEIL(x)", -2.5, 0, -2},
    {"ABS(x)", -2.5, 0, 2.5},
    {"ABS(x)", 2.5, 0, 2.5},
    {"ADD(x, y)", 2.5, -0.25, 2.25},
    {"SUB(x, y)", 2.5, -0.25, 2.75},
    {"MUL(x, y)", 2.5, -0.25, -0.625},
    {"DIV(x, y)", 2.5, -0.25, -10},
};

// Two units in the last place: 2 ** -51 and 2 ** -22 of the value.
TEST(NumericalFunctions, GiveTheValuesOfTablesInRealAndLreal) {
  for (const bool single : {false, true}) {
    const std::string type = single ? "REAL" : "LREAL";
    for (const auto& row : numeric_rows) {
      SCOPED_TRACE(type + " " + row.expression + " " + std::to_string(row.x) + " " + std::to_string(row.y));
      Translated program("VAR x, y, result : " + type + "; n : INT; END_VAR",
                         std::string("result := ") + row.expression + ";");
      program.set("x", std::to_string(row.x));
      program.set("y", std::to_string(row.y));
      program.set("n", std::to_string(static_cast<int>(row.y)));
      EXPECT_EQ(program.scan(), "");
      const auto result = std::stod(program.get("result"));
      EXPECT_NEAR(result, row.value, std::abs(row.value) * std::ldexp(1, single ? -22 : -51));
    }
  }
}

}  // namespace
}  // namespace trunnion::st
