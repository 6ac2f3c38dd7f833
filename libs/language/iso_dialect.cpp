#include "language/iso_dialect.hpp"

#include <cmath>

#include "language/decimal.hpp"
#include "text/utf8.hpp"

namespace trunnion::language {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// One line from left to right.
class Scanner {
 public:
  explicit Scanner(std::string_view line) : begin_(line.data()), p_(begin_), end_(begin_ + line.size()) {}

  bool at_end() const { return p_ == end_; }
  char peek() const { return *p_; }
  void advance() { ++p_; }
  void skip_blanks() {
    while (p_ != end_ && is_blank(*p_)) ++p_;
  }
  std::uint16_t offset() const { return static_cast<std::uint16_t>(p_ - begin_); }
  Decimal number() {
    const Decimal decimal = read_decimal(p_, end_);
    p_ = decimal.end;
    return decimal;
  }
  /// Past the closing bracket; false when there is none.
  bool skip_comment() {
    while (p_ != end_ && *p_ != ')') ++p_;
    if (p_ == end_) return false;
    ++p_;
    return true;
  }

 private:
  const char* begin_;
  const char* p_;
  const char* end_;
};

Fault read_head(Scanner& scanner, Block& block) {
  const std::uint16_t at = scanner.offset();
  const bool percent = scanner.peek() == '%';
  scanner.advance();
  scanner.skip_blanks();
  if (scanner.at_end() || !is_digit(scanner.peek())) {
    if (!percent) return {AlarmNumber::number_missing, at};
    block.head = Head::tape_mark;
    return {};
  }
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value != std::floor(decimal.value)) return {AlarmNumber::not_an_integer, at};
  block.head = Head::program;
  block.program_number = static_cast<std::uint32_t>(decimal.value);
  return {};
}

Fault read_word(Scanner& scanner, char letter, Block& block) {
  const std::uint16_t at = scanner.offset();
  scanner.advance();
  scanner.skip_blanks();
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::missing) return {AlarmNumber::number_missing, at};
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (letter == 'G') {
    if (block.g_count == max_g_codes) return {AlarmNumber::too_many_codes, at};
    block.g[block.g_count++] = {decimal.value, at};
  } else if (letter == 'M') {
    if (block.m_count == max_m_codes) return {AlarmNumber::too_many_codes, at};
    block.m[block.m_count++] = {decimal.value, at};
  } else {
    if (letter == 'O') return {AlarmNumber::misplaced_head, at};
    if (block.has(letter)) return {AlarmNumber::letter_twice, at};
    const auto index = static_cast<std::size_t>(letter - 'A');
    block.letters |= Block::bit(letter);
    block.values[index] = decimal.value;
    block.offsets[index] = at;
  }
  return {};
}

}  // namespace

Fault IsoDialect::read_block(std::string_view line, Block& block) const {
  block.clear();
  if (const std::size_t valid = text::valid_utf8_prefix(line); valid != line.size()) {
    return {AlarmNumber::not_utf8, static_cast<std::uint16_t>(valid)};
  }
  Scanner scanner(line);
  scanner.skip_blanks();
  if (!scanner.at_end() && scanner.peek() == '/') {
    block.skip = true;
    scanner.advance();
    scanner.skip_blanks();
  }
  if (!scanner.at_end() && (scanner.peek() == '%' || scanner.peek() == 'O' || scanner.peek() == 'o')) {
    if (const Fault fault = read_head(scanner, block)) return fault;
  }
  for (scanner.skip_blanks(); !scanner.at_end(); scanner.skip_blanks()) {
    const char c = scanner.peek();
    const char upper = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (upper >= 'A' && upper <= 'Z') {
      if (const Fault fault = read_word(scanner, upper, block)) return fault;
    } else if (c == '(') {
      const std::uint16_t at = scanner.offset();
      if (!scanner.skip_comment()) return {AlarmNumber::open_comment, at};
    } else if (c == ';') {
      break;
    } else {
      const bool misplaced = c == '%' || c == '/';
      return {misplaced ? AlarmNumber::misplaced_head : AlarmNumber::unknown_character, scanner.offset()};
    }
  }
  return {};
}

std::optional<std::uint32_t> IsoDialect::program_head(std::string_view line) const {
  Scanner scanner(line);
  scanner.skip_blanks();
  if (scanner.at_end()) return std::nullopt;
  if (scanner.peek() != '%' && scanner.peek() != 'O' && scanner.peek() != 'o') return std::nullopt;
  Block block;
  if (read_head(scanner, block) || block.head != Head::program) return std::nullopt;
  return block.program_number;
}

}  // namespace trunnion::language
