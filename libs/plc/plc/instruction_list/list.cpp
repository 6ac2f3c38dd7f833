// SPDX-License-Identifier: Apache-2.0
#include "plc/instruction_list/list.hpp"

#include <map>

#include "plc/library/functions.hpp"
#include "plc/syntax/parser.hpp"

namespace trunnion::st {
namespace {

/// Instructions that combine the current result with an operand, and how Structured Text writes them.
const std::map<std::string_view, const char*> list_operators = {
    {"AND", "AND"}, {"&", "AND"}, {"OR", "OR"}, {"XOR", "XOR"}, {"ADD", "+"},
    {"SUB", "-"},   {"MUL", "*"}, {"DIV", "/"}, {"MOD", "MOD"}, {"GT", ">"},
    {"GE", ">="},   {"EQ", "="},  {"NE", "<>"}, {"LE", "<="},   {"LT", "<"}};

int balance(const Tokens& line) {
  int depth = 0;
  for (const auto& token : line)
    if (token.kind == TokenKind::symbol) depth += token.text == "(" ? 1 : token.text == ")" ? -1 : 0;
  return depth;
}

}  // namespace

Tokens InstructionList::run() {
  while (next_ < words_.size() && good_) line();
  if (good_ && !open_.empty()) fail(open_.back().at, "the parenthesis is not closed");
  return std::move(result_);
}

void InstructionList::fail(Position at, const std::string& text) {
  diagnostics_.error(at, text);
  good_ = false;
}

Tokens InstructionList::words(std::string_view text, Position at) {
  auto tokens = tokenize(text, file_, diagnostics_);
  tokens.pop_back();  // the end
  for (auto& token : tokens) token.at = at;
  return tokens;
}

const char* InstructionList::sign_of(const std::string& op) { return list_operators.at(op); }

void InstructionList::line() {
  const auto first = words_[next_];
  auto last = next_;
  while (last < words_.size() && words_[last].at.line == first.at.line) ++last;
  Tokens line(words_.begin() + static_cast<std::ptrdiff_t>(next_),
              words_.begin() + static_cast<std::ptrdiff_t>(last));
  next_ = last;
  if (line.size() > 1 && line[1].text == ":" && line[1].kind == TokenKind::symbol) {
    result_.push_back(own("@label", line[0].at));
    result_.push_back(line[0]);
    write(";", line[0].at);
    current_.clear();
    line.erase(line.begin(), line.begin() + 2);
  }
  if (!line.empty()) instruction(std::move(line));
}

bool InstructionList::has_result(Position at) {
  if (!current_.empty()) return true;
  fail(at, "there is no current result: LD comes first");
  return false;
}

void InstructionList::instruction(Tokens line) {
  const auto first = line[0];
  auto op = first.kind == TokenKind::identifier ? first.upper : first.text;
  line.erase(line.begin());
  if (op == ")") return close(first.at);
  if (op == "JMP" || op == "JMPC" || op == "JMPCN" || op == "RET" || op == "RETC" || op == "RETCN")
    return jump(op, line, first.at);
  if (op == "CAL" || op == "CALC" || op == "CALCN") return call(op, std::move(line), first.at);
  if (op == "NOT" && line.empty()) {
    if (has_result(first.at)) combine("NOT (", {}, ")", first.at);
    return;
  }
  if (op == "LD" || op == "LDN") {
    if (!expression(line, first.at)) return;
    current_.clear();
    combine(op == "LDN" ? "NOT (" : "(", std::move(line), ")", first.at);
    return;
  }
  const bool stores = op == "ST" || op == "STN" || op == "S" || op == "R";
  if (!stores && is_call(op, first, line)) return function(first, std::move(line));
  if (stores) {
    if (has_result(first.at)) store(op, line, first.at);
    return;
  }
  bool inverts = false;
  if (!list_operators.contains(op) && op.ends_with("N") &&
      list_operators.contains(op.substr(0, op.size() - 1)))
    inverts = true, op.pop_back();
  if (!list_operators.contains(op)) return fail(first.at, "unknown instruction '" + first.text + "'");
  if (!has_result(first.at)) return;
  if (!line.empty() && line[0].text == "(" && line[0].kind == TokenKind::symbol)
    return open(op, inverts, std::move(line), first.at);
  if (!expression(line, first.at)) return;
  apply(op, inverts, std::move(line), first.at);
}

void InstructionList::open(const std::string& op, bool inverts, Tokens line, Position at) {
  keep(at);
  open_.push_back({std::move(current_), op, inverts, at});
  current_.clear();
  line.erase(line.begin());
  const bool closes = !line.empty() && line.back().text == ")" && balance(line) < 0;
  if (closes) line.pop_back();
  if (line.empty() && !closes) return;
  if (!expression(line, at)) return;
  current_ = std::move(line);
  if (closes) close(at);
}

bool InstructionList::is_call(const std::string& op, const Token& first, const Tokens& line) {
  if (first.kind != TokenKind::identifier || op == "NOT" || list_operators.contains(op)) return false;
  if (op.ends_with("N") && list_operators.contains(op.substr(0, op.size() - 1))) return false;
  const bool formal = line.size() > 1 && line[0].text == "(" && line[0].kind == TokenKind::symbol;
  return formal || is_standard_function(op);
}

/// Without parentheses the current result is the first argument.
void InstructionList::function(const Token& name, Tokens arguments) {
  const bool formal = !arguments.empty() && arguments[0].text == "(";
  Tokens call = {name};
  if (formal) {
    append(call, std::move(arguments));
  } else {
    if (!has_result(name.at)) return;
    keep(name.at);
    append(call, words("(", name.at));
    append(call, current_);
    if (!arguments.empty()) append(call, words(",", name.at));
    append(call, std::move(arguments));
    append(call, words(")", name.at));
  }
  if (!expression(call, name.at)) return;
  current_ = std::move(call);
  keep(name.at);
}

bool InstructionList::expression(const Tokens& words, Position at) {
  if (words.empty())
    fail(at, "the operand is missing");
  else if (!is_expression(words, at, diagnostics_))
    good_ = false;
  return good_;
}

/// The current result becomes begin, it, more, end.
void InstructionList::combine(const char* begin, Tokens more, const char* end, Position at) {
  auto result = words(begin, at);
  append(result, std::move(current_));
  append(result, std::move(more));
  append(result, words(end, at));
  current_ = std::move(result);
}

void InstructionList::apply(const std::string& op, bool inverts, Tokens operand, Position at) {
  keep(at);
  auto right = words(sign_of(op), at);
  append(right, words(inverts ? "NOT (" : "(", at));
  append(right, std::move(operand));
  append(right, words(")", at));
  append(current_, std::move(right));
  keep(at);
}

void InstructionList::keep(Position at) {
  if (current_.size() == 1 && current_[0].text.starts_with("@")) return;
  auto value = new_value(at);
  result_.push_back(value);
  write(":=", at);
  write(std::move(current_));
  write(";", at);
  current_ = {std::move(value)};
}

Token InstructionList::new_value(Position at) {
  result_.push_back(own("@define", at));
  const auto name = "@" + std::to_string(++values_);
  return {TokenKind::identifier, name, name, 10, at};
}

void InstructionList::close(Position at) {
  if (open_.empty()) return fail(at, "there is no open parenthesis");
  if (!has_result(at)) return;
  auto inner = std::move(current_);
  auto outer = std::move(open_.back());
  open_.pop_back();
  current_ = std::move(outer.before);
  apply(outer.op, outer.inverts, std::move(inner), at);
}

void InstructionList::store(const std::string& op, const Tokens& target, Position at) {
  if (!expression(target, at)) return;
  keep(at);
  if (op == "S" || op == "R") {
    write("IF", at);
    write(current_);
    write("THEN", at);
    write(target);
    write(op == "S" ? ":= TRUE; END_IF;" : ":= FALSE; END_IF;", at);
    return;
  }
  write(target);
  write(op == "STN" ? ":= NOT (" : ":= (", at);
  write(current_);
  write(");", at);
}

/// IF the current result THEN, or nothing of an instruction without condition.
bool InstructionList::condition(const std::string& op, const char* plain, Position at) {
  if (op == plain) return true;
  if (!has_result(at)) return false;
  keep(at);
  write(op.ends_with("N") ? "IF NOT" : "IF", at);
  write(current_);
  write("THEN", at);
  return true;
}

void InstructionList::jump(const std::string& op, const Tokens& label, Position at) {
  const bool returns = op.starts_with("RET");
  const char* plain = returns ? "RET" : "JMP";
  if (!returns && (label.size() != 1 || label[0].kind != TokenKind::identifier))
    return fail(at, "a label follows " + op);
  if (!condition(op, plain, at)) return;
  if (returns) {
    write("RETURN;", at);
  } else {
    result_.push_back(own("@jump", at));
    write(label);
    write(";", at);
  }
  if (op != plain) write("END_IF;", at);
}

void InstructionList::call(const std::string& op, Tokens instance, Position at) {
  if (instance.size() == 1) append(instance, words("()", at));
  if (!expression(instance, at) || !condition(op, "CAL", at)) return;
  write(std::move(instance));
  write(";", at);
  if (op != "CAL") write("END_IF;", at);
}

}  // namespace trunnion::st
