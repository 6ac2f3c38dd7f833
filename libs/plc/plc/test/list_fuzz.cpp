// SPDX-License-Identifier: Apache-2.0
// Whatever the text of an instruction list: it is translated or refused with a place; what is translated
// passes the verification and ends.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "plc/compile.hpp"
#include "plc/instruction_list/list_file.hpp"
#include "plc/library/register_names.hpp"
#include "plc/machine/machine.hpp"
#include "plc/machine/verify.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::st;
  const std::string text(reinterpret_cast<const char*>(data), size);
  SourceTree tree;
  Diagnostics diagnostics;
  import_list("main.il", text, 0, tree, diagnostics);
  // Compiling also reads the library, which takes a hundred times longer.
  if (diagnostics.errors() > 0) return 0;
  const auto result = compile({{"main.il", text}}, interface_registers());
  if (!result.good()) {
    bool error = false;
    for (const auto& diagnostic : result.diagnostics) error = error || diagnostic.severity == Severity::error;
    if (!error) std::abort();
    return 0;
  }
  if (!verify(*result.code).empty()) std::abort();
  Machine machine(result.code);
  for (std::size_t entry = 0; entry < result.code->entries.size() && entry < 4; ++entry)
    for (std::int64_t now = 0; now < 2; ++now) machine.run(entry, now * 100000000, 2000);
  return 0;
}
