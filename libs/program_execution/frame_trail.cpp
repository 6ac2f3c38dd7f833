// SPDX-License-Identifier: Apache-2.0
#include "program_execution/frame_trail.hpp"

#include <algorithm>

namespace trunnion::program_execution {

void FrameTrail::add(std::uint32_t sequence, const language::ProgramFrame& frame) {
  (*entries_)[count_ % capacity] = {sequence, frame};
  ++count_;
}

const language::ProgramFrame* FrameTrail::at(std::uint32_t sequence) const {
  if (count_ == 0) return nullptr;
  // Sequences rise: the last entry that is not above.
  std::uint64_t low = count_ - std::min<std::uint64_t>(count_, capacity), high = count_ - 1;
  while (low < high) {
    const std::uint64_t middle = low + (high - low + 1) / 2;
    if (entry(middle).sequence <= sequence)
      low = middle;
    else
      high = middle - 1;
  }
  return &entry(low).frame;
}

const language::ProgramFrame* FrameTrail::newest() const {
  return count_ == 0 ? nullptr : &entry(count_ - 1).frame;
}

}  // namespace trunnion::program_execution
