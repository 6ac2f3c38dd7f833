// SPDX-License-Identifier: Apache-2.0
// Any text as touches is taken, or refused with its place.
#include "calibration/touches.hpp"
#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused(
      "touches.txt", [&] { calibration::parse_touches(text, "touches.txt", geometry::ac_table()); });
  return 0;
}
