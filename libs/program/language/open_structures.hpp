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
};

/// The open structures, outermost first. What is open depends on the place alone, not on how the program got
/// there, so running over lines and searching through them keep it alike.
class OpenStructures {
 public:
  std::size_t size() const { return size_; }
  const Structure& top() const { return open_[size_ - 1]; }
  void clear() { size_ = 0; }
  void cut(std::size_t size) { size_ = size; }

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
