// SPDX-License-Identifier: Apache-2.0
// Values, expressions and parameters of the LinuxCNC dialect.
#pragma once

#include <cstdint>

#include "language/arithmetic.hpp"
#include "language/linuxcnc_parameters.hpp"
#include "language/linuxcnc_scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// Numbers nearer than this to a whole one count as whole, where a whole one is needed.
inline constexpr double whole_enough = 1e-4;

/// Which parameter follows a #.
struct ParameterName {
  NameKey name = 0;          ///< 0: it has a number
  std::uint32_t number = 0;  ///< from 1
  bool global = false;       ///< the name begins with _
  bool of_files = false;     ///< it names an entry of an INI file or a pin of HAL
  std::uint16_t at = 0;      ///< byte of the #
};

/// Reads and evaluates at the position of a scanner. A value is a number, #parameter, [expression] or a
/// function, with signs. What binds first in an expression: signs and functions; **; * / MOD; + -; EQ NE GT
/// GE LT LE; AND OR XOR, which know 0 and not 0. Operators of one rank go from left to right. Angles are
/// degrees, ATAN[y]/[x] gives -180 to 180; FIX and FUP round down and up; EQ NE GE LE take numbers that are
/// nearer than 1e-6 for equal. A parameter with a number is 0 until it is written, one with a name must have
/// been.
class LinuxcncExpression {
 public:
  LinuxcncExpression(LinuxcncScanner& scanner, const Variables& variables)
      : scanner_(scanner), variables_(variables) {}

  Fault value(double& result) { return read_value(result) ? Fault{} : fault_; }
  /// In brackets.
  Fault expression(double& result) { return bracketed(result) ? Fault{} : fault_; }
  /// The number behind an O, within 0.0001 of a whole one.
  Fault whole(std::uint16_t at, double highest, std::uint32_t& result);
  /// Behind a # at `at`.
  Fault parameter(std::uint16_t at, ParameterName& result) {
    return read_parameter(at, result) ? Fault{} : fault_;
  }
  /// What a parameter is now.
  Fault read(const ParameterName& parameter, double& result) const;

 private:
  bool binary(int lowest, double& result);
  bool read_value(double& result);
  bool unsigned_value(double& result);
  bool bracketed(double& result);
  bool read_parameter(std::uint16_t at, ParameterName& result);
  bool read_name(ParameterName& result);
  bool function(double& result);
  bool exists(double& result);
  bool whole_value(std::uint16_t at, double highest, std::uint32_t& result);
  AlarmNumber read_number(std::uint32_t number, double& result) const;
  AlarmNumber read_control(LinuxcncValue which, std::uint32_t index, double& result) const;
  bool fail(AlarmNumber number, std::uint16_t at, const char* detail = nullptr) {
    fault_ = {number, at, detail};
    return false;
  }

  LinuxcncScanner& scanner_;
  const Variables& variables_;
  Fault fault_;
  int depth_ = 0;
};

}  // namespace trunnion::language
