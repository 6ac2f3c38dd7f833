// SPDX-License-Identifier: Apache-2.0
// A program that is translated and run in a test.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "plc/library/register_names.hpp"
#include "plc/tools/source_run.hpp"

namespace trunnion::st {

/// PROGRAM main with these declarations and statements, behind `before` (types, functions).
class Translated {
 public:
  Translated(const std::string& declarations, const std::string& statements, const std::string& before = "")
      : Translated(before + "PROGRAM main\n" + declarations + "\n" + statements + "\nEND_PROGRAM\n", 0) {}
  Translated(const std::string& source, int)
      : compilation(compile({{"t.st", source}}, interface_registers())), run(checked(compilation)) {}

  /// One scan; the text of a fault or nothing.
  std::string scan(std::int64_t period = default_period) {
    const auto fault = run.scan("", period);
    return fault.kind == FaultKind::none ? "" : fault_line(compilation, run.machine(), fault);
  }
  std::string get(const std::string& path) const { return run.get(path); }
  void set(const std::string& path, const std::string& value) { run.set(path, value); }

  Compilation compilation;
  SourceRun run;

 private:
  static const Compilation& checked(const Compilation& compilation) {
    if (!compilation.good()) throw std::runtime_error(testing::PrintToString(compilation.lines()));
    return compilation;
  }
};

}  // namespace trunnion::st
