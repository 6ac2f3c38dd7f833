// SPDX-License-Identifier: Apache-2.0
// Values, sums and conditions of the NUM dialect.
#pragma once

#include <cstdint>

#include "language/num_parameters.hpp"
#include "language/scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// Reads and evaluates at the position of a scanner:
/// - a value is a number, L0..L19, L100..L199, E80000 or another external parameter, by its number or as
///   E[MODULOB4], or [.RG80], the active code of the modal group of G80; with a sign. Variables that were
///   never written are 0.
/// - an expression is one value or several with + - * / between them, from left to right. The manuals at hand
///   do not state whether * binds closer than +, so * or / behind + or - is an alarm.
/// - a condition is two expressions with one of = <> < > <= >= between them.
class NumExpressionReader {
 public:
  NumExpressionReader(Scanner& scanner, const Variables& variables)
      : scanner_(scanner), variables_(variables) {}

  Fault value(double& result);
  Fault expression(double& result);
  Fault condition(bool& result);
  /// The number of a variable, behind its L; `at` is the place of the L.
  Fault variable(std::uint16_t at, std::uint32_t& number);
  /// A parameter, behind its E at `at`.
  Fault parameter(std::uint16_t at, ExternalPlace& place);

 private:
  Fault unsigned_value(double& result);
  Fault parameter_value(std::uint16_t at, double& result);
  Fault modal_value(std::uint16_t at, double& result);
  /// Digits, at least one and at most eight.
  bool digits(std::uint32_t& number);

  Scanner& scanner_;
  const Variables& variables_;
};

}  // namespace trunnion::language
