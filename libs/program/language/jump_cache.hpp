// SPDX-License-Identifier: Apache-2.0
// Where jumps of a program lead, so that a loop is searched once and not at every turn.
#pragma once

#include <array>
#include <cstdint>

#include "language/line_reader.hpp"

namespace trunnion::language {

/// Remembers the newest jump for each of a fixed number of places; what it forgets is searched again.
class JumpCache {
 public:
  struct Target {
    TextPosition position;
    std::size_t open = 0;       ///< how many of the structures open at the jump are open there
    bool at_else_if = false;    ///< position is an ELSEIF whose condition decides
    std::uint16_t divided = 0;  ///< OpenStructures::divided() there
  };

  void clear() { entries_.fill({}); }

  const Target* find(const TextSource* source, std::uint64_t from, std::uint64_t key) const {
    const Entry& entry = entries_[slot(from, key)];
    return entry.source == source && entry.from == from && entry.key == key ? &entry.target : nullptr;
  }
  void store(const TextSource* source, std::uint64_t from, std::uint64_t key, const Target& target) {
    entries_[slot(from, key)] = {source, from, key, target};
  }

 private:
  struct Entry {
    const TextSource* source = nullptr;
    std::uint64_t from = 0;
    std::uint64_t key = 0;
    Target target;
  };
  static constexpr std::size_t entries = 512;
  static std::size_t slot(std::uint64_t from, std::uint64_t key) {
    return static_cast<std::size_t>(((from + key * 31) * 0x9e3779b97f4a7c15ull) >> 55);
  }
  std::array<Entry, entries> entries_{};
};

}  // namespace trunnion::language
