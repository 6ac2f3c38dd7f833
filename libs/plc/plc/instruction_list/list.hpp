// SPDX-License-Identifier: Apache-2.0
// Instruction lists (IEC 61131-3:2003, 3.2) into words of Structured Text.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plc/syntax/token.hpp"

namespace trunnion::st {

/// Each line is one instruction, "label:" before it. The current result is gone at a label; LD comes first
/// there. A list of a file (list_file.hpp) overrides what its instructions do otherwise.
class InstructionList {
 public:
  InstructionList(Tokens words, std::uint16_t file, Diagnostics& diagnostics)
      : words_(std::move(words)), file_(file), diagnostics_(diagnostics) {}
  virtual ~InstructionList() = default;

  /// The statements, up to the first error.
  Tokens run();

 protected:
  /// `line` is without label.
  virtual void instruction(Tokens line);
  /// The operator waits for the result of the parenthesis, which may change what was loaded before.
  virtual void open(const std::string& op, bool inverts, Tokens line, Position at);
  virtual void close(Position at);
  virtual void apply(const std::string& op, bool inverts, Tokens operand, Position at);
  virtual void store(const std::string& op, const Tokens& target, Position at);
  /// What keep() assigns the current result to.
  virtual Token new_value(Position at);

  void fail(Position at, const std::string& text);
  Tokens words(std::string_view text, Position at);
  void write(std::string_view text, Position at) { append(result_, words(text, at)); }
  void write(Tokens tokens) { append(result_, std::move(tokens)); }
  /// The current result as a value of its own: later instructions may change what it was read from.
  void keep(Position at);
  bool has_result(Position at);
  /// Whether the words are one expression; what is wrong is reported.
  bool expression(const Tokens& words, Position at);
  /// A function is its own operator: LIMIT(MN := 0, IN := x, MX := 5), or LIMIT x, 5 behind LD 0.
  static bool is_call(const std::string& op, const Token& first, const Tokens& line);
  /// How Structured Text writes the operator.
  static const char* sign_of(const std::string& op);

  Tokens current_;  ///< the current result, an expression; empty: none
  std::size_t depth() const { return open_.size(); }

 private:
  struct Open {
    Tokens before;
    std::string op;
    bool inverts;
    Position at;
  };

  static Token own(const char* text, Position at) { return {TokenKind::symbol, text, text, 10, at}; }
  void line();
  void combine(const char* begin, Tokens more, const char* end, Position at);
  void function(const Token& name, Tokens arguments);
  bool condition(const std::string& op, const char* plain, Position at);
  void jump(const std::string& op, const Tokens& label, Position at);
  void call(const std::string& op, Tokens instance, Position at);

  Tokens words_, result_;
  std::uint16_t file_;
  Diagnostics& diagnostics_;
  std::vector<Open> open_;
  std::size_t next_ = 0, values_ = 0;
  bool good_ = true;
};

}  // namespace trunnion::st
