// SPDX-License-Identifier: Apache-2.0
#include "language/spaced_number.hpp"

#include <array>
#include <cstddef>

namespace trunnion::language {
namespace {

/// What of a spaced number was taken so far, without its blanks.
class NumberText {
 public:
  explicit NumberText(Scanner& scanner) : scanner_(scanner) {}

  bool take_one_of(char a, char b) {
    scanner_.skip_blanks();
    const bool there = scanner_.peek(0) == a || scanner_.peek(0) == b;
    if (there) take();
    return there;
  }
  void take_digits() {
    scanner_.skip_blanks();
    while (is_digit(scanner_.peek(0)) && size_ < text_.size()) take();
  }
  Decimal value() const { return read_decimal(text_.data(), text_.data() + size_); }

 private:
  void take() {
    if (size_ == text_.size()) return;
    text_[size_++] = scanner_.peek();
    scanner_.advance();
  }

  Scanner& scanner_;
  std::array<char, 66> text_{};
  std::size_t size_ = 0;
};

}  // namespace

Decimal read_spaced_number(Scanner& scanner) {
  Scanner ahead = scanner;
  NumberText text(ahead);
  text.take_one_of('-', '+');
  text.take_digits();
  if (text.take_one_of('.', '.')) text.take_digits();
  const Decimal decimal = text.value();
  if (decimal.status != DecimalStatus::missing) scanner = ahead;
  return decimal;
}

}  // namespace trunnion::language
