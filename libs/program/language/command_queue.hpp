// SPDX-License-Identifier: Apache-2.0
// The commands of one block, waiting to be taken.
#pragma once

#include <array>
#include <cstddef>

#include "language/canonical.hpp"

namespace trunnion::language {

/// A block gives at most S, T, a tool length, five moves and its M codes by itself. The end of cutter radius
/// compensation releases up to 64 more, each move with up to three around a corner: what does
/// not fit waits there until the queue is empty again.
class CommandQueue {
 public:
  static constexpr std::size_t capacity = 48;
  bool empty() const { return first_ == size_; }
  /// More than half full: no place to unpack what is held elsewhere.
  bool crowded() const { return size_ > capacity / 2; }
  /// The pieces of a move, besides all that a block gives.
  bool has_room_for(std::size_t pieces) const { return size_ + pieces <= capacity / 2; }
  void clear() { first_ = size_ = 0; }
  Command& push() { return commands_[size_++]; }
  const Command& pop() { return commands_[first_++]; }

 private:
  std::array<Command, capacity> commands_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace trunnion::language
