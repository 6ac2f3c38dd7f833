// SPDX-License-Identifier: Apache-2.0
// Any text is refused, or every number in it is a code of the list, in a group of its own kind.
#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "language/m_functions.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using trunnion::language::MFunctions;
  const std::string text(reinterpret_cast<const char*>(data), size);
  MFunctions functions;
  try {
    functions.add(text);
  } catch (const std::runtime_error&) {
    return 0;
  }
  for (std::size_t at = 0; at < text.size();) {
    if (std::isdigit(static_cast<unsigned char>(text[at])) == 0) {
      ++at;
      continue;
    }
    std::size_t length = 0;
    const auto code = std::stoul(text.substr(at), &length);
    if (code >= MFunctions::codes || !functions.has(static_cast<std::uint16_t>(code))) std::abort();
    at += length;
  }
  return 0;
}
