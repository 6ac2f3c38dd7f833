// SPDX-License-Identifier: Apache-2.0
#include "language/iso_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace trunnion::language {
namespace {

struct Instruction {
  std::string_view word;
  bool labelled = false;  // a number is behind it
  bool alone = false;     // and no further letter
};
constexpr std::array instructions = {
    Instruction{"IF"},
    Instruction{"ELSE"},
    Instruction{"ENDIF"},
    Instruction{"GOTO"},
    Instruction{"WHILE"},
    Instruction{"ENDW"},
    Instruction{"DO", true},
    Instruction{"END", true},
    Instruction{"CYCLE", true},
    Instruction{"DPRNT"},
    Instruction{"POPEN"},
    Instruction{"PCLOS"},
    Instruction{"WH", false, true},
    Instruction{"EN", true, true},
};

bool begins_instruction(const Scanner& scanner) {
  for (const Instruction& instruction : instructions) {
    if (!scanner.looking_at(instruction.word)) continue;
    Scanner rest = scanner;
    rest.advance(instruction.word.size());
    if (instruction.alone && rest.letters() != 0) continue;
    rest.skip_blanks();
    if (!instruction.labelled || is_digit(rest.peek(0))) return true;
  }
  return false;
}

bool begins_number(Scanner scanner) {
  scanner.skip_blanks();
  if (scanner.peek(0) == '-' || scanner.peek(0) == '+') {
    scanner.advance();
    scanner.skip_blanks();
  }
  const char c = scanner.peek(0);
  return is_digit(c) || c == '.' || c == '#' || c == '[';
}

// Text behind a lone % is the title of the tape. What could be words would be left out without a sign of it.
Fault skip_title(Scanner& scanner) {
  Scanner ahead = scanner;
  if (!skip_comments(ahead) || ahead.at_end() || ahead.peek() == ';') return {};
  if (begins_block(ahead)) return {AlarmNumber::words_behind_percent, ahead.offset()};
  while (!ahead.at_end()) ahead.advance();
  scanner = ahead;
  return {};
}

Fault skip_name(Scanner& scanner) {
  const std::uint16_t at = scanner.offset();
  while (!scanner.at_end() && scanner.peek() != '>') scanner.advance();
  if (scanner.at_end()) return {AlarmNumber::unknown_character, at};
  scanner.advance();
  return {};
}

}  // namespace

Fault read_head(Scanner& scanner, Head& head, std::uint32_t& number) {
  const std::uint16_t at = scanner.offset();
  const bool percent = scanner.peek() == '%';
  const auto behind = [&scanner](std::size_t bytes) {
    scanner.advance(bytes);
    scanner.skip_blanks();
    return scanner.peek(0);
  };
  char next = scanner.peek() == '<' ? '<' : behind(1);
  if (percent && (letter(next) == 'O' || next == ':')) {
    Scanner digits = scanner;
    digits.advance();
    digits.skip_blanks();
    if (is_digit(digits.peek(0))) next = behind(1);
  }
  if (!percent && next == '<') {
    head = Head::program;
    number = 0;
    return skip_name(scanner);
  }
  if (!is_digit(next)) {
    if (!percent) return {AlarmNumber::number_missing, at};
    head = Head::tape_mark;
    return skip_title(scanner);
  }
  const Decimal decimal = scanner.number();
  if (decimal.status == DecimalStatus::too_large) return {AlarmNumber::number_range, at};
  if (decimal.value != std::floor(decimal.value)) return {AlarmNumber::not_an_integer, at};
  head = Head::program;
  number = static_cast<std::uint32_t>(decimal.value);
  return {};
}

bool is_colon_head(std::string_view line) {
  Scanner scanner(line);
  while (skip_comments(scanner) && scanner.peek(0) == '/') read_skip(scanner, 0);
  return scanner.peek(0) == ':';
}

BlockSkip read_skip(Scanner& scanner, SkipLevels skip) {
  BlockSkip found;
  do {
    unsigned level = 1;
    scanner.advance();
    found.numbered = is_skip_level(scanner.peek(0));
    if (found.numbered) {
      level = static_cast<unsigned>(scanner.peek() - '0');
      scanner.advance();
    }
    found.active = found.active || ((skip >> (level - 1)) & 1u) != 0;
    scanner.skip_blanks();
  } while (found.numbered && scanner.peek(0) == '/' && is_skip_level(scanner.peek(1)));
  return found;
}

bool take_abbreviated(Scanner& scanner, std::string_view word) {
  if (scanner.take_word(word)) return true;
  return scanner.letters() == 2 && scanner.take_word(word.substr(0, 2));
}

bool begins_block(Scanner scanner) {
  const char c = scanner.peek(0);
  if (c == '#' || c == '/') return true;
  if (letter(c) == '\0') return false;
  if (letter(scanner.peek(1)) != '\0') return begins_instruction(scanner);
  scanner.advance();
  return begins_number(scanner);
}

Fault end_of_line(Scanner& scanner) {
  while (scanner.more() && (scanner.peek() == '(' || is_transmission(scanner.peek()))) {
    const std::uint16_t at = scanner.offset();
    if (scanner.peek() != '(') {
      scanner.advance();
    } else if (!scanner.skip_comment()) {
      return {AlarmNumber::open_comment, at};
    }
  }
  if (scanner.at_end() || scanner.peek() == ';') return {};
  return {AlarmNumber::text_behind_statement, scanner.offset()};
}

bool skip_comments(Scanner& scanner) {
  while (scanner.more()) {
    if (scanner.peek() == '(') {
      if (!scanner.skip_comment()) return false;
    } else if (is_transmission(scanner.peek())) {
      scanner.advance();
    } else {
      return true;
    }
  }
  return true;
}

bool nothing_follows(Scanner scanner) {
  return !skip_comments(scanner) || scanner.at_end() || scanner.peek() == ';';
}

Value number_in(std::string_view text) {
  const Decimal decimal = read_decimal(text.data(), text.data() + text.size());
  const bool whole = decimal.status == DecimalStatus::ok && decimal.end == text.data() + text.size();
  return whole ? Value::of(decimal.value) : Value();
}

// A line that is a number of several digits with a leading zero was O1000 once.
const char* missing_letter(std::string_view line, std::size_t at) {
  constexpr std::string_view blanks = " \t";
  const std::string_view number = line.substr(at);
  if (!is_digit(number[0]) && !(number.size() > 1 && is_digit(number[1]))) return nullptr;
  const bool begins = line.substr(0, at).find_first_not_of(blanks) == std::string_view::npos;
  const std::size_t digits = std::min(number.find_first_not_of("0123456789"), number.size());
  if (begins && number[0] == '0' && digits > 3) return "is the first 0 meant as the letter O?";
  return "a letter is missing before the number";
}

const char* no_comment(std::string_view line, std::size_t at) {
  return at > 0 && line[at - 1] == '/' ? "comments are in ( ) or behind ;" : nullptr;
}

std::size_t find_nested_comment(std::string_view line) {
  for (Scanner scanner(line); !scanner.at_end() && scanner.peek() != ';';) {
    if (scanner.peek() != '(') {
      scanner.advance();
      continue;
    }
    const std::size_t begin = scanner.offset();
    if (!scanner.skip_comment()) break;
    const auto comment = line.substr(begin, scanner.offset() - begin);
    const bool open = std::ranges::count(comment, '(') > std::ranges::count(comment, ')');
    if (open && scanner.rest().find(')') != std::string_view::npos) return begin + comment.find('(', 1);
  }
  return std::string_view::npos;
}

}  // namespace trunnion::language
