// The commands of one block, waiting to be taken.
#pragma once

#include <array>
#include <cstddef>

#include "language/canonical.hpp"

namespace trunnion::language {

/// A block gives at most S, T, a tool length, two moves and 8 M; the queue has room for them and is empty
/// before the next block.
class CommandQueue {
 public:
  bool empty() const { return first_ == size_; }
  void clear() { first_ = size_ = 0; }
  Command& push() { return commands_[size_++]; }
  const Command& pop() { return commands_[first_++]; }

 private:
  std::array<Command, 16> commands_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace trunnion::language
