// SPDX-License-Identifier: Apache-2.0
// A suite is read or refused in one line that begins with its place.
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "verification/suite.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const auto suite = trunnion::verification::parse_suite(text, "suite.yaml");
    for (const auto& entry : suite.entries)
      if (entry.recording.empty()) std::abort();
  } catch (const std::runtime_error& e) {
    if (std::string(e.what()).rfind("suite.yaml:", 0) != 0) std::abort();
  }
  return 0;
}
