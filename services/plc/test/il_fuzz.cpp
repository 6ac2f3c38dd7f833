// SPDX-License-Identifier: Apache-2.0
// Whatever the text: it compiles or is refused with a place, and what compiles runs to its end.
#include <cstddef>
#include <cstdint>

#include "execution.hpp"
#include "plc/instruction_list/compiler.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::plc;
  trunnion::il::Compiler compiler(trunnion::il::interface_symbols());
  try {
    const auto program = compiler.compile({reinterpret_cast<const char*>(data), size}, "f");
    static Registers registers;
    static Blocks blocks;
    registers = {};
    blocks = {};
    for (std::uint64_t now = 0; now < 3; ++now) execute(program, registers, blocks, now * 100);
  } catch (const trunnion::il::CompileError&) {
  }
  return 0;
}
