// SPDX-License-Identifier: Apache-2.0
// What a line of the ISO dialect is when it is not executed.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "language/iso_dialect.hpp"
#include "language/iso_line.hpp"
#include "language/scanner.hpp"

namespace trunnion::language {
namespace {

std::uint32_t plain_number(Scanner& scanner) {
  std::uint32_t number = 0;
  for (scanner.skip_blanks(); !scanner.at_end() && is_digit(scanner.peek()); scanner.advance()) {
    number = number > highest_label ? number : number * 10 + static_cast<unsigned>(scanner.peek() - '0');
  }
  return number;
}

/// Whether `take` takes something in the rest of the line outside a comment; the scanner is then behind it.
template <class Take>
bool find_where(Scanner& scanner, const Take& take) {
  while (!scanner.at_end() && scanner.peek() != ';') {
    if (take(scanner)) return true;
    if (scanner.peek() != '(') {
      scanner.advance();
    } else if (!scanner.skip_comment()) {
      return false;
    }
  }
  return false;
}

bool find_word(Scanner& scanner, std::string_view word) {
  return find_where(scanner, [word](Scanner& at) { return at.take_word(word); });
}

/// Past comments and block skips; false where the rest of the line does not count.
bool pass_skips(Scanner& scanner, SkipLevels skip) {
  while (skip_comments(scanner)) {
    if (scanner.at_end() || scanner.peek() != '/') return true;
    if (read_skip(scanner, skip).active) return false;
  }
  return false;
}

/// Of ELSE and the ends the scanner is behind the word then, and behind the number of END.
Statement outline_statement(Scanner& scanner, std::uint32_t& label) {
  if (scanner.take_word("IF")) {
    Scanner rest = scanner;
    if (find_word(rest, "GOTO")) return Statement::none;
    rest = scanner;
    const bool then = find_where(rest, [](Scanner& at) { return take_abbreviated(at, "THEN"); });
    if (then && !nothing_follows(rest)) return Statement::none;
    return Statement::begin_if;
  }
  if (take_abbreviated(scanner, "WHILE")) {
    if (!find_word(scanner, "DO") || !scanner.more() || !is_digit(scanner.peek()))
      return Statement::begin_while;
    label = plain_number(scanner);
    return Statement::begin_do;
  }
  if (scanner.take_word("DO")) {
    label = plain_number(scanner);
    return Statement::begin_do;
  }
  if (scanner.take_word("ENDW")) return Statement::end_while;
  if (scanner.take_word("ENDIF")) return Statement::end_if;
  if (take_abbreviated(scanner, "END")) {
    Scanner digits = scanner;
    label = plain_number(digits);
    scanner.skip_blanks();
    scanner.number();
    return Statement::end_do;
  }
  if (scanner.take_word("ELSEIF")) return Statement::else_if;
  if (scanner.take_word("ELSE")) return Statement::else_;
  return Statement::none;
}

/// O1234, :1234 or <NAME>.
bool numbered_head(Scanner scanner) {
  if (scanner.peek() == '<') return true;
  if (!begins_head(scanner.peek())) return false;
  scanner.advance();
  scanner.skip_blanks();
  return is_digit(scanner.peek(0)) || scanner.peek(0) == '<';
}

/// OWASHER or O FINAL PART-1 (TEXT): O, names of which none could begin a block, and comments.
bool is_named_head(std::string_view line) {
  Scanner scanner(line);
  if (!scanner.more() || letter(scanner.peek()) != 'O') return false;
  scanner.advance();
  if (!scanner.more() || letter(scanner.peek()) == '\0') return false;
  const auto in_name = [](char c) {
    return letter(c) != '\0' || is_digit(c) || c == '_' || c == '-' || c == '.';
  };
  while (!nothing_follows(scanner)) {
    scanner.skip_blanks();
    if (!in_name(scanner.peek()) || begins_block(scanner)) return false;
    while (!scanner.at_end() && in_name(scanner.peek())) scanner.advance();
  }
  return true;
}

/// A jump may lead behind the line, so that read_block does not see it.
bool is_passed(Statement statement) {
  return statement == Statement::else_ || statement == Statement::end_if ||
         statement == Statement::end_while || statement == Statement::end_do;
}

}  // namespace

Outline IsoDialect::outline(std::string_view line, SkipLevels skip) const {
  Outline outline;
  Scanner scanner(line);
  if (!scanner.more() || scanner.peek() == '*') return outline;
  if (!pass_skips(scanner, skip) || scanner.at_end()) return outline;
  if (begins_head(scanner.peek())) {
    if (read_head(scanner, outline.head, outline.program_number)) outline.head = Head::none;
    if (!pass_skips(scanner, skip) || scanner.at_end()) return outline;
  }
  if (letter(scanner.peek()) == 'N') {
    scanner.advance();
    scanner.skip_blanks();
    const Decimal number = scanner.number();
    if (number.status != DecimalStatus::ok) return outline;
    if (!pass_skips(scanner, skip)) return outline;
    if (number.value >= 0 && number.value == std::floor(number.value)) {
      outline.sequence_number = static_cast<std::uint32_t>(number.value);
    }
  }
  if (!scanner.at_end() && letter(scanner.peek()) != '\0' && letter(scanner.peek(1)) != '\0') {
    outline.statement = outline_statement(scanner, outline.label);
    if (is_passed(outline.statement)) outline.behind = end_of_line(scanner);
  }
  return outline;
}

Leader IsoDialect::leader(std::string_view line) const {
  Leader leader;
  leader.named = is_named_head(line);
  // Text with NUL in it is one of two bytes a character: a program that cannot be read, and no leader.
  const std::size_t printed = line.find_first_not_of('\0');
  if (printed != std::string_view::npos && line.find('\0', printed) != std::string_view::npos) return leader;
  // Files of Okuma controls begin with $NAME.MIN%.
  const std::size_t last = line.find_last_not_of(" \t");
  if (line.starts_with('$') && line[last] == '%') return {true, last};
  for (Scanner scanner(line); !scanner.at_end();) {
    const char c = scanner.peek();
    if (c == '%') leader.mark = scanner.offset();
    if (c == '%' || c == ';' || c == '*') break;
    if (c == '(') {
      if (!scanner.skip_comment()) break;
      continue;
    }
    if (numbered_head(scanner) || begins_block(scanner)) return leader;
    if (letter(c) != '\0' || is_digit(c)) break;
    scanner.advance();
  }
  leader.passes = true;
  return leader;
}

}  // namespace trunnion::language
