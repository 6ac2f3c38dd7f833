// SPDX-License-Identifier: Apache-2.0
// Any text as messages.yaml: it is refused with its place, or every message has a number and a text.
#include <cstdlib>

#include "plc/devices/message_file.hpp"
#include "testing_support/refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion;
  const std::string text(reinterpret_cast<const char*>(data), size);
  testing_support::taken_or_refused("messages.yaml", [&] {
    for (const auto& [number, message] : st::read_messages(text, "messages.yaml"))
      if (number >= st::most_messages || message.text.empty() || message.text.size() > 140) std::abort();
  });
  return 0;
}
