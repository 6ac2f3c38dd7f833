// SPDX-License-Identifier: Apache-2.0
// Any text is read as tables that are written and read again with the same text, or refused with its place.
#include <cstdlib>

#include "compensation/text_tables.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("tables", [&] {
    const auto tables = error_tables::parse_tables(text, "tables");
    const auto written = error_tables::text_of(tables);
    if (error_tables::text_of(error_tables::parse_tables(written, "tables")) != written) std::abort();
  });
  return 0;
}
