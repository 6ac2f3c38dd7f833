// SPDX-License-Identifier: Apache-2.0
#include "head_scan.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace trunnion::program {
namespace {

constexpr std::size_t longest_head = 16384, longest_line = 256;

struct HeadLine {
  enum class Kind : std::uint8_t {
    nothing,    ///< empty or a comment
    tape_mark,  ///< a lone %, with its title
    head,
    block,
    text,  ///< none of them
  };
  Kind kind = Kind::nothing;
  bool percent = false;
  std::optional<machine::ProgramNumber> number;
};

char at(std::string_view text, std::size_t i) { return i < text.size() ? text[i] : '\0'; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

// What has no print, blanks among it, and bytes that no block begins with, a byte order mark among them.
bool passes(char c) { return static_cast<unsigned char>(c) <= ' ' || static_cast<unsigned char>(c) >= 0x7f; }

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text[0] == ' ' || text[0] == '\t')) text.remove_prefix(1);
  return text;
}

std::string_view without_comments(std::string_view line) {
  while (!line.empty() && (passes(line[0]) || line[0] == '('))
    line.remove_prefix(line[0] == '(' ? std::min(line.find(')'), line.size() - 1) + 1 : 1);
  return line;
}

bool begins_block(std::string_view line) {
  if (line[0] == '#' || line[0] == '/' || line[0] == '<') return true;
  if (!is_letter(line[0])) return false;
  const char number = at(without_blanks(line.substr(1)), 0);
  return is_digit(number) || std::string_view(".+-#[<").find(number) != std::string_view::npos;
}

HeadLine read_line(std::string_view text) {
  HeadLine line;
  text = without_comments(text);
  if (text.empty() || text[0] == ';' || text[0] == '*') return line;
  // Files of Okuma controls begin with $NAME.MIN%.
  if (text[0] == '$' && text[text.find_last_not_of(" \t")] == '%') text = "%";
  line.percent = text[0] == '%';
  auto digits = text;
  if (line.percent) digits = without_blanks(digits.substr(1));
  if (at(digits, 0) == 'O' || at(digits, 0) == 'o' || at(digits, 0) == ':')
    digits = without_blanks(digits.substr(1));
  else if (!line.percent)
    digits = {};
  if (is_digit(at(digits, 0))) {
    line.kind = HeadLine::Kind::head;
    std::string head = "O";
    head += digits;
    line.number = machine::number_in_head(head);
  } else if (line.percent) {
    line.kind = HeadLine::Kind::tape_mark;
  } else {
    line.kind = begins_block(text) ? HeadLine::Kind::block : HeadLine::Kind::text;
  }
  return line;
}

}  // namespace

void HeadScan::add(std::span<const std::uint8_t> bytes) {
  for (const auto byte : bytes) {
    if (done_) return;
    if (byte == '\n' || byte == '\r')
      end_line();
    else if (line_.size() < longest_line)
      line_ += static_cast<char>(byte);
    done_ = done_ || ++bytes_ == longest_head;
  }
}

void HeadScan::end_line() {
  const HeadLine line = read_line(line_);
  line_.clear();
  switch (line.kind) {
    case HeadLine::Kind::nothing:
      return;
    case HeadLine::Kind::tape_mark:
      behind_text_ = false;
      return;
    case HeadLine::Kind::text:
      behind_text_ = true;
      return;
    case HeadLine::Kind::head:
      if (!behind_text_ || line.percent) number_ = line.number;
      break;
    case HeadLine::Kind::block:
      break;
  }
  done_ = true;
}

std::optional<machine::ProgramNumber> HeadScan::number() const {
  if (done_) return number_;
  HeadScan whole = *this;
  whole.end_line();
  return whole.number_;
}

}  // namespace trunnion::program
