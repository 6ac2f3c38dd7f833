// SPDX-License-Identifier: Apache-2.0
#include "plc/instruction_list/compiler.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "plc/library/register_names.hpp"

namespace trunnion::il {
namespace {

enum class Type { undefined, boolean, word };
enum class Access { read, write };

/// How an instruction is written and what it does to the current result.
enum class Form {
  load,        ///< operand gives the result
  store,       ///< result goes to the operand
  store_bit,   ///< boolean result, bit operand
  logic,       ///< boolean result and operand, may open a parenthesis
  arithmetic,  ///< word result and operand, may open a parenthesis
  compare,     ///< word result and operand give a boolean, may open a parenthesis
  bare_bool,   ///< no operand, boolean result
  close,
  timer,
  counter,
  edge,
  counter_reset,
  move,
  jump,
  end
};

struct Mnemonic {
  Op op;
  Form form;
};

const std::map<std::string_view, Mnemonic> mnemonics = {
    {"LD", {Op::load, Form::load}},
    {"LDN", {Op::load_not, Form::load}},
    {"ST", {Op::store, Form::store}},
    {"STN", {Op::store_not, Form::store}},
    {"S", {Op::set, Form::store_bit}},
    {"R", {Op::reset, Form::store_bit}},
    {"NOT", {Op::invert, Form::bare_bool}},
    {"AND", {Op::and_, Form::logic}},
    {"ANDN", {Op::and_not, Form::logic}},
    {"OR", {Op::or_, Form::logic}},
    {"ORN", {Op::or_not, Form::logic}},
    {"XOR", {Op::xor_, Form::logic}},
    {"XORN", {Op::xor_not, Form::logic}},
    {"ADD", {Op::add, Form::arithmetic}},
    {"SUB", {Op::subtract, Form::arithmetic}},
    {"MUL", {Op::multiply, Form::arithmetic}},
    {"DIV", {Op::divide, Form::arithmetic}},
    {"GT", {Op::greater, Form::compare}},
    {"GE", {Op::greater_equal, Form::compare}},
    {"EQ", {Op::equal, Form::compare}},
    {"NE", {Op::not_equal, Form::compare}},
    {"LE", {Op::less_equal, Form::compare}},
    {"LT", {Op::less, Form::compare}},
    {"TON", {Op::timer_on, Form::timer}},
    {"TOF", {Op::timer_off, Form::timer}},
    {"CTU", {Op::count_up, Form::counter}},
    {"CTR", {Op::count_reset, Form::counter_reset}},
    {"R_TRIG", {Op::rising, Form::edge}},
    {"F_TRIG", {Op::falling, Form::edge}},
    {"MOVE", {Op::move, Form::move}},
    {"JMP", {Op::jump, Form::jump}},
    {"JMPC", {Op::jump_if, Form::jump}},
    {"JMPCN", {Op::jump_if_not, Form::jump}},
    {"RET", {Op::jump, Form::end}},
    {"RETC", {Op::jump_if, Form::end}},
};

class Parser {
 public:
  Parser(std::string_view source, const std::string& file, const Symbols& symbols,
         std::map<std::pair<char, int>, std::string>& instances, std::vector<std::string>& warnings)
      : file_(file),
        symbols_(symbols),
        instances_(instances),
        warnings_(warnings),
        tokens_(tokenize(source, file)) {}

  Program run() {
    while (at_ < tokens_.size()) {
      if (peek().kind == TokenKind::end_of_line)
        ++at_;
      else if (is_word("VAR"))
        declarations();
      else
        statement();
    }
    if (!open_.empty()) fail(open_.back().token, "the parenthesis is not closed");
    for (const auto& jump : jumps_) {
      const auto found = labels_.find(jump.token.text);
      if (found == labels_.end()) fail(jump.token, "unknown label '" + std::string(jump.token.text) + "'");
      if (found->second <= jump.instruction)
        fail(jump.token, "a jump must lead forward, so that every scan ends");
      program_.instructions[jump.instruction].target = static_cast<std::uint32_t>(found->second);
    }
    for (const auto instruction : returns_)
      program_.instructions[instruction].target = static_cast<std::uint32_t>(program_.instructions.size());
    return std::move(program_);
  }

 private:
  struct Open {
    Op op;
    Type before;
    Form form;
    Token token;
  };
  struct Jump {
    std::size_t instruction;
    Token token;
  };

  [[noreturn]] void fail(const Token& token, const std::string& text) const {
    throw CompileError(file_, token.line, token.column, text);
  }
  /// At the end the last end of line, again and again.
  const Token& peek() const { return tokens_[std::min(at_, tokens_.size() - 1)]; }
  const Token& next() {
    const Token& token = peek();
    ++at_;
    return token;
  }
  bool is_word(std::string_view text) const { return peek().kind == TokenKind::word && peek().text == text; }
  bool is_symbol(std::string_view text) const {
    return peek().kind == TokenKind::symbol && peek().text == text;
  }
  void expect(std::string_view text) {
    if (!is_symbol(text)) fail(peek(), "expected '" + std::string(text) + "'");
    ++at_;
  }
  void end_of_line() {
    if (peek().kind != TokenKind::end_of_line) fail(peek(), "unexpected '" + std::string(peek().text) + "'");
    ++at_;
  }

