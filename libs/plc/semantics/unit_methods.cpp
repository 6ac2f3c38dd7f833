// SPDX-License-Identifier: Apache-2.0
// Methods of function blocks (IEC 61131-3:2013, 6.6.5 to 6.6.7): each is translated for the block of the
// instance, so that every call is decided before the programs run.
#include "plc/semantics/unit.hpp"

namespace trunnion::st {

MethodDeclaration Unit::find_method(const Pou& block, const std::string& upper) {
  for (const auto& declaration : block.declaration->methods)
    if (declaration.name == upper) return {&declaration, &block};
  return {};
}

Pou* Unit::method(Pou& instance, const MethodDeclaration& found, Position at) {
  auto& method = instance.methods[found.declared_in->declaration->name + "." + found.declaration->name];
  if (!method) {
    method = std::make_unique<Pou>();
    method->declaration = found.declaration;
    method->instance = &instance;
    method->declared_in = found.declared_in;
    method->type.kind = Kind::block;
    method->type.name = title_of(*method);
  }
  return complete(*method, at) ? method.get() : nullptr;
}

/// Those of the declaration of a function block, once all its variables are known.
void Unit::check_methods(const Pou& block) {
  if (block.is_method()) return;
  for (const auto& declaration : block.declaration->methods) {
    if (block.names.contains(declaration.name))
      diagnostics_.error(declaration.at, "'" + declaration.text + "' is a variable of '" +
                                             block.declaration->text + "' already");
    if (find_method(block, declaration.name).declaration != &declaration)
      diagnostics_.error(declaration.at, "the method '" + declaration.text + "' is declared twice");
  }
}

/// Also those that no body calls. Behind them it is known which variables of the blocks are used.
void Unit::translate_methods() {
  std::vector<Pou*> blocks;
  for (auto& [name, pou] : pous)
    if (pou.declaration->kind == PouKind::function_block && pou.state == Pou::State::done &&
        !is_library(pou.declaration->at))
      blocks.push_back(&pou);
  for (auto* block : blocks)
    for (const auto& declaration : block->declaration->methods)
      method(*block, {&declaration, block}, declaration.at);
  for (const auto* block : blocks) warn_unused(*block);
}

}  // namespace trunnion::st
