// SPDX-License-Identifier: Apache-2.0
// The operators and functions of macro expressions.
#pragma once

#include <array>
#include <cstdint>

#include "language/variables.hpp"

namespace trunnion::language {

/// A number so near to a whole one that only rounding can lie between, made whole.
double nearly_whole(double number);

enum class Operator : std::uint8_t {
  multiply,
  divide,
  modulo,
  bit_and,
  add,
  subtract,
  bit_or,
  bit_xor,
  equal,
  not_equal,
  greater,
  greater_equal,
  less,
  less_equal,
  both,
  either,
};

/// Names of functions and what they do, for the manual.
enum class Function : std::uint8_t {
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  square_root,
  absolute,
  round,
  fix,
  fup,
  logarithm,
  exponential,
  power,
  whole,
  sign,
  negation,
  argument,
  from_decimal_digits,  ///< BIN
  to_decimal_digits,    ///< BCD
  with_point,           ///< ADP
  parameter,            ///< PRM
};

struct FunctionName {
  const char* name;
  Function function;
  const char* meaning;
};

inline constexpr std::array function_names = {
    FunctionName{"SIN", Function::sine, "sine of degrees"},
    FunctionName{"COS", Function::cosine, "cosine of degrees"},
    FunctionName{"TAN", Function::tangent, "tangent of degrees"},
    FunctionName{"ASIN", Function::arc_sine, "-90 to 90 degrees"},
    FunctionName{"ACOS", Function::arc_cosine, "0 to 180 degrees"},
    FunctionName{"ATAN", Function::arc_tangent,
                 "ATAN[a] -90 to 90 degrees; ATAN[y,x] or ATAN[y]/[x] 0 to 360 degrees"},
    FunctionName{"SQRT", Function::square_root, "square root"},
    FunctionName{"SQR", Function::square_root, "square root"},
    FunctionName{"ABS", Function::absolute, "magnitude"},
    FunctionName{"ROUND", Function::round, "nearest whole number, away from zero at a half"},
    FunctionName{"RND", Function::round, "as ROUND"},
    FunctionName{"FIX", Function::fix, "whole number towards zero"},
    FunctionName{"FUP", Function::fup, "whole number away from zero"},
    FunctionName{"LN", Function::logarithm, "natural logarithm"},
    FunctionName{"EXP", Function::exponential, "power of e"},
    FunctionName{"POW", Function::power, "POW[a,b]: a to the power of b"},
    FunctionName{"INT", Function::whole, "as FIX"},
    FunctionName{"SIGN", Function::sign, "-1, 0 or 1"},
    FunctionName{"NOT", Function::negation, "1 for 0, else 0; also !"},
    FunctionName{"AR", Function::argument,
                 "AR[#n]: 0 when the call did not give variable n, else 90 or 91 as G90 or G91 was active"},
    FunctionName{
        "BIN", Function::from_decimal_digits,
        "number of at most 8 decimal digits, each of which has 4 bits of the argument: BIN[18] is 12"},
    FunctionName{"BCD", Function::to_decimal_digits, "the inverse, of 0 to 99999999: BCD[12] is 18"},
    FunctionName{"ADP", Function::with_point,
                 "its argument: numbers mean the same with and without a decimal point"},
    FunctionName{
        "PRM", Function::parameter,
        "PRM[n]: parameter n of this machine (parameters.md) as it was when the program began; numbers "
        "of other controls, bits and axes do not exist"},
};

/// What the operator gives; the alarm when it gives no finite number.
AlarmNumber apply(Operator operation, const Value& a, const Value& b, double& result);
/// What a function of one number gives, likewise; angles in degrees.
AlarmNumber apply(Function function, double x, double& result);
/// The same of the functions of two numbers: arc_tangent of y and x, 0..360, and power.
AlarmNumber apply(Function function, double a, double b, double& result);

}  // namespace trunnion::language
