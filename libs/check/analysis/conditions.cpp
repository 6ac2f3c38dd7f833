// SPDX-License-Identifier: Apache-2.0
// How the conditions of a program are written.
#include <array>
#include <string_view>

#include "analysis/block_checks.hpp"
#include "language/iso_line.hpp"
#include "language/scanner.hpp"

namespace trunnion::analysis {
namespace {

using language::Scanner;

constexpr std::array<std::string_view, 6> comparisons = {"EQ", "NE", "GT", "GE", "LT", "LE"};
constexpr std::array<std::string_view, 3> connections = {"AND", "OR", "XOR"};
constexpr std::array<std::string_view, 2> condition_words = {"ELSEIF", "IF"};
constexpr std::array<std::string_view, 2> words_behind = {"GOTO", "DO"};

template <std::size_t size>
bool take_any(Scanner& scanner, const std::array<std::string_view, size>& words) {
  for (const auto word : words)
    if (scanner.take_word(word)) return true;
  return false;
}

/// Past blanks, comments, the block skip and the sequence number.
bool skip_to_statement(Scanner& scanner) {
  for (;;) {
    if (!language::skip_comments(scanner) || scanner.at_end()) return false;
    const char c = scanner.peek();
    const bool numbered = language::letter(c) == 'N' && language::is_digit(scanner.peek(1));
    if (c != '/' && !language::is_digit(c) && !numbered) return true;
    scanner.advance();
  }
}

bool compares(Scanner& scanner) {
  if (take_any(scanner, comparisons)) return true;
  const char c = scanner.peek(0);
  const bool sign = c == '<' || c == '>' || ((c == '=' || c == '!') && scanner.peek(1) == '=');
  if (!sign) return false;
  const char second = scanner.peek(1);
  scanner.advance(second == '=' || second == '>' ? 2u : 1u);
  return true;
}

}  // namespace

std::string_view condition_of(std::string_view line) {
  Scanner scanner(line);
  if (!skip_to_statement(scanner)) return {};
  if (!take_any(scanner, condition_words) && !language::take_abbreviated(scanner, "WHILE")) return {};
  const std::size_t from = scanner.offset();
  while (!scanner.at_end() && scanner.peek() != ';' && scanner.peek() != '(') {
    const std::size_t here = scanner.offset();
    if (take_any(scanner, words_behind) || language::take_abbreviated(scanner, "THEN"))
      return line.substr(from, here - from);
    scanner.advance();
  }
  return line.substr(from, scanner.offset() - from);
}

bool in_brackets(std::string_view condition) {
  const auto first = condition.find_first_not_of(" \t");
  return first != std::string_view::npos && condition[first] == '[';
}

// Names of functions are before a bracket or other letters: LE of a comparison is not that of a name.
bool mixes_order(std::string_view condition) {
  struct Level {
    bool compared = false, connected = false;
  };
  constexpr std::size_t deepest = 40;
  std::array<Level, deepest> levels{};
  std::size_t depth = 0;
  Scanner scanner(condition);
  while (scanner.more()) {
    Level& level = levels[depth];
    if (scanner.peek() == '[') {
      if (++depth == deepest) return false;
      levels[depth] = Level{};
      scanner.advance();
    } else if (scanner.peek() == ']') {
      if (depth == 0) return false;
      --depth;
      scanner.advance();
    } else if (compares(scanner)) {
      level.compared = true;
    } else if (take_any(scanner, connections)) {
      level.connected = true;
    } else if (const std::size_t name = scanner.letters(); name != 0) {
      scanner.advance(name);
    } else {
      scanner.advance();
    }
    if (level.compared && level.connected) return true;
  }
  return false;
}

}  // namespace trunnion::analysis
