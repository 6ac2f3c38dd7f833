// SPDX-License-Identifier: Apache-2.0
// Any text as tools.yaml, work_offsets.yaml or the kept active set: it is taken, and written back the same,
// or refused with the place in the file.
#include <cstdlib>

#include "parameter_store/active_set.hpp"
#include "parameter_store/tool_tables.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  using namespace trunnion::parameters;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("tools.yaml", [&] {
    std::uint64_t revision = 0, again = 0;
    const auto tools = tool_tables::read_tools(text, "tools.yaml", revision);
    if (tool_tables::read_tools(tool_tables::write_tools(tools, revision), "written", again) != tools ||
        again != revision)
      std::abort();
  });
  testing_support::taken_or_refused("work_offsets.yaml", [&] {
    std::uint64_t revision = 0, again = 0;
    const auto offsets = tool_tables::read_offsets(text, "work_offsets.yaml", revision);
    if (tool_tables::read_offsets(tool_tables::write_offsets(offsets, revision), "written", again) !=
            offsets ||
        again != revision)
      std::abort();
  });
  testing_support::taken_or_refused("active.yaml", [&] {
    const auto active = read_active(text, "active.yaml");
    const auto again = read_active(write_active(active), "written");
    if (again.boot != active.boot || again.revision != active.revision || again.previous != active.previous ||
        again.resets != active.resets || again.values != active.values)
      std::abort();
  });
  return 0;
}
