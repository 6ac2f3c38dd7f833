// SPDX-License-Identifier: Apache-2.0
// A PLC whose arithmetic is wrong in one bit: what a swap must find. Its programs are executed by the true
// code, which is compiled in here under another name and so stands in the place of the library's.
#define execute execute_right
#include "../../services/plc/src/execution.cpp"  // NOLINT(bugprone-suspicious-include)
#undef execute

#include "../../services/plc/service.hpp"

namespace trunnion::plc {

void execute(const Program& program, Registers& registers, Blocks& blocks, std::uint64_t now) {
  execute_right(program, registers, blocks, now);
  if (now % 1000 == 701) registers.r[500] ^= 1;
}

}  // namespace trunnion::plc

int main(int argc, char** argv) {
  using namespace trunnion;
  return service::service_main<plc::PlcService>(argc, argv, "plc");
}
