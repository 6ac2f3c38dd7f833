// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "plc/syntax/parser.hpp"

namespace trunnion::st {
namespace {

/// IEC 61131-3:2013, table 71: a higher number binds more tightly.
const std::map<std::string_view, int> precedences = {
    {"OR", 1}, {"XOR", 2}, {"AND", 3}, {"&", 3}, {"=", 4}, {"<>", 4}, {"<", 5},   {">", 5},
    {"<=", 5}, {">=", 5},  {"+", 6},   {"-", 6}, {"*", 7}, {"/", 7},  {"MOD", 7}, {"**", 8},
};

}  // namespace

ExpressionPtr ExpressionParser::make(Expression::Kind kind, Position at) const {
  auto result = std::make_unique<Expression>();
  result->kind = kind;
  result->at = at;
  return result;
}

ExpressionPtr ExpressionParser::make_name(const std::string& text, Position at) const {
  auto result = make(Expression::Kind::name, at);
  result->text = text;
  result->name = upper_case(text);
  return result;
}

ExpressionPtr ExpressionParser::expression(int precedence) {
  const Depth depth(*this);
  auto left = unary();
  for (;;) {
    const auto& token = now();
    const auto word = token.kind == TokenKind::identifier ? std::string_view(token.upper)
                      : token.kind == TokenKind::symbol   ? std::string_view(token.text)
                                                          : std::string_view();
    const auto found = precedences.find(word);
    if (word.empty() || found == precedences.end() || found->second <= precedence) return left;
    const auto op = take();
    auto node = make(Expression::Kind::binary, op.at);
    node->name = found->first == "&" ? "AND" : std::string(found->first);
    node->parts.push_back(std::move(left));
    node->parts.push_back(expression(found->second));
    left = std::move(node);
  }
}

ExpressionPtr ExpressionParser::unary() {
  const Depth depth(*this);
  const bool minus = is_symbol("-"), inverts = is_word("NOT");
  if (is_symbol("+")) {
    take();
    return unary();
  }
  if (!minus && !inverts) return primary();
  auto node = make(Expression::Kind::unary, now().at);
  take();
  node->name = minus ? "-" : "NOT";
  if (inverts && is_symbol("(") && ahead().upper == "IN" && ahead(2).text == ":=") {  // the call form
    for (int i = 0; i < 3; ++i) take();
    node->parts.push_back(expression());
    expect_symbol(")", "behind the argument");
  } else {
    node->parts.push_back(unary());
  }
  return node;
}

ExpressionPtr ExpressionParser::primary() {
  const Token token = now();
  switch (token.kind) {
    case TokenKind::integer:
    case TokenKind::real: {
      take();
      auto node =
          make(token.kind == TokenKind::real ? Expression::Kind::real : Expression::Kind::integer, token.at);
      node->text = token.text;
      node->base = token.base;
      return node;
    }
    case TokenKind::string: {
      take();
      auto node = make(Expression::Kind::string, token.at);
      node->text = token.text;
      node->base = token.base;
      return node;
    }
    case TokenKind::time: {
      take();
      auto node = make(Expression::Kind::time, token.at);
      node->name = token.upper;
      node->text = token.text;
      return node;
    }
    case TokenKind::symbol:
      if (token.text == "(") {
        take();
        auto inner = expression();
        expect_symbol(")", "behind the expression");
        return inner;
      }
      fail("a value or a variable");
    case TokenKind::identifier:
      if (token.upper == "TRUE" || token.upper == "FALSE") {
        take();
        auto node = make(Expression::Kind::boolean, token.at);
        node->text = token.upper == "TRUE" ? "1" : "0";
        return node;
      }
      if (is_called_operator()) return operator_call();
      if (is_keyword()) fail("a value or a variable");
      if (at_typed_literal()) return typed_literal();
      return designator();
    case TokenKind::direct:
      return designator();
    default:
      fail("a value or a variable");
  }
}

/// The call form of an operator that is a word: AND(a, b, c) is a AND b AND c.
bool ExpressionParser::is_called_operator() const {
  return (is_word("AND") || is_word("OR") || is_word("XOR") || is_word("MOD")) &&
         ahead().kind == TokenKind::symbol && ahead().text == "(";
}

ExpressionPtr ExpressionParser::operator_call() {
  const auto op = take();
  auto given = arguments();
  const bool pair = op.upper == "MOD";
  if (given.size() < 2 || (pair && given.size() > 2)) {
    diagnostics_.error(op.at, op.text + " has 2 " + (pair ? "" : "or more ") + "arguments, not " +
                                  std::to_string(given.size()));
    throw Abandoned{};
  }
  std::vector<ExpressionPtr> operands(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    auto& argument = given[i];
    auto at = argument.name.empty() ? i : std::size_t{0};
    while (!argument.name.empty() && at < operands.size() && argument.name != "IN" + std::to_string(at + 1))
      ++at;
    if (argument.output || at == operands.size() || operands[at] != nullptr) {
      diagnostics_.error(argument.at, op.text +
                                          " has no free parameter for this argument; they are IN1 .. IN" +
                                          std::to_string(operands.size()));
      throw Abandoned{};
    }
    operands[at] = std::move(argument.value);
  }
  auto result = std::move(operands[0]);
  for (std::size_t i = 1; i < operands.size(); ++i) {
    auto node = make(Expression::Kind::binary, op.at);
    node->name = op.upper;
    node->parts.push_back(std::move(result));
    node->parts.push_back(std::move(operands[i]));
    result = std::move(node);
  }
  return result;
}

/// Color#red, a.b.Color#red
bool ExpressionParser::at_typed_literal() const {
  const auto is = [&](std::size_t i, std::string_view text) {
    return ahead(i).kind == TokenKind::symbol && ahead(i).text == text;
  };
  std::size_t behind = 1;
  while (is(behind, ".") && ahead(behind + 1).kind == TokenKind::identifier) behind += 2;
  return is(behind, "#");
}

ExpressionPtr ExpressionParser::typed_literal() {
  const auto type = expect_whole_name("a type");
  take();
  auto node = make(Expression::Kind::typed, type.at);
  node->name = type.upper;
  node->text = type.text;
  if (now().kind == TokenKind::identifier && !is_word("TRUE") && !is_word("FALSE")) {
    const auto name = take();
    auto inner = make(Expression::Kind::name, name.at);
    inner->name = name.upper;
    inner->text = name.text;
    node->parts.push_back(std::move(inner));
    return node;
  }
  const bool negative = is_symbol("-");
  if (negative || is_symbol("+")) take();
  const auto kind = now().kind;
  if (kind != TokenKind::integer && kind != TokenKind::real && kind != TokenKind::string &&
      kind != TokenKind::identifier)
    fail("a value behind '" + type.text + "#'");
  auto value = primary();
  if (negative) {
    auto minus = make(Expression::Kind::unary, value->at);
    minus->name = "-";
    minus->parts.push_back(std::move(value));
    value = std::move(minus);
  }
  node->parts.push_back(std::move(value));
  return node;
}

/// THIS. and SUPER., with or without ^ behind the word; a variable may have these names.
bool ExpressionParser::at_scoped_name() const {
  const auto& next = ahead();
  if (next.kind != TokenKind::symbol || !(is_word("THIS") || is_word("SUPER"))) return false;
  return next.text == "." || next.text == "^" || (is_word("SUPER") && next.text == "(");
}

/// THIS.name, SUPER.name; SUPER() is the body of the function block that is extended and has no name.
ExpressionPtr ExpressionParser::scoped_name() {
  const auto word = take();
  const bool base = word.upper == "SUPER";
  accept_symbol("^");
  auto node = make_name(word.text, word.at);
  if (!base && !is_symbol(".")) return node;
  node->scope = base ? NameScope::base : NameScope::instance;
  if (base && is_symbol("(")) {
    node->name.clear();
    return node;
  }
  expect_symbol(".", "behind " + word.upper);
  const auto token = expect_name("the name of a variable or method behind '.'");
  node->name = token.upper;
  node->text = token.text;
  node->at = token.at;
  return node;
}

ExpressionPtr ExpressionParser::designator() {
  ExpressionPtr node;
  if (now().kind == TokenKind::direct) {
    const auto token = take();
    node = make(Expression::Kind::direct, token.at);
    node->name = token.text;
    node->text = "%" + token.text;
  } else if (at_scoped_name()) {
    node = scoped_name();
  } else {
    const auto token = expect_name("a variable");
    const auto edge = edges_.find(token.upper);
    node = make_name(edge == edges_.end() ? token.text : edge->second, token.at);
    if (edge != edges_.end()) {
      node->detected = token.upper;
      auto output = make(Expression::Kind::member, token.at);
      output->name = output->text = "Q";
      output->parts.push_back(std::move(node));
      node = std::move(output);
    }
  }
  for (std::size_t levels = 0;; ++levels) {
    if (levels > 200) fail("fewer members");
    if (is_symbol(".")) {
      take();
      // The X of a bit may be left out: b.3 (IEC 61131-3:2013, table 17).
      const bool bit = now().kind == TokenKind::integer && now().base == 10;
      if (now().kind == TokenKind::direct || bit) {
        const auto token = take();
        auto part = make(Expression::Kind::part, token.at);
        part->name = bit ? "X" + token.text : token.text;
        part->parts.push_back(std::move(node));
        node = std::move(part);
        continue;
      }
      if (now().kind != TokenKind::identifier) fail("the name of a member behind '.'");
      const auto token = take();
      auto member = make(Expression::Kind::member, token.at);
      member->name = token.upper;
      member->text = token.text;
      member->parts.push_back(std::move(node));
      node = std::move(member);
    } else if (is_symbol("^")) {
      auto value = make(Expression::Kind::dereference, take().at);
      value->text = node->text + "^";
      value->parts.push_back(std::move(node));
      node = std::move(value);
    } else if (is_symbol("[")) {
      auto index = make(Expression::Kind::index, take().at);
      index->parts.push_back(std::move(node));
      do index->parts.push_back(expression());
      while (accept_symbol(","));
      expect_symbol("]", "behind the index");
      node = std::move(index);
    } else if (is_symbol("(")) {
      auto call = make(Expression::Kind::call, node->at);
      for (auto& argument : arguments()) {
        const bool controls = argument.name == (argument.output ? "ENO" : "EN");
        (controls ? call->control : call->arguments).push_back(std::move(argument));
      }
      call->parts.push_back(std::move(node));
      node = std::move(call);
    } else {
      return node;
    }
  }
}

std::vector<Argument> ExpressionParser::arguments() {
  std::vector<Argument> result;
  expect_symbol("(", "before the arguments");
  if (accept_symbol(")")) return result;
  do {
    Argument argument;
    argument.at = now().at;
    argument.inverted = is_word("NOT") && ahead().kind == TokenKind::identifier &&
                        ahead(2).kind == TokenKind::symbol && ahead(2).text == "=>";
    if (argument.inverted) take();
    const bool named = now().kind == TokenKind::identifier && ahead().kind == TokenKind::symbol &&
                       (ahead().text == ":=" || ahead().text == "=>");
    if (named) {
      argument.name = take().upper;
      argument.output = take().text == "=>";
    }
    argument.value = expression();
    result.push_back(std::move(argument));
  } while (accept_symbol(","));
  expect_symbol(")", "behind the arguments");
  return result;
}

/// 1, 2, 5(0): the initial values of an array.
ExpressionPtr ExpressionParser::initial_list(Position at) {
  auto list = make(Expression::Kind::list, at);
  do {
    ExpressionPtr repeat;
    if (now().kind == TokenKind::integer && ahead().kind == TokenKind::symbol && ahead().text == "(") {
      repeat = primary();
      take();
      list->parts.push_back(is_symbol(")") ? nullptr : initializer());
      expect_symbol(")", "behind the repeated value");
    } else {
      list->parts.push_back(initializer());
    }
    list->repeat.push_back(std::move(repeat));
  } while (accept_symbol(","));
  return list;
}

/// The first edition of the standard, and CoDeSys 2.3, have no brackets around the values of an array.
ExpressionPtr ExpressionParser::array_initializer() {
  if (is_symbol("[")) return initializer();
  auto list = initial_list(now().at);
  const bool single = list->parts.size() == 1 && list->repeat[0] == nullptr;
  if (single) return std::move(list->parts[0]);
  return list;
}

ExpressionPtr ExpressionParser::initializer() {
  const Depth depth(*this);
  if (is_symbol("[")) {
    auto list = initial_list(take().at);
    expect_symbol("]", "behind the initial values");
    return list;
  }
  if (is_symbol("(") && ahead().kind == TokenKind::identifier && ahead(2).kind == TokenKind::symbol &&
      ahead(2).text == ":=") {
    auto structure = make(Expression::Kind::structure, take().at);
    do {
      Argument field;
      const auto name = expect_name("the name of a field");
      field.name = name.upper;
      field.at = name.at;
      expect_symbol(":=", "behind the name of the field");
      field.value = initializer();
      structure->arguments.push_back(std::move(field));
    } while (accept_symbol(","));
    expect_symbol(")", "behind the initial values");
    return structure;
  }
  return expression();
}

}  // namespace trunnion::st
