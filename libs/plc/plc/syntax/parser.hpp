// SPDX-License-Identifier: Apache-2.0
// From words to the syntax tree.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "plc/syntax/ast.hpp"
#include "plc/syntax/token.hpp"

namespace trunnion::st {

/// Adds what the source declares to `tree`. After an error it continues behind the statement or declaration.
void parse(std::string_view source, std::uint16_t file, SourceTree& tree, Diagnostics& diagnostics);

/// The same for words that were made otherwise; the last one is `end`.
void parse(std::vector<Token> tokens, SourceTree& tree, Diagnostics& diagnostics);
/// Whether the words, without `end`, are one expression; what is wrong is reported, at `at` when there are
/// none.
bool is_expression(std::vector<Token> tokens, Position at, Diagnostics& diagnostics);

/// What the parts of the parser share: the words, and what to do at an error.
class TokenReader {
 public:
  TokenReader(std::vector<Token> tokens, Diagnostics& diagnostics)
      : tokens_(std::move(tokens)), diagnostics_(diagnostics) {}

 protected:
  /// Leaves the current statement or declaration.
  struct Abandoned {};

  const Token& now() const { return tokens_[next_]; }
  const Token& ahead(std::size_t count = 1) const {
    return tokens_[std::min(next_ + count, tokens_.size() - 1)];
  }
  Token take() { return next_ + 1 < tokens_.size() ? tokens_[next_++] : tokens_[next_]; }
  bool is_symbol(std::string_view text) const {
    return now().kind == TokenKind::symbol && now().text == text;
  }
  bool is_word(std::string_view upper) const {
    return now().kind == TokenKind::identifier && now().upper == upper;
  }
  bool accept_symbol(std::string_view text);
  bool accept_word(std::string_view upper);
  void expect_symbol(std::string_view text, std::string_view where);
  void expect_word(std::string_view upper, std::string_view where);
  Token expect_name(std::string_view what);
  /// With the names of namespaces before it: a.b.name
  Token expect_whole_name(std::string_view what);
  [[noreturn]] void fail(const std::string& expected);
  /// How the current word is named in a message.
  std::string found() const;
  static bool is_keyword(const Token& token);
  bool is_keyword() const { return is_keyword(now()); }
  bool is_name(const Token& token) const { return token.kind == TokenKind::identifier && !is_keyword(token); }
  /// CONFIGURATION is a name elsewhere.
  bool at_configuration() const { return is_word("CONFIGURATION") && ahead().kind == TokenKind::identifier; }
  bool at_namespace() const { return is_word("NAMESPACE") && ahead().kind == TokenKind::identifier; }
  /// Nesting of expressions, types and statements; throws Abandoned beyond a limit.
  class Depth {
   public:
    explicit Depth(TokenReader& reader) : reader_(reader) {
      if (++reader_.depth_ > 200) {
        --reader_.depth_;
        reader_.fail("less nesting (at most 200 levels)");
      }
    }
    ~Depth() { --reader_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    TokenReader& reader_;
  };

  std::vector<Token> tokens_;
  Diagnostics& diagnostics_;
  std::size_t next_ = 0;
  int depth_ = 0;
};

class ExpressionParser : public TokenReader {
 public:
  using TokenReader::TokenReader;

 protected:
  ExpressionPtr expression(int precedence = 0);
  ExpressionPtr initial_list(Position at);
  ExpressionPtr array_initializer();
  ExpressionPtr initializer();
  /// A variable, or a call of a function or function block.
  ExpressionPtr designator();
  std::vector<Argument> arguments();
  ExpressionPtr make(Expression::Kind kind, Position at) const;
  ExpressionPtr make_name(const std::string& text, Position at) const;

  /// Of the unit whose body is read: inputs with R_EDGE or F_EDGE, in capitals, and the blocks that detect
  /// the edges.
  std::map<std::string, std::string, std::less<>> edges_;

 private:
  ExpressionPtr unary();
  ExpressionPtr primary();
  bool at_typed_literal() const;
  ExpressionPtr typed_literal();
  bool at_scoped_name() const;
  ExpressionPtr scoped_name();
  bool is_called_operator() const;
  ExpressionPtr operator_call();
};

class StatementParser : public ExpressionParser {
 public:
  using ExpressionParser::ExpressionParser;

 protected:
  /// Up to one of the words, which is not consumed.
  Statements statements(std::initializer_list<std::string_view> ends);
  /// METHOD is a name elsewhere.
  bool at_method() const { return is_word("METHOD") && ahead().kind == TokenKind::identifier; }
  bool at_interface() const { return is_word("INTERFACE") && ahead().kind == TokenKind::identifier; }
  bool at_class() const { return is_word("CLASS") && ahead().kind == TokenKind::identifier; }

 private:
  std::unique_ptr<Statement> statement();
  bool diagram_statement(Statement& s);
  void if_statement(Statement& s);
  void case_statement(Statement& s);
  void for_statement(Statement& s);
  bool at_case_label() const;
  bool at_declaration() const;
  void recover(std::initializer_list<std::string_view> ends);
  std::vector<CaseLabel> labels();
};

class DeclarationParser : public StatementParser {
 public:
  DeclarationParser(std::vector<Token> tokens, SourceTree& tree, Diagnostics& diagnostics)
      : StatementParser(std::move(tokens), diagnostics), tree_(tree) {}

  void run();

 private:
  void declaration();
  void recover();
  void type_block();
  TypeSpecPtr type_spec();
  bool at_named_values() const;
  void enumeration(TypeSpec& spec);
  void variable_list(std::vector<VariableDeclaration>& variables, std::vector<TypeSpecPtr>& types,
                     std::vector<ExpressionPtr>& initials, bool locations);
  VariableBlock variable_block();
  void refuse_edge(const VariableDeclaration& variable);
  VariableBlock edge_blocks(const VariableBlock& block, const PouDeclaration& pou, Statements& calls);
  Statements edge_calls(PouDeclaration& pou);
  bool at_pou_end() const;
  void variable_blocks(PouDeclaration& pou);
  bool accept_access(Access& access, bool& is_internal);
  bool accept_internal();
  bool accept_modifier(PouDeclaration& unit);
  void block_modifiers(PouDeclaration& block);
  void extends(PouDeclaration& block);
  std::vector<NamedPlace> interface_names();
  void interface();
  NamedPlace named_place(std::string_view what);
  void open_namespace();
  void close_namespace();
  bool at_using() const { return is_word("USING") && is_name(ahead()); }
  void accept_using(std::vector<NamedPlace>& usings);
  std::size_t scope_with(std::vector<NamedPlace> usings);
  void check_class(const PouDeclaration& block);
  void methods(PouDeclaration& block);
  PouDeclaration method();
  void pou(PouKind kind, std::string_view end, std::string_view what);
  void configuration();
  void resource(ConfigurationDeclaration& configuration, std::string_view end);
  void task(ConfigurationDeclaration& configuration);
  void program_configuration(ConfigurationDeclaration& configuration);

  struct OpenNamespace {
    std::size_t outer;   ///< scope around it
    std::size_t levels;  ///< of namespaces, with its own
    std::string text;
    Position at;
  };

  SourceTree& tree_;
  std::size_t scope_ = 0;
  std::vector<OpenNamespace> open_;
};

}  // namespace trunnion::st
