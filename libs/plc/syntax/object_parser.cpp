// SPDX-License-Identifier: Apache-2.0
// Methods of function blocks (IEC 61131-3:2013, 6.6.5 to 6.6.7).
#include <utility>

#include "plc/syntax/parser.hpp"

namespace trunnion::st {

/// A word before another one; a variable or method with such a name stays what it is.
bool DeclarationParser::accept_access(Access& access) {
  if (ahead().kind != TokenKind::identifier) return false;
  if (accept_word("PUBLIC") || accept_word("INTERNAL"))
    access = Access::public_;
  else if (accept_word("PROTECTED"))
    access = Access::protected_;
  else if (accept_word("PRIVATE"))
    access = Access::private_;
  else
    return false;
  return true;
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
  while (is_name(ahead()) && accept_access(method.access)) continue;
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
  method.end = now().at;
  expect_word("END_METHOD", "at the end of the method");
  accept_symbol(";");
  return method;
}

}  // namespace trunnion::st
