// SPDX-License-Identifier: Apache-2.0
// The states in which the commands of a program were made. The display needs that of the command being
// executed, and the interpreter is ahead of it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "language/canonical.hpp"
#include "language/program_frame.hpp"
#include "motion/blended_path.hpp"

namespace trunnion::program_execution {

/// Keeps the newest `capacity` states. Allocates when it is made and never again.
template <class State, std::size_t Capacity>
class CommandTrail {
 public:
  static constexpr std::size_t capacity = Capacity;

  void clear() { count_ = 0; }
  /// The command `sequence`, and those behind it, are in this state. Sequences rise.
  void add(std::uint32_t sequence, const State& state) {
    entries_[count_ % capacity] = {sequence, state};
    ++count_;
  }
  /// The state of a command; the oldest there is when its own is not kept any more, nothing when there is
  /// none.
  const State* at(std::uint32_t sequence) const {
    if (count_ == 0) return nullptr;
    // The last entry that is not above.
    std::uint64_t low = count_ - std::min<std::uint64_t>(count_, capacity), high = count_ - 1;
    while (low < high) {
      const std::uint64_t middle = low + (high - low + 1) / 2;
      if (entry(middle).sequence <= sequence)
        low = middle;
      else
        high = middle - 1;
    }
    return &entry(low).state;
  }
  const State* newest() const { return count_ == 0 ? nullptr : &entry(count_ - 1).state; }

 private:
  struct Entry {
    std::uint32_t sequence = 0;
    State state;
  };
  const Entry& entry(std::uint64_t number) const { return entries_[number % capacity]; }

  std::vector<Entry> entries_{capacity};
  std::uint64_t count_ = 0;  // added since clear()
};

/// Programs change their frame rarely, and their modal state in every block when lines and arcs take turns:
/// then there are as many states as the path holds blocks.
using FrameTrail = CommandTrail<language::ProgramFrame, 1024>;
using ModalTrail = CommandTrail<language::ModalState, motion::BlendedPath::capacity>;

}  // namespace trunnion::program_execution
