// SPDX-License-Identifier: Apache-2.0
// Structured Text (IEC 61131-3:2013), PLCopen XML and instruction lists to byte code.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plc/machine/byte_code.hpp"
#include "plc/semantics/cross_reference.hpp"
#include "plc/semantics/statement_count.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {

struct Source {
  std::string name;  ///< as messages show it
  std::string text;
};

/// A variable in memory, for display and for a retained state.
struct Symbol {
  std::string path;  ///< program.variable or variable
  const Type* type = nullptr;
  std::uint32_t address = 0;
  int bit = -1;  ///< of a register
  bool is_register = false;
  std::string declared;     ///< its name in the cross reference: POU.variable
  std::size_t name_at = 0;  ///< in the path, behind the program; of a global variable 0
};

struct FunctionInterface {
  struct Parameter {
    std::string name;  ///< as written
    const Type* type = nullptr;
    std::uint32_t address = 0;
    bool output = false, in_out = false;
  };
  std::string name;
  std::vector<Parameter> parameters;
  const Type* result = nullptr;
  std::uint32_t result_address = 0, routine = 0, base = 0;
};

/// How many statements a program of a task executes at most in one run.
struct TaskStatements {
  std::string name;  ///< fast, main, simulation or another PROGRAM
  std::optional<std::int64_t> most;
  Position unbounded;  ///< without `most`: a loop of which it is not known how often it runs
};

struct Compilation {
  std::shared_ptr<const ByteCode> code;  ///< nothing when there are errors
  std::vector<Diagnostic> diagnostics;
  std::vector<std::string> files;
  std::vector<Symbol> symbols;         ///< variables of programs and global ones, in the order of memory
  std::vector<std::string> constants;  ///< paths of constants, which have no place in memory
  std::vector<FunctionInterface> functions;
  std::vector<TaskStatements> tasks;
  std::vector<std::string> implementers;  ///< blocks that values of interfaces name by their number
  std::vector<CrossReference> references;
  std::shared_ptr<const void> types;  ///< owns what symbols point to

  /// One line for each error and warning.
  std::vector<std::string> lines() const;
  bool good() const { return code != nullptr; }
  /// Identifies names, types and addresses of the variables: memory of another layout must not be used.
  std::uint64_t layout() const;
};

/// Whether a file of a directory with PLC programs is compiled: .st except *_test.st, .exp, .xml, and the
/// instruction lists fast.il and main.il.
bool is_compiled(const std::string& name);

/// Whether it is an export of CoDeSys 2.3 (.exp), whose units have its rules for operands of different types.
bool is_codesys_export(const std::string& name);

/// All sources together; `registers` are names of registers that a program may use without declaration. For
/// the call of a function alone, `entries_for_functions` adds an entry per function.
Compilation compile(const std::vector<Source>& sources, const RegisterNames& registers,
                    bool entries_for_functions = false);

}  // namespace trunnion::st
