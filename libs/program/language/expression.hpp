// SPDX-License-Identifier: Apache-2.0
// Expressions of macros: [#1+2*SIN[30]] and the like.
#pragma once

#include <array>
#include <cstdint>

#include "language/arithmetic.hpp"
#include "language/scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// Brackets and functions inside each other.
inline constexpr int max_brackets = 32;

/// Reads and evaluates expressions at the position of a scanner. Angles are degrees.
///
/// What binds first: functions and signs; * / MOD AND; + - OR XOR; the comparisons EQ NE GT GE LT LE or
/// == != <> > >= < <=, which give 1 or 0; && ; ||. AND OR XOR work on the bits of whole numbers, && and ||
/// and NOT or ! on true (not 0) and false (0). ROUND goes away from zero at a half, FIX towards zero, FUP
/// away from it. ATAN of one argument gives -90..90, of two, ATAN[y,x] or ATAN[y]/[x], 0..360 without 360. A
/// vacant value counts as 0, but EQ and NE distinguish it from 0, and a variable alone as an expression hands
/// its vacancy on. A result beyond the numbers of a double, or outside a function's domain, is a fault.
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
  /// The parameter of that number.
  bool parameter(const Value& of, std::uint16_t at, Value& value);
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
