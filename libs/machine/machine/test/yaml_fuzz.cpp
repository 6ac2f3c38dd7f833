// SPDX-License-Identifier: Apache-2.0
// Any text as machine.yaml or parameters.yaml: it is taken, or refused with the place in the file.
#include <cstdlib>
#include <string_view>

#include "machine/machine.hpp"
#include "machine/parameters.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("m/machine.yaml", [&] {
    const auto config = machine::parse_machine(text, "m");
    if (config.domain > 100 || config.port == 0 || config.channels > 32) std::abort();
    for (std::size_t i = 0; i < config.services.size(); ++i)
      if (config.services[i].instance != i + 1) std::abort();
  });
  testing_support::taken_or_refused("parameters.yaml", [&] {
    const auto values = machine::read_parameter_text(text, "parameters.yaml");
    if (machine::read_parameter_text(machine::write_parameter_text(values), "written") != values)
      std::abort();
  });
  return 0;
}
