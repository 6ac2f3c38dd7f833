// SPDX-License-Identifier: Apache-2.0
// Classes and interfaces, methods of function blocks (IEC 61131-3:2013, 6.6.5 to 6.6.7), namespaces (6.9).
#include <utility>

#include "plc/syntax/parser.hpp"

namespace trunnion::st {

/// A word before another one; a variable or method with such a name stays what it is.
bool DeclarationParser::accept_access(Access& access, bool& is_internal) {
  if (ahead().kind != TokenKind::identifier) return false;
  if (accept_word("PUBLIC"))
    access = Access::public_;
  else if (accept_word("INTERNAL"))
    access = Access::public_, is_internal = true;
  else if (accept_word("PROTECTED"))
    access = Access::protected_;
  else if (accept_word("PRIVATE"))
    access = Access::private_;
  else
    return false;
  return true;
}

bool DeclarationParser::accept_internal() {
  const auto& next = ahead();
  if (!is_word("INTERNAL") || !(is_name(next) || next.upper == "CONSTANT" || next.upper == "RETAIN"))
    return false;
  take();
  return true;
}

bool DeclarationParser::accept_modifier(PouDeclaration& unit) {
  if (accept_word("FINAL"))
    unit.is_final = true;
  else if (accept_word("ABSTRACT"))
    unit.is_abstract = true;
  else if (unit.kind == PouKind::method && accept_word("OVERRIDE"))
    unit.overrides = true;
  else if (unit.kind != PouKind::method && accept_word("INTERNAL"))
    unit.is_internal = true;
  else
    return false;
  return true;
}

void DeclarationParser::block_modifiers(PouDeclaration& block) {
  while (is_name(ahead()) && accept_modifier(block)) continue;
}

NamedPlace DeclarationParser::named_place(std::string_view what) {
  const auto name = expect_whole_name(what);
  return {name.upper, name.text, name.at};
}

/// NAMESPACE a.b is NAMESPACE b in NAMESPACE a.
void DeclarationParser::open_namespace() {
  take();
  const bool is_internal = accept_internal();
  OpenNamespace opened{scope_, open_.empty() ? 0 : open_.back().levels, "", now().at};
  std::vector<Token> parts;
  do parts.push_back(expect_name("the name of a namespace"));
  while (accept_symbol("."));
  opened.levels += parts.size();
  if (opened.levels > 200) fail("less nesting (at most 200 levels)");
  for (const auto& part : parts) {
    NamingScope scope;
    const auto& outer = tree_.scopes[scope_];
    scope.name = outer.name.empty() ? part.upper : outer.name + "." + part.upper;
    scope.text = outer.name.empty() ? part.text : outer.text + "." + part.text;
    scope.at = part.at;
    scope.is_internal = is_internal && &part == &parts.back();
    scope.outer = scope_;
    tree_.scopes.push_back(std::move(scope));
    scope_ = tree_.scopes.size() - 1;
  }
  opened.text = tree_.scopes[scope_].text;
  open_.push_back(std::move(opened));
  accept_symbol(";");
}

void DeclarationParser::close_namespace() {
  const auto word = take();
  if (open_.empty()) {
    diagnostics_.error(word.at, "there is no NAMESPACE that END_NAMESPACE ends");
    throw Abandoned{};
  }
  scope_ = open_.back().outer;
  open_.pop_back();
  accept_symbol(";");
}

void DeclarationParser::accept_using(std::vector<NamedPlace>& usings) {
  while (at_using()) {
    do {
      take();
      usings.push_back(named_place("the name of a namespace"));
    } while (is_symbol(","));
    expect_symbol(";", "behind the namespaces");
  }
}

/// The scope of a unit.
std::size_t DeclarationParser::scope_with(std::vector<NamedPlace> usings) {
  if (usings.empty()) return scope_;
  NamingScope scope;
  scope.name = tree_.scopes[scope_].name;
  scope.text = tree_.scopes[scope_].text;
  scope.at = usings[0].at;
  scope.outer = scope_;
  scope.usings = std::move(usings);
  tree_.scopes.push_back(std::move(scope));
  return tree_.scopes.size() - 1;
}

void DeclarationParser::extends(PouDeclaration& block) {
  if (is_word("EXTENDS") && is_name(ahead())) {
    take();
    block.extends = named_place("the function block or class that is extended");
  }
  if (is_word("IMPLEMENTS") && is_name(ahead())) block.implements = interface_names();
}

/// Behind EXTENDS or IMPLEMENTS.
std::vector<NamedPlace> DeclarationParser::interface_names() {
  std::vector<NamedPlace> result;
  do {
    take();
    result.push_back(named_place("the name of an interface"));
  } while (is_symbol(","));
  return result;
}

void DeclarationParser::interface() {
  InterfaceDeclaration interface;
  take();
  interface.is_internal = accept_internal();
  const auto name = expect_name("the name of the interface");
  interface.name = name.upper;
  interface.text = name.text;
  interface.at = name.at;
  std::vector<NamedPlace> usings;
  accept_using(usings);
  if (is_word("EXTENDS") && is_name(ahead())) interface.extends = interface_names();
  accept_symbol(";");
  interface.scope = scope_with(std::move(usings));
  while (at_method()) {
    interface.methods.push_back(method());
    const auto& prototype = interface.methods.back();
    if (!prototype.body.empty())
      diagnostics_.error(prototype.body[0]->at, "a method of an interface has no statements");
  }
  expect_word("END_INTERFACE", "or METHOD in the interface");
  accept_symbol(";");
  tree_.interfaces.push_back(std::move(interface));
}

void DeclarationParser::check_class(const PouDeclaration& block) {
  if (!block.body.empty()) diagnostics_.error(block.body[0]->at, "a class has no body: write a METHOD");
  for (const auto& one : block.blocks)
    if (one.section != VariableSection::local && one.section != VariableSection::external)
      diagnostics_.error(one.at,
                         "a class has VAR and VAR_EXTERNAL; inputs and outputs are those of its methods");
}

/// Inputs whose edges the body of the block detects are the inputs themselves in a method.
void DeclarationParser::methods(PouDeclaration& block) {
  auto edges = std::exchange(edges_, {});
  while (at_method()) block.methods.push_back(method());
  edges_ = std::move(edges);
}

PouDeclaration DeclarationParser::method() {
  PouDeclaration method;
  take();
  method.kind = PouKind::method;
  while (is_name(ahead()) && (accept_access(method.access, method.is_internal) || accept_modifier(method)))
    continue;
  const auto name = expect_name("the name of a method");
  method.name = name.upper;
  method.text = name.text;
  method.at = name.at;
  if (accept_symbol(":")) method.result = type_spec();
  accept_symbol(";");
  variable_blocks(method);
  method.body = edge_calls(method);
  auto body = statements({"END_METHOD"});
  for (auto& statement : body) method.body.push_back(std::move(statement));
  if (method.is_abstract && !method.body.empty())
    diagnostics_.error(method.body[0]->at, "an ABSTRACT method has no statements");
  method.end = now().at;
  expect_word("END_METHOD", "at the end of the method");
  accept_symbol(";");
  return method;
}

}  // namespace trunnion::st
