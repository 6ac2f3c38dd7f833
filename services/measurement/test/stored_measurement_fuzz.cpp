// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "stored_measurement.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::measurement;
  try {
    const auto measurement = parse_measurement({reinterpret_cast<const char*>(data), size});
    // What was read is written and read again as the same.
    if (text_of(parse_measurement(text_of(measurement))) != text_of(measurement)) __builtin_trap();
  } catch (const std::runtime_error&) {
  }
  return 0;
}
