// SPDX-License-Identifier: Apache-2.0
// Any bytes at all: the reader ends, keeps its memory bounded and says how it ended.
#include <cstdlib>

#include "recording/mcap_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trunnion::recording;
  MemorySource source({data, size});
  Reader reader(source, 1 << 20);
  MessageView message;
  std::uint64_t sum = 0;
  while (reader.next(message)) {
    for (const auto byte : message.data) sum += byte;
    if (message.channel == nullptr) std::abort();
  }
  if (reader.ending() == Ending::none || (reader.ending() == Ending::complete) != reader.problem().empty())
    std::abort();
  if (!reader.damages().empty() && reader.ending() != Ending::damaged) std::abort();
  for (const auto& damage : reader.damages())
    if (damage.begin > damage.end || damage.end > size || text_of(damage).empty()) std::abort();
  volatile auto keep = sum;
  (void)keep;
  return 0;
}
