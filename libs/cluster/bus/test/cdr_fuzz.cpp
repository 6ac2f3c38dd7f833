// SPDX-License-Identifier: Apache-2.0
// Any bytes as the message of any topic: they are refused, or become the JSON of a value of that type.
#include <cstdlib>

#include "bus/cdr.hpp"
#include "bus/json.hpp"
#include "bus/registry.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::bus;
  if (size == 0) return 0;
  const auto& topics = all_topics();
  // The first byte chooses the topic; the header that every message has is not the fuzzer's to find.
  Bytes message = {0, 1, 0, 0};
  message.insert(message.end(), data + 1, data + size);
  try {
    const auto json = topics[data[0] % topics.size()].to_json(message);
    if (!json.is_object() || json.empty()) std::abort();
    if (text_of(json).empty()) std::abort();
  } catch (const CdrError&) {
  }
  return 0;
}
