// SPDX-License-Identifier: Apache-2.0
// Compiles instruction lists (IEC 61131-3:2003, 3.2, a subset; services/plc/README.md).
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "plc/instruction_list/lexer.hpp"
#include "plc/instruction_list/program.hpp"
#include "plc/instruction_list/symbols.hpp"

namespace trunnion::il {

/// Compiles the tasks of one PLC: an instance of a timer, counter or edge belongs to one place in all of
/// them.
class Compiler {
 public:
  explicit Compiler(const Symbols& symbols) : symbols_(symbols) {}
  /// Throws CompileError with file:line:column.
  Program compile(std::string_view source, const std::string& file);
  /// Of everything that was compiled: file:line:column: warning: ...
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  const Symbols& symbols_;
  std::map<std::pair<char, int>, std::string> instances_;  ///< kind and number -> place of the first use
  std::vector<std::string> warnings_;
};

}  // namespace trunnion::il
