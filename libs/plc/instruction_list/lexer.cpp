// SPDX-License-Identifier: Apache-2.0
#include "plc/instruction_list/lexer.hpp"

namespace trunnion::il {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::vector<Token> tokenize(std::string_view source, const std::string& file) {
  std::vector<Token> tokens;
  int line = 1;
  std::size_t line_start = 0, i = 0;
  const auto column = [&] { return static_cast<int>(i - line_start) + 1; };
  const auto starts = [&](std::string_view text) { return source.substr(i, text.size()) == text; };
  while (i < source.size()) {
    const char c = source[i];
    const Token here{TokenKind::end_of_line, source.substr(i, 1), line, column()};
    if (c == '\n') {
      tokens.push_back(here);
      ++line;
      line_start = ++i;
    } else if (c == ' ' || c == '\t' || c == '\r' || c == ';') {
      ++i;
    } else if (starts("//")) {
      while (i < source.size() && source[i] != '\n') ++i;
    } else if (starts("(*")) {
      int depth = 0;  // comments nest
      do {
        const bool begins = starts("(*"), ends = starts("*)");
        if (source[i] == '\n') {
          ++line;
          line_start = i + 1;
        }
        depth += begins ? 1 : ends ? -1 : 0;
        i += begins || ends ? 2 : 1;
      } while (depth > 0 && i < source.size());
      if (depth > 0) throw CompileError(file, here.line, here.column, "the comment is not closed");
    } else {
      std::size_t end = i + 1;
      Token token = here;
      if (letter(c)) {
        token.kind = TokenKind::word;
        while (end < source.size() && (letter(source[end]) || digit(source[end]) || source[end] == '.'))
          ++end;
      } else if (digit(c) || (c == '-' && end < source.size() && digit(source[end]))) {
        token.kind = TokenKind::number;
        while (end < source.size() && digit(source[end])) ++end;
      } else if (c == '(' || c == ')' || c == ':' || c == ',') {
        token.kind = TokenKind::symbol;
      } else {
        throw CompileError(file, line, column(), "unexpected character");
      }
      token.text = source.substr(i, end - i);
      tokens.push_back(token);
      i = end;
    }
  }
  tokens.push_back({TokenKind::end_of_line, {}, line, column()});
  return tokens;
}

}  // namespace trunnion::il
