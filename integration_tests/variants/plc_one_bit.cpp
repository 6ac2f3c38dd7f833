// SPDX-License-Identifier: Apache-2.0
// A PLC that is wrong in one bit now and then, whatever the language of its programs: what a swap must find.
// Registers are written by the true code, which is compiled in here under another name and so takes the place
// of the library's.
#include "../../services/plc/core/address.hpp"
#define store store_right
#include "../../services/plc/core/address.cpp"  // NOLINT(bugprone-suspicious-include)
#undef store

#include "../../services/plc/service.hpp"

namespace trunnion::plc {

void store(Registers& registers, Address address, std::int64_t value) {
  static std::uint64_t count = 0;
  store_right(registers, address, value);
  if (++count % 30000 == 701) registers.r[500] ^= 1;
}

}  // namespace trunnion::plc

int main(int argc, char** argv) {
  using namespace trunnion;
  return service::service_main<plc::PlcService>(argc, argv, "plc");
}