  void declarations() {
    const Token start = next();
    const bool retain = is_word("RETAIN");
    if (retain) ++at_;
    end_of_line();
    while (!is_word("END_VAR")) {
      if (peek().kind == TokenKind::end_of_line) {
        if (at_ + 1 >= tokens_.size()) fail(start, "VAR without END_VAR");
        ++at_;
        continue;
      }
      const Token name = next();
      if (name.kind != TokenKind::word || parse_address(name.text) || mnemonics.count(name.text) != 0 ||
          name.text.find_first_of(".%") != std::string_view::npos)
        fail(name, "expected a name");
      if (!is_word("AT")) fail(peek(), "expected AT");
      ++at_;
      const Token where = next();
      const auto address = where.kind == TokenKind::word ? parse_address(where.text) : std::nullopt;
      if (!address) fail(where, "'" + std::string(where.text) + "' is not an address");
      warn_moved(*address, where);
      expect(":");
      const Token type = next();
      if (type.text != (address->is_bit() ? "BOOL" : "INT"))
        fail(type, address->is_bit() ? "a bit is BOOL" : "a register is INT");
      if (symbols_.find(name.text) != symbols_.end() || !names_.emplace(name.text, *address).second)
        fail(name, "'" + std::string(name.text) + "' is defined already");
      if (retain) keep(*address, where);
      end_of_line();
    }
    ++at_;
    end_of_line();
  }

  void warn_moved(const Address& address, const Token& token) {
    const auto text = st::moved_register({address.area, address.index, address.bit});
    if (text.empty() || !moved_.insert(std::string(token.text)).second) return;
    warnings_.push_back(file_ + ":" + std::to_string(token.line) + ":" + std::to_string(token.column) +
                        ": warning: " + text);
  }

  void keep(const Address& address, const Token& where) {
    const auto& area = st::info(address.area);
    if (address.area <= st::Area::g)
      fail(where, "RETAIN is not for this area: keep the value in R, W, D or B");
    if (!area.retained) program_.retained.push_back(address);
  }

  Operand operand(Access access = Access::read) {
    const Token token = next();
    Operand result;
    if (token.kind == TokenKind::number) {
      result.is_constant = true;
      result.constant =
          number(token, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max());
      return result;
    }
    if (token.kind != TokenKind::word) fail(token, "expected an operand");
    const auto name = names_.find(token.text);
    if (name != names_.end())
      result.address = name->second;
    else if (const auto symbol = symbols_.find(token.text); symbol != symbols_.end())
      result.address = symbol->second;
    else if (const auto address = parse_address(token.text))
      warn_moved(result.address = *address, token);
    else
      fail(token, "'" + std::string(token.text) + "' is neither an address nor a name");
    program_.uses.push_back({result.address, name != names_.end() ? name->first : "", token.line,
                             token.column, access == Access::read, access == Access::write});
    return result;
  }

  std::int32_t number(const Token& token, std::int64_t lowest, std::int64_t highest) const {
    std::int64_t value = 0;
    const bool negative = token.text.substr(0, 1) == "-";
    if (token.kind != TokenKind::number || token.text.size() > 11)
      fail(token, "expected a number " + std::to_string(lowest) + " .. " + std::to_string(highest));
    for (const char c : token.text.substr(negative ? 1 : 0)) value = value * 10 + (c - '0');
    if (negative) value = -value;
    if (value < lowest || value > highest)
      fail(token, "the number is outside " + std::to_string(lowest) + " .. " + std::to_string(highest));
    return static_cast<std::int32_t>(value);
  }

  static Type type_of(const Operand& operand) {
    return !operand.is_constant && operand.address.is_bit() ? Type::boolean : Type::word;
  }

  void need(const Token& token, Type type) const {
    if (result_ == Type::undefined) fail(token, "no current result: start with LD");
    if (result_ != type)
      fail(token, type == Type::boolean ? "the current result is a word, a bit is needed"
                                        : "the current result is a bit, a word is needed");
  }
  void need_operand(const Token& token, const Operand& operand, Type type) const {
    if (type_of(operand) != type)
      fail(token, type == Type::boolean ? "the operand must be a bit" : "the operand must be a word");
  }
  void need_target(const Token& token, const Operand& operand) const {
    if (operand.is_constant) fail(token, "a constant cannot be written");
  }

  std::uint16_t instance(char kind, std::size_t count) {
    const Token token = next();
    const int value = number(token, 0, static_cast<std::int64_t>(count) - 1);
    const auto place = file_ + ":" + std::to_string(token.line);
    const auto [used, fresh] = instances_.emplace(std::pair(kind, value), place);
    if (!fresh) fail(token, "number " + std::to_string(value) + " is used already in " + used->second);
    return static_cast<std::uint16_t>(value);
  }

