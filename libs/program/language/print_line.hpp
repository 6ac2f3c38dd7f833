// SPDX-License-Identifier: Apache-2.0
// What DPRNT prints: texts and the values of variables as one line of a file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "language/scanner.hpp"
#include "language/variables.hpp"

namespace trunnion::language {

/// A line that is printed, without its end. No allocation.
class PrintLine {
 public:
  static constexpr std::size_t longest = 200;  ///< bytes

  void clear() { size_ = 0; }
  std::string_view view() const { return {text_.data(), size_}; }
  /// False, and nothing is added, when there is no room.
  bool add(std::string_view part);
  /// With `behind` digits behind the point, which is left out when there are none; more digits before it than
  /// `before` make the number longer. With `blanks` a place for the sign and those of the digits that are not
  /// there are blanks.
  bool add(double value, unsigned before, unsigned behind, bool blanks);

 private:
  std::array<char, longest> text_{};
  std::size_t size_ = 0;
};

/// Reads `[X#1[53] text]` at `scanner`, which is behind DPRNT, with the values of the variables as they are
/// now. `*` is a blank; what a file of text cannot have is ?.
Fault read_print(Scanner& scanner, const Variables& variables, PrintLine& line);

}  // namespace trunnion::language
