// SPDX-License-Identifier: Apache-2.0
// The coordinate frame in which each command of a program was programmed. The display needs the frame of the
// command being executed, and the interpreter is ahead of it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "language/program_frame.hpp"

namespace trunnion::program_execution {

/// Keeps the newest `capacity` frames. Allocates when it is made and never again.
class FrameTrail {
 public:
  static constexpr std::size_t capacity = 1024;

  void clear() { count_ = 0; }
  /// The command `sequence`, and those behind it, are in this frame.
  void add(std::uint32_t sequence, const language::ProgramFrame& frame);
  /// The frame of a command; the oldest there is when its own is not kept any more, nothing when there is
  /// none.
  const language::ProgramFrame* at(std::uint32_t sequence) const;
  const language::ProgramFrame* newest() const;

 private:
  struct Entry {
    std::uint32_t sequence = 0;
    language::ProgramFrame frame;
  };
  const Entry& entry(std::uint64_t number) const { return (*entries_)[number % capacity]; }

  std::unique_ptr<std::array<Entry, capacity>> entries_ = std::make_unique<std::array<Entry, capacity>>();
  std::uint64_t count_ = 0;  // added since clear()
};

}  // namespace trunnion::program_execution
