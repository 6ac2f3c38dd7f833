// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include "plc/syntax/parser.hpp"

namespace trunnion::st {

Statements StatementParser::statements(std::initializer_list<std::string_view> ends) {
  const Depth depth(*this);
  Statements result;
  const auto ended = [&] {
    return now().kind == TokenKind::end || at_declaration() ||
           std::any_of(ends.begin(), ends.end(), [&](auto word) { return is_word(word); });
  };
  const auto starts_with_label = std::find(ends.begin(), ends.end(), "END_CASE") != ends.end();
  while (!ended()) {
    if (starts_with_label && at_case_label()) break;
    if (accept_symbol(";")) continue;
    try {
      result.push_back(statement());
    } catch (const Abandoned&) {
      recover(ends);
    }
  }
  return result;
}

// A unit begins or ends where statements are expected: the end of a statement or of the unit before is
// missing.
bool StatementParser::at_declaration() const {
  for (const auto* word :
       {"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TEST", "TYPE", "VAR_GLOBAL", "END_PROGRAM", "END_FUNCTION",
        "END_FUNCTION_BLOCK", "END_CLASS", "END_TEST", "END_NAMESPACE"})
    if (is_word(word)) return true;
  return at_configuration() || at_method() || at_class() || at_interface() || at_namespace();
}

// To behind the next ';', or to the end of the enclosing statement.
void StatementParser::recover(std::initializer_list<std::string_view> ends) {
  while (now().kind != TokenKind::end) {
    if (accept_symbol(";")) return;
    if (std::any_of(ends.begin(), ends.end(), [&](auto word) { return is_word(word); })) return;
    const bool outer = now().kind == TokenKind::identifier && now().upper.rfind("END_", 0) == 0;
    if (at_declaration()) return;
    for (const auto* word : {"IF", "CASE", "FOR", "WHILE", "REPEAT"})
      if (is_word(word)) return;
    take();
    if (outer) {
      accept_symbol(";");
      return;
    }
  }
}

std::unique_ptr<Statement> StatementParser::statement() {
  const Depth depth(*this);
  auto result = std::make_unique<Statement>();
  auto& s = *result;
  s.at = now().at;
  using enum Statement::Kind;
  if (diagram_statement(s)) {
    // of a diagram
  } else if (accept_word("IF")) {
    if_statement(s);
  } else if (accept_word("CASE")) {
    case_statement(s);
  } else if (accept_word("FOR")) {
    for_statement(s);
  } else if (accept_word("WHILE")) {
    s.kind = while_;
    s.value = expression();
    expect_word("DO", "behind the condition of WHILE");
    s.body = statements({"END_WHILE"});
    expect_word("END_WHILE", "at the end of WHILE");
  } else if (accept_word("REPEAT")) {
    s.kind = repeat;
    s.body = statements({"UNTIL", "END_REPEAT"});
    expect_word("UNTIL", "with the condition that ends REPEAT");
    s.value = expression();
    accept_symbol(";");
    expect_word("END_REPEAT", "at the end of REPEAT");
  } else if (accept_word("EXIT")) {
    s.kind = exit;
  } else if (accept_word("CONTINUE")) {
    s.kind = continue_;
  } else if (accept_word("RETURN")) {
    s.kind = return_;
  } else {
    if (now().kind != TokenKind::identifier && now().kind != TokenKind::direct) fail("a statement");
    if (is_keyword()) fail("a statement");
    auto target = designator();
    if (is_symbol(":=") || is_symbol("?=")) {
      s.at = target->at;
      s.attempts = take().text == "?=";
      s.kind = assign;
      s.target = std::move(target);
      s.value = expression();
    } else if (target->kind == Expression::Kind::call) {
      s.kind = call;
      s.value = std::move(target);
    } else if (is_symbol("=")) {
      fail("':=' (an assignment; '=' compares)");
    } else {
      fail("':=' or '(' behind '" + target->text + "'");
    }
  }
  // END_IF and the like end a statement for everybody but the standard.
  if (s.kind >= if_ && s.kind <= repeat)
    accept_symbol(";");
  else
    expect_symbol(";", "at the end of the statement");
  return result;
}

// The lexer makes none of these symbols.
bool StatementParser::diagram_statement(Statement& s) {
  using enum Statement::Kind;
  const bool defines = accept_symbol("@define"), jumps = !defines && accept_symbol("@jump");
  if (!defines && !jumps && !accept_symbol("@label")) return false;
  s.kind = defines ? define : jumps ? jump : label;
  s.target = designator();
  if (!defines) return true;
  expect_symbol(":=", "behind the name of the value");
  s.value = expression();
  if (accept_symbol("@when")) s.to = expression();
  return true;
}

void StatementParser::if_statement(Statement& s) {
  s.kind = Statement::Kind::if_;
  do {
    auto& branch = s.branches.emplace_back();
    branch.condition = expression();
    if (is_symbol(":=")) fail("THEN behind the condition ('=' compares, ':=' assigns)");
    expect_word("THEN", "behind the condition of IF");
    branch.body = statements({"ELSIF", "ELSE", "END_IF"});
  } while (accept_word("ELSIF"));
  if (accept_word("ELSE")) s.branches.emplace_back().body = statements({"END_IF"});
  expect_word("END_IF", "at the end of IF");
}

// "3:", "3, 4:", "3..5:", "RED:", "a.RED:", "Color#red:", "-1:", "2 * N:", "N MOD 2:"; an assignment has ":="
// or a designator first, another statement two words that follow each other, as CASE n OF 0:
bool StatementParser::at_case_label() const {
  bool behind_value = false;
  for (std::size_t i = 0; i < 400; ++i) {
    const auto& token = ahead(i);
    if (token.kind == TokenKind::end) return false;
    if (token.kind == TokenKind::symbol) {
      if (token.text == ":") return true;
      constexpr std::array symbols =
          std::to_array<std::string_view>({",", "..", "-", "#", "+", "*", "/", "**", "."});
      if (std::find(symbols.begin(), symbols.end(), token.text) == symbols.end()) return false;
      behind_value = false;
    } else if (behind_value && token.kind == TokenKind::identifier && token.upper == "MOD") {
      behind_value = false;
    } else if (behind_value || (token.kind != TokenKind::integer && token.kind != TokenKind::identifier)) {
      return false;
    } else {
      behind_value = true;
    }
  }
  return false;
}

std::vector<CaseLabel> StatementParser::labels() {
  std::vector<CaseLabel> result;
  do {
    auto& label = result.emplace_back();
    label.first = expression();
    if (accept_symbol("..")) label.last = expression();
  } while (accept_symbol(","));
  expect_symbol(":", "behind the values of a case");
  return result;
}

void StatementParser::case_statement(Statement& s) {
  s.kind = Statement::Kind::case_;
  s.value = expression();
  expect_word("OF", "behind the selector of CASE");
  while (!is_word("ELSE") && !is_word("END_CASE") && now().kind != TokenKind::end) {
    auto& branch = s.branches.emplace_back();
    branch.labels = labels();
    branch.body = statements({"ELSE", "END_CASE"});
  }
  if (accept_word("ELSE")) s.branches.emplace_back().body = statements({"END_CASE"});
  expect_word("END_CASE", "at the end of CASE");
}

void StatementParser::for_statement(Statement& s) {
  s.kind = Statement::Kind::for_;
  s.target = designator();
  expect_symbol(":=", "behind the variable of FOR");
  s.value = expression();
  expect_word("TO", "behind the first value of FOR");
  s.to = expression();
  if (accept_word("BY")) s.by = expression();
  expect_word("DO", "before the statements of FOR");
  s.body = statements({"END_FOR"});
  expect_word("END_FOR", "at the end of FOR");
}

}  // namespace trunnion::st
