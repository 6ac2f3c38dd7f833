// SPDX-License-Identifier: Apache-2.0
// Any text as io.yaml: it is refused with its place, or every pin has a name that HAL takes and an address.
#include <cstdlib>

#include "plc/devices/hal_pins.hpp"
#include "testing_support/refusal.hpp"

namespace {

void check(const std::vector<trunnion::st::HalPins>& blocks) {
  for (const auto& block : blocks) {
    if (block.pins.empty() || block.address + block.pins.size() > 65536) std::abort();
    for (const auto& name : block.pins)
      if (name.empty() || name.size() > 32) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  trunnion::testing_support::taken_or_refused("io.yaml", [&] {
    const auto file = trunnion::st::read_hal_pins(text, "io.yaml");
    check(file.outputs), check(file.inputs);
  });
  return 0;
}
