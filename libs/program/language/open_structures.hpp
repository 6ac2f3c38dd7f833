// SPDX-License-Identifier: Apache-2.0
// Which IF, WHILE and DO are open at a place of a program.
#pragma once

#include <array>
#include <cstdint>

#include "language/block.hpp"
#include "language/line_reader.hpp"

namespace trunnion::language {

inline constexpr std::size_t max_structures = 16;

/// An IF, WHILE or DO whose end has not been reached.
struct Structure {
  Statement kind = Statement::none;  ///< begin_if, begin_while or begin_do
  std::uint32_t label = 0;           ///< of begin_do
  TextPosition begin;                ///< its line
  bool divided = false;              ///< its ELSE was passed
};

/// The open structures, outermost first. What is open depends on the place alone, not on how the program got
/// there, so running over lines and searching through them keep it alike.
class OpenStructures {
 public:
  std::size_t size() const { return size_; }
  const Structure& top() const { return open_[size_ - 1]; }
  void clear() { size_ = 0; }
  /// Leaves the `size` outermost, with what divided() said of them.
  void cut(std::size_t size, std::uint16_t divided);
  /// Bit n of structure n: its ELSE was passed.
  std::uint16_t divided() const;
  /// Closes the innermost ones as long as their ELSE was passed.
  void close_divided() {
    while (size_ != 0 && top().divided) --size_;
  }

  /// Passes a line with `statement`; an end must fit the innermost structure.
  AlarmNumber pass(Statement statement, std::uint32_t label, TextPosition position);

  /// How many of the outermost structures both have in common.
  std::size_t common(const OpenStructures& other) const;

 private:
  bool inside(Statement kind) const { return size_ != 0 && top().kind == kind; }

  std::array<Structure, max_structures> open_{};
  std::size_t size_ = 0;
};

}  // namespace trunnion::language
