// SPDX-License-Identifier: Apache-2.0
// The axes that a command of a program homes (G28.2): which comes next, and which are done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace trunnion::channel {

/// Axes are named by language::Axis, bit a for Axis a.
class ProgramHoming {
 public:
  /// Command `sequence`, from 1, names `axes`. The same command again, behind a feed hold, goes on with those
  /// that are left.
  void begin(std::uint32_t sequence, std::uint32_t axes);
  /// X Y Z, then U V W, then A B C, whatever was written; nothing: all are done.
  std::optional<std::size_t> next() const;
  void pass(std::size_t axis);
  void end() { *this = {}; }

  /// From begin() to end(), also while the program is held.
  bool under_way() const { return sequence_ != 0; }
  /// For the operator, "X, Z" in the order of next().
  std::string letters_left() const { return letters(left_); }
  std::string done_letters() const { return letters(done_); }

 private:
  static std::string letters(std::uint32_t axes);

  std::uint32_t sequence_ = 0;
  std::uint32_t left_ = 0, done_ = 0;
};

}  // namespace trunnion::channel
