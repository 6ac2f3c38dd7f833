// SPDX-License-Identifier: Apache-2.0
// Paths of variables and values of them from outside: found in memory, or refused in one line.
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "plc/library/register_names.hpp"
#include "plc/tools/value_text.hpp"
#include "plc/tools/variables.hpp"

using namespace trunnion::st;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto compiled = compile(
      {{"f.st",
        "TYPE Pair : STRUCT low, high : INT; END_STRUCT; Mode : (idle, moving); END_TYPE\n"
        "PROGRAM main VAR t : TON; p : ARRAY[1..2, -1..1] OF Pair; m : Mode; s : STRING[9]; r : REAL; k AT "
        "%K15.6 "
        ": BOOL; END_VAR VAR CONSTANT c : INT := 1; END_VAR t(IN := k); p[1,0].low := c; END_PROGRAM"}},
      interface_registers());
  static const Variables variables(compiled);
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto at = text.find('=');
  try {
    for (const auto& found : variables.elements(text.substr(0, at))) {
      if (found.address + found.type->cells > compiled.code->initial.size()) std::abort();
      std::vector<std::uint64_t> cells(found.type->cells);
      if (at != std::string::npos) set_value(*found.type, text.substr(at + 1), cells);
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
