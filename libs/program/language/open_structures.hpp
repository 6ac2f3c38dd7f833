// SPDX-License-Identifier: Apache-2.0
// Which IF, WHILE, DO and REPEAT are open at a place of a program.
#pragma once

#include <array>
#include <cstdint>

#include "language/block.hpp"
#include "language/line_reader.hpp"

namespace trunnion::language {

inline constexpr std::size_t max_structures = 16;

/// A structure whose end has not been reached.
struct Structure {
  Statement kind = Statement::none;  ///< begin_if, begin_while, begin_do, begin_repeat or begin_until
  std::uint64_t key = 0;             ///< Block::key()
  TextPosition begin;                ///< its line
  bool divided = false;              ///< its ELSE was passed
  std::uint32_t remaining = 0;       ///< repetitions behind this one
  TextPosition body;                 ///< of begin_repeat: the line behind it

  /// A part or the end of this structure may have `other`. Names of O words are above the numbers of DO.
  bool has(std::uint64_t other) const { return key <= UINT32_MAX || key == other; }
};

/// The open structures, outermost first. What is open depends on the place alone, not on how the program got
/// there, so running over lines and searching through them keep it alike.
class OpenStructures {
 public:
  std::size_t size() const { return size_; }
  const Structure& top() const { return open_[size_ - 1]; }
  const Structure& at(std::size_t index) const { return open_[index]; }
  void clear() { size_ = 0; }
  /// Leaves the `size` outermost, with what divided() said of them.
  void cut(std::size_t size, std::uint16_t divided);
  /// Bit n of structure n: its ELSE was passed.
  std::uint16_t divided() const;
  /// Closes the innermost ones as long as their ELSE was passed.
  void close_divided() {
    while (size_ != 0 && top().divided) --size_;
  }

  /// The statement itself, but of a WHILE that ends the innermost loop, which has no condition yet:
  /// end_until.
  Statement meaning(Statement statement, std::uint64_t key) const {
    const bool ends = statement == Statement::begin_while && inside(Statement::begin_until) &&
                      key > UINT32_MAX && top().key == key;
    return ends ? Statement::end_until : statement;
  }

  /// Passes a line with `statement`; an end must fit the innermost structure.
  AlarmNumber pass(Statement statement, std::uint64_t key, TextPosition position);

  /// The innermost structure, whose lines begin at `body`, runs `times` in all.
  void repeat(std::uint32_t times, TextPosition body) {
    open_[size_ - 1].remaining = times - 1;
    open_[size_ - 1].body = body;
  }
  /// At the end of the innermost structure: it runs once more, from top().body.
  bool runs_again(std::uint64_t key);
  /// Tells apart how often the open structures have still to run.
  std::uint64_t repetitions() const;

  /// The innermost WHILE or DO of an O word, size() when none is open.
  std::size_t find_loop(std::uint64_t key) const;

  /// How many of the outermost structures both have in common.
  std::size_t common(const OpenStructures& other) const;

 private:
  bool inside(Statement kind) const { return size_ != 0 && top().kind == kind; }
  bool ends(Statement begin, std::uint64_t key) const { return inside(begin) && top().has(key); }

  std::array<Structure, max_structures> open_{};
  std::size_t size_ = 0;
};

}  // namespace trunnion::language
