// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "plc/syntax/parser.hpp"

namespace trunnion::st {
namespace {

constexpr std::array keywords = std::to_array<std::string_view>(
    {"AND",        "ARRAY",         "AT",           "BY",           "CASE",
     "CONSTANT",   "CONTINUE",      "DO",           "ELSE",         "ELSIF",
     "END_CASE",   "END_CLASS",     "END_FOR",      "END_FUNCTION", "END_FUNCTION_BLOCK",
     "END_IF",     "END_INTERFACE", "END_METHOD",   "END_PROGRAM",  "END_REPEAT",
     "END_STRUCT", "END_TEST",      "END_TYPE",     "END_VAR",      "END_WHILE",
     "EXIT",       "FALSE",         "FOR",          "FUNCTION",     "FUNCTION_BLOCK",
     "IF",         "MOD",           "NOT",          "OF",           "OR",
     "PROGRAM",    "REPEAT",        "RETAIN",       "RETURN",       "STRUCT",
     "TEST",       "THEN",          "TO",           "TRUE",         "TYPE",
     "UNTIL",      "VAR",           "VAR_EXTERNAL", "VAR_GLOBAL",   "VAR_INPUT",
     "VAR_IN_OUT", "VAR_OUTPUT",    "VAR_TEMP",     "WHILE",        "XOR"});

}  // namespace

bool TokenReader::is_keyword(const Token& token) {
  return token.kind == TokenKind::identifier &&
         std::find(keywords.begin(), keywords.end(), token.upper) != keywords.end();
}

bool TokenReader::accept_symbol(std::string_view text) {
  if (!is_symbol(text)) return false;
  take();
  return true;
}

bool TokenReader::accept_word(std::string_view upper) {
  if (!is_word(upper)) return false;
  take();
  return true;
}

std::string TokenReader::found() const {
  if (now().kind == TokenKind::end) return "the end of the file";
  if (now().kind == TokenKind::string) return "the string '" + now().text + "'";
  if (now().kind == TokenKind::direct) return "'%" + now().text + "'";
  if (now().kind == TokenKind::time) return "'" + now().upper + "#" + now().text + "'";
  return "'" + now().text + "'";
}

void TokenReader::fail(const std::string& expected) {
  diagnostics_.error(now().at, "expected " + expected + ", found " + found());
  throw Abandoned{};
}

void TokenReader::expect_symbol(std::string_view text, std::string_view where) {
  if (accept_symbol(text)) return;
  if (text == ";" && next_ > 0) {
    // What is missing belongs behind the word before.
    const auto& before = tokens_[next_ - 1];
    auto at = before.at;
    at.column += static_cast<std::uint32_t>(before.text.size());
    diagnostics_.error(before.at.line == now().at.line ? now().at : at,
                       "expected ';' " + std::string(where) + ", found " + found());
    throw Abandoned{};
  }
  fail("'" + std::string(text) + "' " + std::string(where));
}

void TokenReader::expect_word(std::string_view upper, std::string_view where) {
  if (!accept_word(upper)) fail(std::string(upper) + " " + std::string(where));
}

Token TokenReader::expect_name(std::string_view what) {
  if (now().kind != TokenKind::identifier) fail(std::string(what));
  if (is_keyword()) {
    diagnostics_.error(now().at, "'" + now().text + "' is a keyword and cannot be " + std::string(what));
    throw Abandoned{};
  }
  return take();
}

Token TokenReader::expect_whole_name(std::string_view what) {
  auto name = expect_name(what);
  while (is_symbol(".")) {
    take();
    const auto part = expect_name("a name behind '.'");
    name.text.append(".").append(part.text);
    name.upper.append(".").append(part.upper);
  }
  return name;
}

}  // namespace trunnion::st
