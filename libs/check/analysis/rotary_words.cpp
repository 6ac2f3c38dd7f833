// SPDX-License-Identifier: Apache-2.0
#include "analysis/rotary_words.hpp"

#include <string_view>

#include "language/canonical.hpp"
#include "language/line_reader.hpp"
#include "language/scanner.hpp"

namespace trunnion::analysis {
namespace {

using language::Scanner;

/// Behind the letter of a word.
bool has_number(Scanner scanner) {
  scanner.skip_blanks();
  if (scanner.peek(0) == '-' || scanner.peek(0) == '+') scanner.advance();
  scanner.skip_blanks();
  const char c = scanner.peek(0);
  return language::is_digit(c) || c == '.' || c == '#' || c == '[';
}

/// G65, G66 and G66.1, behind the G.
bool calls_macro(Scanner scanner) {
  scanner.skip_blanks();
  const double code = scanner.number().value;
  return code == 65 || code == 66 || code == 66.1;
}

std::uint16_t rotary_words_of(std::string_view line) {
  unsigned axes = 0;
  bool behind_comma = false;
  for (Scanner scanner(line); scanner.more();) {
    const char c = scanner.peek();
    const std::size_t letters = scanner.letters();
    if (c == ';' || scanner.looking_at("DPRNT")) break;
    if (c == '(') {
      if (!scanner.skip_comment()) break;
      continue;
    }
    scanner.advance(letters == 0 ? 1 : letters);
    const bool word = letters == 1 && !behind_comma && has_number(scanner);
    behind_comma = c == ',';
    if (!word) continue;
    const char name = language::letter(c);
    if (name == 'G' && calls_macro(scanner)) return 0;
    if (name >= 'A' && name <= 'C') axes |= 1u << (language::A + static_cast<unsigned>(name - 'A'));
  }
  return static_cast<std::uint16_t>(axes);
}

}  // namespace

std::uint16_t rotary_words(language::TextSource& text) {
  language::LineReader reader;
  reader.seek(text, {});
  std::string_view line;
  unsigned axes = 0;
  while (reader.next(line) == language::LineReader::Status::line) axes |= rotary_words_of(line);
  return static_cast<std::uint16_t>(axes);
}

}  // namespace trunnion::analysis
