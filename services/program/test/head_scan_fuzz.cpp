// SPDX-License-Identifier: Apache-2.0
// Any bytes: no crash, and the same program number whatever the pieces in which they come.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "head_scan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using trunnion::program::HeadScan;
  if (size == 0) return 0;
  const std::span text(data + 1, size - 1);
  const std::size_t piece = 1 + data[0] % 64u;
  HeadScan whole, pieces;
  whole.add(text);
  for (std::size_t at = 0; at < text.size(); at += piece)
    pieces.add(text.subspan(at, std::min(piece, text.size() - at)));
  if (whole.number() != pieces.number()) std::abort();
  return 0;
}
