// SPDX-License-Identifier: Apache-2.0
// Any text as modbus.yaml: it is refused with its place, or all its elements have registers, inputs those of
// X.
#include <cstdlib>

#include "plc/devices/modbus_file.hpp"
#include "testing_support/refusal.hpp"

namespace {

using namespace trunnion;

void check(const std::vector<st::ModbusBlock>& blocks, bool inputs) {
  for (const auto& block : blocks)
    for (std::uint32_t i = 0; i < block.count; ++i) {
      const auto at = st::place_of(block, i);
      if (at.index >= st::info(at.area).count || (inputs && at.area != st::Area::x)) std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("modbus.yaml", [&] {
    const auto file = st::read_modbus(text, "modbus.yaml");
    for (const auto& device : file.devices) check(device.inputs, true), check(device.outputs, false);
    if (file.server) check(file.server->inputs, true), check(file.server->outputs, false);
  });
  return 0;
}