  void statement() {
    Token token = next();
    if (token.kind == TokenKind::symbol && token.text == ")") return close(token);
    if (token.kind != TokenKind::word) fail(token, "expected an instruction");
    if (is_symbol(":")) {
      ++at_;
      if (!open_.empty()) fail(token, "a label inside a parenthesis");
      if (!labels_.emplace(token.text, program_.instructions.size()).second)
        fail(token, "the label '" + std::string(token.text) + "' is defined already");
      result_ = Type::undefined;  // a jump to here may have any result type
      if (peek().kind == TokenKind::end_of_line) return;
      token = next();
    }
    const auto found = mnemonics.find(token.text);
    if (found == mnemonics.end()) fail(token, "unknown instruction '" + std::string(token.text) + "'");
    instruction(token, found->second);
    end_of_line();
  }

  void close(const Token& token) {
    if (open_.empty()) fail(token, "')' without '('");
    const auto open = open_.back();
    open_.pop_back();
    need(token, open.form == Form::logic ? Type::boolean : Type::word);
    program_.instructions.push_back({.op = Op::close, .operand = {}, .second = {}});
    result_ = open.form == Form::compare ? Type::boolean : open.before;
    end_of_line();
  }

  void instruction(const Token& token, const Mnemonic& mnemonic) {
    Instruction made;
    made.op = mnemonic.op;
    const Token where = peek();
    switch (mnemonic.form) {
      case Form::load:
        made.operand = operand();
        if (mnemonic.op == Op::load_not) need_operand(where, made.operand, Type::boolean);
        result_ = type_of(made.operand);
        break;
      case Form::store:
        made.operand = operand(Access::write);
        need_target(where, made.operand);
        need(token, mnemonic.op == Op::store_not ? Type::boolean : type_of(made.operand));
        need_operand(where, made.operand, result_);
        break;
      case Form::store_bit:
        need(token, Type::boolean);
        made.operand = operand(Access::write);
        need_operand(where, made.operand, Type::boolean);
        break;
      case Form::logic:
      case Form::arithmetic:
      case Form::compare: {
        const auto type = mnemonic.form == Form::logic ? Type::boolean : Type::word;
        need(token, type);
        if (is_symbol("(")) return parenthesis(token, made, mnemonic.form);
        made.operand = operand();
        need_operand(where, made.operand, type);
        if (mnemonic.form == Form::compare) result_ = Type::boolean;
        break;
      }
      case Form::bare_bool:
        need(token, Type::boolean);
        break;
      case Form::timer:
      case Form::counter: {
        need(token, Type::boolean);
        made.instance =
            mnemonic.form == Form::timer ? instance('t', timer_count) : instance('c', counter_count);
        expect(",");
        const Token preset = peek();
        made.operand = operand();
        need_operand(preset, made.operand, Type::word);
        break;
      }
      case Form::counter_reset:
        need(token, Type::boolean);
        made.instance = static_cast<std::uint16_t>(number(next(), 0, counter_count - 1));
        break;
      case Form::edge:
        need(token, Type::boolean);
        made.instance = instance('e', edge_count);
        break;
      case Form::move: {
        need(token, Type::boolean);
        made.operand = operand();
        need_operand(where, made.operand, Type::word);
        expect(",");
        const Token target = peek();
        made.second = operand(Access::write);
        need_target(target, made.second);
        need_operand(target, made.second, Type::word);
        break;
      }
      case Form::jump:
      case Form::end:
        if (!open_.empty()) fail(token, "a jump inside a parenthesis");
        if (mnemonic.op != Op::jump) need(token, Type::boolean);
        if (mnemonic.form == Form::jump) {
          if (where.kind != TokenKind::word) fail(where, "expected a label");
          jumps_.push_back({program_.instructions.size(), next()});
        } else {
          returns_.push_back(program_.instructions.size());
        }
        result_ = Type::undefined;
        break;
      case Form::close:
        break;
    }
    program_.instructions.push_back(made);
  }

  /// "(" with an operand loads it; without one the next line does.
  void parenthesis(const Token& token, Instruction made, Form form) {
    ++at_;
    if (open_.size() >= deepest_nesting) fail(token, "the parentheses are nested too deeply");
    open_.push_back({made.op, result_, form, token});
    made.opens = true;
    program_.instructions.push_back(made);
    result_ = Type::undefined;
    if (peek().kind == TokenKind::end_of_line) return;
    Instruction first;
    first.op = Op::load;
    first.operand = operand();
    result_ = type_of(first.operand);
    program_.instructions.push_back(first);
  }

  const std::string& file_;
  const Symbols& symbols_;
  std::map<std::pair<char, int>, std::string>& instances_;
  std::vector<std::string>& warnings_;
  std::set<std::string> moved_;  ///< warned of
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
  Program program_;
  Symbols names_;
  std::map<std::string_view, std::size_t> labels_;
  std::vector<Jump> jumps_;
  std::vector<std::size_t> returns_;
  std::vector<Open> open_;
  Type result_ = Type::undefined;
};

}  // namespace

Program Compiler::compile(std::string_view source, const std::string& file) {
  return Parser(source, file, symbols_, instances_, warnings_).run();
}

}  // namespace trunnion::il
