// SPDX-License-Identifier: Apache-2.0
#include "language/head_dialect.hpp"

#include "language/scanner.hpp"

namespace trunnion::language {
namespace {

bool is_space(char c) { return is_blank(c) || c == '\r' || c == '\0'; }

void skip_digits(Scanner& scanner) {
  while (!scanner.at_end() && (is_digit(scanner.peek()) || scanner.peek() == '.')) scanner.advance();
}

/// `comment` begins at byte `at` of its line.
HeadLine read_comment(std::string_view comment, std::size_t at) {
  constexpr std::string_view key = "DIALECT";
  Scanner scanner(comment);
  if (!scanner.more() || !scanner.take_word(key)) return {};
  if (!scanner.take(':') && !scanner.take('=')) return {};
  scanner.skip_blanks();
  const std::size_t begin = scanner.offset();
  std::size_t end = comment.size();
  while (end > begin && is_space(comment[end - 1])) --end;
  const auto dialect = canonical::dialect_named(comment.substr(begin, end - begin));
  const auto offset = static_cast<std::uint16_t>(at + begin);
  if (!dialect) return {HeadLine::Kind::unknown, ProgramDialect::iso, offset};
  return {HeadLine::Kind::named, *dialect, offset};
}

/// Past <NAME>; false at another character, and when it is open.
bool pass_name(Scanner& scanner) {
  if (scanner.at_end() || scanner.peek() != '<') return false;
  while (!scanner.at_end() && scanner.peek() != '>') scanner.advance();
  if (scanner.at_end()) return false;
  scanner.advance();
  return true;
}

/// Past a mark of the tape, the number or name of a program, or the number of a block; false when the line
/// has something else here.
bool skip_mark(Scanner& scanner) {
  const char c = scanner.peek();
  const char upper = letter(c);
  if (c == '<') return pass_name(scanner);
  if (c != '%' && c != ':' && upper != 'O' && upper != 'N') return false;
  scanner.advance();
  scanner.skip_blanks();
  if (upper == 'O' && pass_name(scanner)) return true;
  const bool numbered = !scanner.at_end() && is_digit(scanner.peek());
  skip_digits(scanner);
  return numbered || c == '%';
}

}  // namespace

HeadLine read_head_line(std::string_view line) {
  Scanner scanner(line);
  while (true) {
    while (!scanner.at_end() && is_space(scanner.peek())) scanner.advance();
    if (scanner.at_end()) return {};
    const std::size_t at = scanner.offset();
    const char c = scanner.peek();
    if (c == ';' || (c == '*' && at == 0)) return read_comment(line.substr(at + 1), at + 1);
    if (c == '(') {
      // An open comment is an alarm when the line is executed.
      const std::size_t end = line.find(')', at);
      const HeadLine found = read_comment(line.substr(at + 1, end - at - 1), at + 1);
      if (found.kind != HeadLine::Kind::open || end == std::string_view::npos) return found;
      scanner.advance(end + 1 - at);
      continue;
    }
    if (!skip_mark(scanner)) return {HeadLine::Kind::closed, ProgramDialect::iso, 0};
  }
}

ProgramDialect dialect_without_head(const TextSource& text, const Environment& environment) {
  if (const auto own = text.dialect()) return *own;
  if (const auto by_name = environment.dialect_by_name(text.name())) return *by_name;
  return environment.program_dialect();
}

}  // namespace trunnion::language
