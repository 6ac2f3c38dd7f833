// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "plc/syntax/token.hpp"

namespace trunnion::st {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

int digit_value(char c) {
  if (digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return 99;
}

constexpr std::array<std::string_view, 16> time_prefixes = {
    "T",  "TIME",          "LT", "LTIME", "D",    "DATE",         "TOD", "TIME_OF_DAY",
    "DT", "DATE_AND_TIME", "LD", "LDATE", "LTOD", "LTIME_OF_DAY", "LDT", "LDATE_AND_TIME"};
constexpr std::array<std::string_view, 8> long_symbols = {":=", "=>", "<=", ">=", "<>", "**", "..", "?="};

class Lexer {
 public:
  Lexer(std::string_view source, std::uint16_t file, Diagnostics& diagnostics)
      : source_(source), file_(file), diagnostics_(diagnostics) {}

  std::vector<Token> run() {
    while (skip_space()) word();
    tokens_.push_back({TokenKind::end, "the end of the file", "", 10, here()});
    return std::move(tokens_);
  }

 private:
  Position here() const { return {file_, line_, static_cast<std::uint32_t>(i_ - line_start_) + 1}; }
  char at(std::size_t offset = 0) const { return i_ + offset < source_.size() ? source_[i_ + offset] : '\0'; }
  void step() {
    if (source_[i_] == '\n') ++line_, line_start_ = i_ + 1;
    ++i_;
  }

  /// False at the end of the source.
  bool skip_space() {
    while (i_ < source_.size()) {
      const char c = at();
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f') {
        step();
      } else if (c == '/' && at(1) == '/') {
        while (i_ < source_.size() && at() != '\n') ++i_;
      } else if ((c == '(' && at(1) == '*') || (c == '/' && at(1) == '*')) {
        comment(c, c == '(' ? ')' : '/');
      } else {
        return true;
      }
    }
    return false;
  }

  /// Comments of one kind nest (IEC 61131-3:2013, table 3). Whoever does not know it has taken the end of an
  /// inner one for the end of the outer.
  void comment(char first, char last) {
    const Position begin = here();
    std::string inner;
    int open = 0;
    do {
      if (at() == first && at(1) == '*') {
        if (open == 1 && inner.empty()) inner = place(here());
        ++open;
        i_ += 2;
      } else if (at() == '*' && at(1) == last) {
        --open;
        i_ += 2;
      } else {
        step();
      }
    } while (open > 0 && i_ < source_.size());
    if (open == 0) return;
    diagnostics_.error(begin, std::string("the comment is not closed: write *") + last + " behind it" +
                                  (inner.empty() ? "" : ", or behind the one that begins in it at " + inner));
  }

  static std::string place(const Position& at) {
    return std::to_string(at.line) + ":" + std::to_string(at.column);
  }

  void word() {
    const char c = at();
    if (letter(c)) return identifier();
    if (digit(c)) return number();
    if (c == '\'' || c == '"') return string(c);
    if (c == '%') return direct();
    if (c == '{') return pragma();
    Token token{TokenKind::symbol, "", "", 10, here()};
    for (const auto symbol : long_symbols)
      if (!symbol.empty() && source_.substr(i_, symbol.size()) == symbol) token.text = symbol;
    if (token.text.empty() && std::string_view("+-*/()[],;:.=<>&#^").find(c) != std::string_view::npos)
      token.text = std::string(1, c);
    if (token.text.empty()) {
      const bool printable = c > ' ' && c < 127;
      diagnostics_.error(here(), printable ? std::string("unexpected character '") + c + "'"
                                           : "unexpected character; only comments and strings may contain "
                                             "characters beyond ASCII");
      step();
      return;
    }
    i_ += token.text.size();
    tokens_.push_back(std::move(token));
  }

  /// As a whole, so that there is one error.
  void pragma() {
    diagnostics_.error(here(), "there are no pragmas in braces; write a comment, (* *)");
    while (i_ < source_.size() && at() != '}') step();
    if (i_ < source_.size()) step();
  }

  void identifier() {
    Token token{TokenKind::identifier, "", "", 10, here()};
    const auto start = i_;
    while (letter(at()) || digit(at())) ++i_;
    token.text = source_.substr(start, i_ - start);
    token.upper = upper_case(token.text);
    if (at() == '#')
      for (const auto prefix : time_prefixes)
        if (token.upper == prefix) {
          ++i_;
          const auto value = i_;
          while (letter(at()) || digit(at()) || at() == ':' || at() == '-' || (at() == '.' && digit(at(1))))
            if (at() == ':' && at(1) == '=')
              break;
            else
              ++i_;
          token.kind = TokenKind::time;
          token.text = source_.substr(value, i_ - value);
          break;
        }
    tokens_.push_back(std::move(token));
  }

  void number() {
    Token token{TokenKind::integer, "", "", 10, here()};
    const auto digits = [&] {
      while (digit(at()) || (at() == '_' && digit(at(1)))) {
        if (at() != '_') token.text += at();
        ++i_;
      }
    };
    digits();
    if (at() == '#' && (token.text == "2" || token.text == "8" || token.text == "16")) {
      token.base = std::stoi(token.text);
      token.text.clear();
      ++i_;
      while (digit_value(at()) < 16 || (at() == '_' && digit_value(at(1)) < 16)) {
        if (at() != '_') {
          if (digit_value(at()) >= token.base)
            wrong_digit(token.base);
          else
            token.text += at();
        }
        ++i_;
      }
      if (token.text.empty()) token.text = "0", missing_digits(token);
    } else if (at() == '.' && digit(at(1))) {
      token.kind = TokenKind::real;
      token.text += '.';
      ++i_;
      digits();
    }
    const bool sign = at(1) == '+' || at(1) == '-';
    if (token.base == 10 && (at() == 'e' || at() == 'E') && digit(at(sign ? 2 : 1))) {
      token.kind = TokenKind::real;
      token.text += 'e';
      if (sign) token.text += at(1);
      i_ += sign ? 2 : 1;
      digits();
    }
    if (letter(at())) {
      diagnostics_.error(here(), "a letter follows a number; a name cannot begin with a digit");
      while (letter(at()) || digit(at())) ++i_;
    }
    tokens_.push_back(std::move(token));
  }

  void wrong_digit(int base) {
    std::string text = "the digit '";
    text += at();
    diagnostics_.error(here(), text.append("' does not exist in base ").append(std::to_string(base)));
  }

  void missing_digits(const Token& token) {
    diagnostics_.error(token.at, "digits are missing behind " + std::to_string(token.base) + "#");
  }

  void string(char quote) {
    Token token{TokenKind::string, "", "", quote == '"' ? 16 : 10, here()};
    ++i_;
    while (i_ < source_.size() && at() != quote && at() != '\n') {
      if (at() == '$') {
        if (quote == '"' && has_code())
          token.text += code();
        else
          token.text += escape();
      } else {
        token.text += at();
        ++i_;
      }
    }
    if (at() != quote)
      diagnostics_.error(token.at, std::string("the string is not closed: write ") + quote + " behind it");
    else
      ++i_;
    tokens_.push_back(std::move(token));
  }

  // Four hexadecimal digits.
  bool has_code() const {
    for (std::size_t i = 1; i <= 4; ++i)
      if (digit_value(at(i)) >= 16) return false;
    return true;
  }
  std::string code() {
    unsigned value = 0;
    ++i_;
    for (int i = 0; i < 4; ++i, ++i_) value = value * 16 + static_cast<unsigned>(digit_value(at()));
    const auto byte = [](unsigned bits) { return static_cast<char>(static_cast<unsigned char>(bits)); };
    if (value < 0x80) return {byte(value)};
    if (value < 0x800) return {byte(0xc0 | value >> 6), byte(0x80 | (value & 0x3f))};
    return {byte(0xe0 | value >> 12), byte(0x80 | (value >> 6 & 0x3f)), byte(0x80 | (value & 0x3f))};
  }

  char escape() {
    const auto place = here();
    ++i_;
    const char c = at();
    if (digit_value(c) < 16 && digit_value(at(1)) < 16) {
      const int value = digit_value(c) * 16 + digit_value(at(1));
      i_ += 2;
      return static_cast<char>(value);
    }
    constexpr std::string_view names = "$'\"LlNnPpRrTt", values = "$'\"\n\n\n\n\f\f\r\r\t\t";
    const auto found = names.find(c);
    if (found == std::string_view::npos || c == '\0') {
      diagnostics_.error(place, "'$' begins $$, $', $\", $L, $N, $P, $R, $T or two hexadecimal digits");
      return '$';
    }
    ++i_;
    return values[found];
  }

  void direct() {
    Token token{TokenKind::direct, "", "", 10, here()};
    ++i_;
    const auto start = i_;
    while (letter(at()) || digit(at()) || (at() == '.' && digit(at(1)))) ++i_;
    token.text = upper_case(source_.substr(start, i_ - start));
    tokens_.push_back(std::move(token));
  }

  std::string_view source_;
  std::uint16_t file_;
  Diagnostics& diagnostics_;
  std::vector<Token> tokens_;
  std::size_t i_ = 0, line_start_ = 0;
  std::uint32_t line_ = 1;
};

}  // namespace

std::vector<Token> tokenize(std::string_view source, std::uint16_t file, Diagnostics& diagnostics) {
  return Lexer(source, file, diagnostics).run();
}

std::string upper_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

}  // namespace trunnion::st
