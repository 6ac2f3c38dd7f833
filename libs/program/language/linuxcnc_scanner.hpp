// SPDX-License-Identifier: Apache-2.0
// One line of LinuxCNC's language from left to right: blanks and tabs mean nothing outside comments, not even
// within words and numbers.
#pragma once

#include <cstdint>
#include <string_view>

#include "language/decimal.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {

class LinuxcncScanner {
 public:
  explicit LinuxcncScanner(std::string_view line, std::size_t from = 0)
      : begin_(line.data()), p_(begin_ + from), end_(begin_ + line.size()) {
    skip_blanks();
  }

  bool at_end() const { return p_ == end_; }
  /// The next character, 0 at the end.
  char peek() const { return p_ != end_ ? *p_ : '\0'; }
  /// A to Z for a letter of either case, else 0.
  char peek_letter() const { return letter(peek()); }
  void advance() {
    ++p_;
    skip_blanks();
  }
  bool take(char c) {
    if (at_end() || *p_ != c) return false;
    advance();
    return true;
  }
  /// Takes `word`, in capitals, if it comes next in either case.
  bool take_word(std::string_view word) {
    const char* p = p_;
    for (const char c : word) {
      if (p == end_ || letter(*p) != c) return false;
      p = behind_blanks(p + 1);
    }
    p_ = p;
    return true;
  }
  std::uint16_t offset() const { return static_cast<std::uint16_t>(p_ - begin_); }
  std::string_view rest() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }

  /// With a sign; nothing is taken when there is none.
  Decimal number();

  /// Past a comment in parentheses, whose text is `comment` then; false when it is not closed. Comments
  /// within it are as in Scanner::skip_comment(); LinuxCNC refuses them.
  bool take_comment(std::string_view& comment) {
    Scanner text(rest());
    if (!text.skip_comment()) return false;
    comment = rest().substr(1, text.offset() - 2u);
    p_ += text.offset();
    skip_blanks();
    return true;
  }

 private:
  const char* behind_blanks(const char* p) const {
    while (p != end_ && is_blank(*p)) ++p;
    return p;
  }
  void skip_blanks() { p_ = behind_blanks(p_); }

  const char* begin_;
  const char* p_;
  const char* end_;
};

}  // namespace trunnion::language
