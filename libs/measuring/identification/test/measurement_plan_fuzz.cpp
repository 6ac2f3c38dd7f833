// SPDX-License-Identifier: Apache-2.0
// Any text as plan.yaml is taken, or refused with its place.
#include "identification/measurement_plan.hpp"
#include "testing_support/refusal.hpp"
#include "truth/test/outline.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  static const auto machine = truth::outline(geometry::ac_table());
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("plan.yaml",
                                    [&] { identification::parse_plan(text, "plan.yaml", machine); });
  return 0;
}
