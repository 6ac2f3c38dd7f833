// SPDX-License-Identifier: Apache-2.0
// One line of program text from left to right.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "language/decimal.hpp"

namespace trunnion::language {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }
/// A control character that a transmission or a printer leaves in a text and that means nothing: STX, ETX,
/// EOT, VT, FF, DC1 to DC4, SUB and DEL. NUL is none of them: in a damaged file it stands for what is lost.
constexpr bool is_transmission(char c) {
  switch (c) {
    case '\x02':
    case '\x03':
    case '\x04':
    case '\v':
    case '\f':
    case '\x11':
    case '\x12':
    case '\x13':
    case '\x14':
    case '\x1a':
    case '\x7f':
      return true;
    default:
      return false;
  }
}
/// A to Z for a letter of either case, else 0.
constexpr char letter(char c) {
  if (c >= 'a' && c <= 'z') return static_cast<char>(c - 'a' + 'A');
  return c >= 'A' && c <= 'Z' ? c : '\0';
}

class Scanner {
 public:
  explicit Scanner(std::string_view line, std::size_t from = 0)
      : begin_(line.data()), p_(begin_ + from), end_(begin_ + line.size()) {}

  bool at_end() const { return p_ == end_; }
  char peek() const { return *p_; }
  /// The byte `ahead` of the next one, or 0 behind the end.
  char peek(std::size_t ahead) const {
    return ahead < static_cast<std::size_t>(end_ - p_) ? p_[ahead] : '\0';
  }
  void advance(std::size_t bytes = 1) { p_ += bytes; }
  void skip_blanks() {
    while (p_ != end_ && is_blank(*p_)) ++p_;
  }
  /// Skips blanks; whether something is there.
  bool more() {
    skip_blanks();
    return p_ != end_;
  }
  /// Skips blanks and takes `c` if it is next.
  bool take(char c) {
    if (!more() || *p_ != c) return false;
    ++p_;
    return true;
  }
  /// Letters in sequence from here on.
  std::size_t letters() const {
    std::size_t count = 0;
    while (p_ + count != end_ && letter(p_[count]) != '\0') ++count;
    return count;
  }
  /// Whether `word`, in capitals, comes next in either case.
  bool looking_at(std::string_view word) const {
    if (static_cast<std::size_t>(end_ - p_) < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
      if (letter(p_[i]) != word[i]) return false;
    }
    return true;
  }
  bool take_word(std::string_view word) {
    if (!looking_at(word)) return false;
    p_ += word.size();
    return true;
  }
  std::string_view rest() const { return {p_, static_cast<std::size_t>(end_ - p_)}; }
  std::uint16_t offset() const { return static_cast<std::uint16_t>(p_ - begin_); }
  Decimal number() {
    const Decimal decimal = read_decimal(p_, end_);
    p_ = decimal.end;
    return decimal;
  }
  /// Past the ) of the comment that begins here, which may have comments within it: (A (B) C). Where they are
  /// not all closed the first ) ends it, with further ones directly behind. False, and at the end, when there
  /// is none.
  bool skip_comment() {
    constexpr std::ptrdiff_t farthest = 256;  // behind the first ), so that no line takes long
    const char* first = nullptr;
    std::size_t open = 0, within = 0;
    for (const char* p = p_; p != end_ && (first == nullptr || p - first < farthest); ++p) {
      if (*p == '(') ++open;
      if (*p != ')') continue;
      if (first == nullptr) first = p + 1, within = open - 1;
      if (--open > 0) continue;
      p_ = p + 1;
      return true;
    }
    p_ = first == nullptr ? end_ : first;
    for (; first != nullptr && within > 0; --within) {
      const char* behind = p_;
      while (behind != end_ && is_blank(*behind)) ++behind;
      if (behind == end_ || *behind != ')') break;
      p_ = behind + 1;
    }
    return first != nullptr;
  }

 private:
  const char* begin_;
  const char* p_;
  const char* end_;
};

}  // namespace trunnion::language
