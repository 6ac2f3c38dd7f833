// SPDX-License-Identifier: Apache-2.0
// Running compiled sources without a machine: programs, one function, tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plc/compile.hpp"
#include "plc/machine/machine.hpp"
#include "plc/tools/variables.hpp"

namespace trunnion::st {

inline constexpr std::int64_t default_budget = 1000000;   ///< statements of one scan
inline constexpr std::int64_t default_period = 10000000;  ///< ns between two scans

/// file:line:column: text of the fault
std::string fault_line(const Compilation& compilation, const Machine& machine, const Fault& fault);

class SourceRun {
 public:
  /// The compilation must be good.
  explicit SourceRun(const Compilation& compilation);

  /// variable := text; the path may be that of a variable, of an element a[1], of a field, or a register
  /// (%X0.3). Throws std::runtime_error.
  void set(const std::string& path, const std::string& text);
  std::string get(const std::string& path) const;
  /// One scan of every program, or of the entry with this name (in capitals). Time passes by `period` ns
  /// before each scan but the first.
  Fault scan(const std::string& entry, std::int64_t period = default_period,
             std::int64_t budget = default_budget);
  /// Every variable with its value: programs and globals, then the registers used.
  std::vector<std::pair<std::string, std::string>> variables() const;
  Machine& machine() { return machine_; }
  std::int64_t now() const { return now_; }

 private:
  const Compilation& compilation_;
  Variables variables_;
  Machine machine_;
  std::int64_t now_ = 0;
  bool first_ = true;
};

struct TestResult {
  std::string name, file;
  bool passed = false;
  std::string message;  ///< of a failure: place and reason
};

/// Every TEST, each with the initial values of everything.
std::vector<TestResult> run_tests(const Compilation& compilation);

}  // namespace trunnion::st
