// SPDX-License-Identifier: Apache-2.0
#include "plc/syntax/parser.hpp"

#include <algorithm>
#include <iterator>
#include <map>

namespace trunnion::st {

void DeclarationParser::run() {
  tree_.scopes.emplace_back();
  scope_ = tree_.scopes.size() - 1;
  while (now().kind != TokenKind::end) {
    try {
      declaration();
    } catch (const Abandoned&) {
      recover();
    }
  }
  for (const auto& one : open_)
    diagnostics_.error(one.at, "the namespace '" + one.text + "' has no END_NAMESPACE");
}

void DeclarationParser::declaration() {
  if (accept_word("TYPE")) return type_block();
  if (is_word("VAR_GLOBAL")) return tree_.globals.push_back(variable_block());
  if (is_word("PROGRAM")) return pou(PouKind::program, "END_PROGRAM", "a program");
  if (is_word("FUNCTION")) return pou(PouKind::function, "END_FUNCTION", "a function");
  if (is_word("FUNCTION_BLOCK") || is_word("FUNCTIONBLOCK"))  // CoDeSys writes both
    return pou(PouKind::function_block, "END_FUNCTION_BLOCK", "a function block");
  if (at_interface()) return interface();
  if (at_class()) return pou(PouKind::function_block, "END_CLASS", "a class");
  if (is_word("TEST")) return pou(PouKind::test, "END_TEST", "a test");
  if (at_configuration()) return configuration();
  if (at_namespace()) return open_namespace();
  if (is_word("END_NAMESPACE")) return close_namespace();
  if (at_using()) return accept_using(tree_.scopes[scope_].usings);
  fail(std::string("PROGRAM, FUNCTION, FUNCTION_BLOCK, TEST, TYPE, VAR_GLOBAL or ") +
       (open_.empty() ? "CONFIGURATION" : "END_NAMESPACE"));
}

// To behind the end of a declaration, or to the next one.
void DeclarationParser::recover() {
  for (; now().kind != TokenKind::end; take()) {
    for (const auto* end : {"END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_CLASS", "END_INTERFACE",
                            "END_TEST", "END_TYPE", "END_CONFIGURATION"})
      if (is_word(end)) {
        take();
        return;
      }
    for (const auto* start : {"PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TEST", "TYPE", "VAR_GLOBAL"})
      if (is_word(start)) return;
    if (at_configuration() || at_class() || at_interface()) return;
    if (at_namespace() || is_word("END_NAMESPACE") || at_using()) return;
  }
}

void DeclarationParser::type_block() {
  const bool is_internal = accept_internal();
  while (!is_word("END_TYPE")) {
    TypeDeclaration declaration;
    const auto name = expect_name("the name of a type or END_TYPE");
    declaration.name = name.upper;
    declaration.text = name.text;
    declaration.at = name.at;
    declaration.is_internal = is_internal;
    declaration.scope = scope_;
    expect_symbol(":", "behind the name of the type");
    declaration.type = type_spec();
    const bool list = declaration.type->kind == TypeSpec::Kind::array;
    if (accept_symbol(":=")) declaration.initial = list ? array_initializer() : initializer();
    if (declaration.type->kind == TypeSpec::Kind::structure)
      accept_symbol(";");
    else
      expect_symbol(";", "behind the type");
    tree_.types.push_back(std::move(declaration));
  }
  take();
}

TypeSpecPtr DeclarationParser::type_spec() {
  const Depth depth(*this);
  auto spec = std::make_unique<TypeSpec>();
  spec->at = now().at;
  if (accept_symbol("(")) {
    enumeration(*spec);
  } else if (accept_word("STRUCT")) {
    spec->kind = TypeSpec::Kind::structure;
    while (!is_word("END_STRUCT")) variable_list(spec->fields, spec->own_types, spec->own_initials, false);
    take();
  } else if (accept_word("ARRAY")) {
    spec->kind = TypeSpec::Kind::array;
    expect_symbol("[", "before the limits of the array");
    do {
      auto& dimension = spec->dimensions.emplace_back();
      if (accept_symbol("*")) continue;
      dimension.low = expression();
      expect_symbol("..", "between the limits of the array");
      dimension.high = expression();
    } while (accept_symbol(","));
    expect_symbol("]", "behind the limits of the array");
    expect_word("OF", "before the type of the elements");
    spec->element = type_spec();
  } else if (is_word("REF_TO") && ahead().kind == TokenKind::identifier) {
    take();
    spec->kind = TypeSpec::Kind::reference;
    spec->element = type_spec();
  } else if (is_word("POINTER") && ahead().upper == "TO") {
    take(), take();
    spec->kind = TypeSpec::Kind::pointer;
    spec->element = type_spec();
  } else if (is_word("STRING") || is_word("WSTRING")) {
    spec->name = take().upper;
    spec->kind = TypeSpec::Kind::string;
    if (accept_symbol("[")) {
      spec->length = expression();
      expect_symbol("]", "behind the length of the string");
    } else if (accept_symbol("(")) {
      spec->length = expression();
      expect_symbol(")", "behind the length of the string");
    }
  } else {
    const auto name = expect_whole_name("a type");
    spec->name = name.upper;
    spec->text = name.text;
    if (at_named_values()) {
      take();
      enumeration(*spec);
    } else if (is_symbol("(")) {
      take();
      spec->low = expression();
      expect_symbol("..", "between the limits of the subrange");
      spec->high = expression();
      expect_symbol(")", "behind the subrange");
    }
  }
  return spec;
}

/// INT (low := 1, high := 5); a subrange has ".." behind its first limit.
bool DeclarationParser::at_named_values() const {
  const auto& behind = ahead(2);
  return is_symbol("(") && ahead().kind == TokenKind::identifier && behind.kind == TokenKind::symbol &&
         (behind.text == ":=" || behind.text == "," || behind.text == ")");
}

void DeclarationParser::enumeration(TypeSpec& spec) {
  spec.kind = TypeSpec::Kind::enumeration;
  do {
    auto& value = spec.enumerators.emplace_back();
    const auto name = expect_name("the name of an enumerated value");
    value.name = name.upper;
    value.text = name.text;
    value.at = name.at;
    if (accept_symbol(":=")) value.value = expression();
  } while (accept_symbol(","));
  expect_symbol(")", "behind the enumerated values");
}

// a, b AT %X0.0 : TYPE := value;
void DeclarationParser::variable_list(std::vector<VariableDeclaration>& variables,
                                      std::vector<TypeSpecPtr>& types, std::vector<ExpressionPtr>& initials,
                                      bool locations) {
  const auto first = variables.size();
  do {
    auto& variable = variables.emplace_back();
    const auto name = expect_name("the name of a variable");
    variable.name = name.upper;
    variable.text = name.text;
    variable.at = name.at;
    if (is_word("AT")) {
      if (!locations) fail("':' (a field has no address)");
      take();
      if (now().kind != TokenKind::direct) fail("an address like %R10.0 behind AT");
      variable.location_at = now().at;
      variable.location = take().text;
    }
  } while (accept_symbol(","));
  expect_symbol(":", "before the type of the variable");
  types.push_back(type_spec());
  auto edge = InputEdge::none;
  const auto edge_at = now().at;
  if (locations && accept_word("R_EDGE"))
    edge = InputEdge::rising;
  else if (locations && accept_word("F_EDGE"))
    edge = InputEdge::falling;
  Expression* initial = nullptr;
  if (accept_symbol(":=")) {
    const bool list = types.back()->kind == TypeSpec::Kind::array;
    initials.push_back(list ? array_initializer() : initializer());
    initial = initials.back().get();
  }
  expect_symbol(";", "behind the declaration");
  for (auto i = first; i < variables.size(); ++i) {
    variables[i].type = types.back().get();
    variables[i].edge = edge;
    variables[i].edge_at = edge_at;
    variables[i].initial = initial;
  }
}

VariableBlock DeclarationParser::variable_block() {
  static const std::map<std::string_view, VariableSection> sections = {
      {"VAR", VariableSection::local},
      {"VAR_INPUT", VariableSection::input},
      {"VAR_OUTPUT", VariableSection::output},
      {"VAR_IN_OUT", VariableSection::in_out},
      {"VAR_TEMP", VariableSection::temporary},
      {"VAR_GLOBAL", VariableSection::global},
      {"VAR_EXTERNAL", VariableSection::external}};
  VariableBlock block;
  block.at = now().at;
  block.scope = scope_;
  block.section = sections.at(take().upper);
  for (;;) {
    if (accept_word("RETAIN"))
      block.retain = true;
    else if (accept_word("CONSTANT"))
      block.constant = true;
    else if (block.section == VariableSection::global && accept_internal())
      block.is_internal = true;
    else if (!accept_word("NON_RETAIN") &&
             !(block.section == VariableSection::local && accept_access(block.access, block.is_internal)))
      break;
  }
  // What a call gives is no constant: VAR_INPUT CONSTANT of CoDeSys is VAR_INPUT.
  if (block.section == VariableSection::input) block.constant = false;
  while (!is_word("END_VAR")) {
    if (now().kind == TokenKind::end || at_pou_end()) fail("END_VAR");
    try {
      variable_list(block.variables, block.types, block.initials, true);
    } catch (const Abandoned&) {
      std::erase_if(block.variables, [](const auto& v) { return v.type == nullptr; });
      while (now().kind != TokenKind::end && !is_word("END_VAR") && !at_pou_end() && !accept_symbol(";"))
        take();
    }
  }
  take();
  for (auto& variable : block.variables) {
    const bool is_bool = variable.type->kind == TypeSpec::Kind::named && variable.type->name == "BOOL";
    if (variable.edge == InputEdge::none || (block.section == VariableSection::input && is_bool)) continue;
    refuse_edge(variable);
    variable.edge = InputEdge::none;
  }
  return block;
}

void DeclarationParser::refuse_edge(const VariableDeclaration& variable) {
  diagnostics_.error(variable.edge_at,
                     "R_EDGE and F_EDGE are for VAR_INPUT of programs and function blocks, and for BOOL");
}

bool DeclarationParser::at_pou_end() const {
  return is_word("END_PROGRAM") || is_word("END_FUNCTION") || is_word("END_FUNCTION_BLOCK") ||
         is_word("END_METHOD") || is_word("END_INTERFACE") || is_word("END_CLASS") || is_word("END_TEST") ||
         is_word("END_NAMESPACE") || is_word("VAR");
}

/// The edge detections of the inputs of one list, and their calls.
VariableBlock DeclarationParser::edge_blocks(const VariableBlock& block, const PouDeclaration& pou,
                                             Statements& calls) {
  const auto is_taken = [&](const std::string& upper) {
    return std::any_of(pou.blocks.begin(), pou.blocks.end(), [&](const VariableBlock& one) {
      return std::any_of(one.variables.begin(), one.variables.end(),
                         [&](const VariableDeclaration& variable) { return variable.name == upper; });
    });
  };
  VariableBlock result;
  result.retain = block.retain;
  result.at = block.at;
  for (const auto& variable : block.variables) {
    if (variable.edge == InputEdge::none) continue;
    if (pou.kind != PouKind::function_block && pou.kind != PouKind::program) {
      refuse_edge(variable);
      continue;
    }
    const bool rising = variable.edge == InputEdge::rising;
    auto& detection = result.variables.emplace_back();
    detection.text = variable.text + (rising ? "_rising" : "_falling");
    while (is_taken(upper_case(detection.text))) detection.text += '_';
    detection.name = upper_case(detection.text);
    detection.at = variable.edge_at;
    auto& type = result.types.emplace_back(std::make_unique<TypeSpec>());
    type->at = variable.edge_at;
    // Without a text it is that of the standard library, whatever the namespace has.
    type->name = rising ? "R_TRIG" : "F_TRIG";
    detection.type = type.get();
    edges_[variable.name] = detection.text;
    auto& call = calls.emplace_back(std::make_unique<Statement>());
    call->kind = Statement::Kind::call;
    call->at = variable.edge_at;
    call->value = make(Expression::Kind::call, variable.edge_at);
    call->value->parts.push_back(make_name(detection.text, variable.edge_at));
    auto& argument = call->value->arguments.emplace_back();
    argument.name = "CLK";
    argument.at = variable.edge_at;
    argument.value = make_name(variable.text, variable.edge_at);
  }
  return result;
}

/// Of all inputs with an edge; their detections are among the variables of the unit behind it.
Statements DeclarationParser::edge_calls(PouDeclaration& pou) {
  edges_.clear();
  Statements calls;
  std::vector<VariableBlock> added;
  for (const auto& block : pou.blocks) added.push_back(edge_blocks(block, pou, calls));
  for (auto& block : added)
    if (!block.variables.empty()) pou.blocks.push_back(std::move(block));
  return calls;
}

void DeclarationParser::variable_blocks(PouDeclaration& pou) {
  while (now().kind == TokenKind::identifier && now().upper.rfind("VAR", 0) == 0 &&
         (ahead().kind != TokenKind::symbol)) {
    if (is_word("VAR_GLOBAL")) {
      tree_.globals.push_back(variable_block());
      continue;
    }
    static const std::string_view sections[] = {"VAR",        "VAR_INPUT", "VAR_OUTPUT",
                                                "VAR_IN_OUT", "VAR_TEMP",  "VAR_EXTERNAL"};
    if (std::find(std::begin(sections), std::end(sections), now().upper) == std::end(sections)) break;
    pou.blocks.push_back(variable_block());
  }
}

void DeclarationParser::pou(PouKind kind, std::string_view end, std::string_view what) {
  PouDeclaration pou;
  pou.kind = kind;
  pou.is_class = is_word("CLASS");
  take();
  const bool has_methods = kind == PouKind::function_block;
  if (has_methods) block_modifiers(pou);
  if (kind == PouKind::function) pou.is_internal = accept_internal();
  if (kind == PouKind::test && now().kind == TokenKind::string) {
    const auto name = take();
    pou.name = "TEST " + name.text;
    pou.text = name.text;
    pou.at = name.at;
  } else {
    const auto name = expect_name("the name of " + std::string(what));
    pou.name = kind == PouKind::test ? "TEST " + name.text : name.upper;
    pou.text = name.text;
    pou.at = name.at;
  }
  std::vector<NamedPlace> usings;
  accept_using(usings);
  if (is_symbol(":")) {
    if (kind != PouKind::function) fail("declarations (only a function has a result type)");
    take();
    pou.result = type_spec();
  }
  if (has_methods) extends(pou);
  accept_symbol(";");
  accept_using(usings);
  pou.scope = scope_with(std::move(usings));
  variable_blocks(pou);
  if (has_methods) methods(pou);
  pou.body = edge_calls(pou);
  for (;;) {
    auto body = statements({"END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK", "END_CLASS", "END_TEST"});
    std::move(body.begin(), body.end(), std::back_inserter(pou.body));
    if (!has_methods || !at_method()) break;
    methods(pou);
  }
  edges_.clear();
  if (pou.is_class) check_class(pou);
  pou.end = now().at;
  expect_word(end, "at the end of " + std::string(what));
  accept_symbol(";");
  tree_.pous.push_back(std::move(pou));
}

void parse(std::vector<Token> tokens, SourceTree& tree, Diagnostics& diagnostics) {
  DeclarationParser(std::move(tokens), tree, diagnostics).run();
}

bool is_expression(std::vector<Token> tokens, Position at, Diagnostics& diagnostics) {
  class One : public ExpressionParser {
   public:
    using ExpressionParser::ExpressionParser;
    bool run() {
      try {
        expression();
        if (now().kind == TokenKind::end) return true;
        fail("one value or variable");
      } catch (const Abandoned&) {
        return false;
      }
    }
  };
  tokens.push_back({TokenKind::end, "the end", "", 10, tokens.empty() ? at : tokens.back().at});
  return One(std::move(tokens), diagnostics).run();
}

void parse(std::string_view source, std::uint16_t file, SourceTree& tree, Diagnostics& diagnostics) {
  DeclarationParser(tokenize(source, file, diagnostics), tree, diagnostics).run();
}

}  // namespace trunnion::st
