// SPDX-License-Identifier: Apache-2.0
// Any text as devices.yaml: it is refused with its place, or its program is translated and runs.
#include <cstdlib>

#include "plc/compile.hpp"
#include "plc/devices/device_file.hpp"
#include "plc/library/register_names.hpp"
#include "plc/machine/machine.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("devices.yaml", [&] {
    const auto devices = st::read_devices(text, "devices.yaml", st::interface_registers());
    for (const auto& one : devices.switches)
      if (!(one.low <= one.high) || one.input.bit < 0) std::abort();
    if (devices.program.empty()) return;
    const auto compiled = st::compile({{"devices.yaml", devices.program}}, st::interface_registers());
    if (!compiled.good()) std::abort();
    st::Machine machine(compiled.code);
    for (std::int64_t now = 0; now < 3; ++now)
      if (machine.run(0, now * 100000000, 100000).kind != st::FaultKind::none) std::abort();
  });
  return 0;
}
