// Expressions of macros: [#1+2*SIN[30]] and the like.
#pragma once

#include <array>
#include <cstdint>

#include "language/alarms.hpp"
#include "language/scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// Brackets and functions inside each other.
inline constexpr int max_brackets = 32;

/// A number so near to a whole one that only rounding can lie between, made whole.
double nearly_whole(double number);

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
};

/// Reads and evaluates expressions where a scanner stands. Angles are degrees.
///
/// What binds first: functions and signs; * / MOD AND; + - OR XOR; the comparisons EQ NE GT GE LT LE or
/// == != <> > >= < <=, which give 1 or 0; && ; ||. AND OR XOR work on the bits of whole numbers, && and ||
/// and NOT or ! on true (not 0) and false (0). ROUND goes away from zero at a half, FIX towards zero, FUP
/// away from it. ATAN of one argument gives -90..90, of two, ATAN[y,x] or ATAN[y]/[x], 0..360 without 360. A
/// vacant value counts as 0, but EQ and NE tell it from 0, and a variable alone as an expression hands its
/// vacancy on. A result beyond the numbers of a double, or outside a function's domain, is a fault.
class ExpressionReader {
 public:
  ExpressionReader(Scanner& scanner, const Variables& variables) : scanner_(scanner), variables_(variables) {}

  /// A whole expression, as behind = and in brackets.
  Fault expression(Value& value);
  /// A number, #variable or [expression] with a sign: what may follow the letter of a word.
  Fault operand(Value& value);
  /// The number of a variable, behind its #.
  Fault variable_number(double& number);

 private:
  bool binary(int lowest, Value& value);
  bool unary(Value& value);
  bool primary(Value& value);
  bool bracketed(Value& value);
  bool variable(Value& value);
  bool variable_index(double& number);
  bool function(Value& value);
  bool call(Function function, std::uint16_t at, Value& value);
  bool fail(AlarmNumber number, std::uint16_t at) {
    fault_ = {number, at};
    return false;
  }

  Scanner& scanner_;
  const Variables& variables_;
  Fault fault_;
  int brackets_ = 0;
};

}  // namespace trunnion::language
