// SPDX-License-Identifier: Apache-2.0
// Any text as certificate and as key: facts, or one line that says what is wrong.
#include <cstdlib>
#include <stdexcept>

#include "access/certificate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::access;
  const std::string text(reinterpret_cast<const char*>(data), size);
  constexpr std::int64_t now = 1'800'000'000;
  const bool usable = certificate_problem({text, text}, now).empty();
  try {
    const auto facts = certificate_facts(text);
    if (facts.fingerprint.size() != 95) std::abort();  // 32 bytes of two digits, with colons between
    if (usable && (facts.begins > now || facts.ends <= now)) std::abort();
  } catch (const std::runtime_error&) {
    if (usable) std::abort();
  }
  return 0;
}
