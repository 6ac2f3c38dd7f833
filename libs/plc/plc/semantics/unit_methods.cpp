// SPDX-License-Identifier: Apache-2.0
// Methods of function blocks (IEC 61131-3:2013, 6.6.5 to 6.6.7): each is translated for the block of the
// instance, so that every call is decided before the programs run.
#include <algorithm>

#include "plc/semantics/lowering.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {
namespace {

/// In `methods` of a block; the body of an extended one has the name of that block alone.
std::string key_of(const MethodDeclaration& found) {
  const auto& block = found.declared_in->declaration->name;
  return found.declaration->kind == PouKind::method ? block + "." + found.declaration->name : block;
}

bool same_result(const Pou& a, const Pou& b) {
  if (a.result == nullptr || b.result == nullptr) return a.result == b.result;
  return same_type(*a.result->type, *b.result->type);
}

}  // namespace

bool same_parameters(const Pou& a, const Pou& b) {
  const auto parameters = [](const Pou& pou) {
    std::vector<const Variable*> result;
    for (const auto& variable : pou.variables)
      if (is_parameter(variable, pou)) result.push_back(&variable);
    return result;
  };
  const auto first = parameters(a), second = parameters(b);
  return same_result(a, b) && std::equal(first.begin(), first.end(), second.begin(), second.end(),
                                         [](const Variable* x, const Variable* y) {
                                           return x->name == y->name && x->section == y->section &&
                                                  same_type(*x->type, *y->type);
                                         });
}

MethodDeclaration Unit::find_method(const Pou& block, const std::string& upper) {
  for (const Pou* one = &block; one != nullptr; one = one->parent)
    for (const auto& declaration : one->declaration->methods)
      if (declaration.name == upper) return {&declaration, one};
  return {};
}

void Unit::find_parent(Pou& pou) {
  const auto& extends = pou.declaration->extends;
  if (pou.is_method() || extends.name.empty()) return;
  const auto* parent = find_pou(extends.name);
  const char* problem = nullptr;
  if (parent == nullptr || parent->declaration->kind != PouKind::function_block)
    problem = "is no function block and no class";
  else if (parent->declaration->is_final)
    problem = "is FINAL and cannot be extended";
  else if (pou.declaration->is_class && !parent->declaration->is_class)
    problem = "is no class: a class extends a class";
  if (problem != nullptr)
    diagnostics_.error(extends.at, "'" + extends.text + "' " + problem);
  else
    pou.parent = translated(extends.name, extends.at);
}

Pou* Unit::method(Pou& instance, const MethodDeclaration& found, Position at) {
  auto& method = instance.methods[key_of(found)];
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

const Pou* Unit::declared_method(const MethodDeclaration& found) {
  const auto& methods = found.declared_in->methods;
  const auto own = methods.find(key_of(found));
  return own == methods.end() ? nullptr : own->second.get();
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
    check_override(block, declaration);
  }
  check_abstract(block);
}

void Unit::check_override(const Pou& block, const PouDeclaration& declaration) {
  auto inherited =
      block.parent == nullptr ? MethodDeclaration{} : find_method(*block.parent, declaration.name);
  if (inherited.declaration != nullptr && inherited.declaration->access == Access::private_) inherited = {};
  const auto name = "'" + declaration.text + "'";
  if (inherited.declaration == nullptr) {
    if (declaration.overrides)
      diagnostics_.error(declaration.at, "there is no method " + name + " to override");
    return;
  }
  const auto of = name + " of '" + inherited.declared_in->declaration->text + "'";
  if (inherited.declaration->is_final)
    diagnostics_.error(declaration.at, "the method " + of + " is FINAL and cannot be overridden");
  else if (!declaration.overrides)
    diagnostics_.warning(declaration.at, "the method takes the place of " + of + ": write METHOD OVERRIDE");
}

void Unit::check_abstract(const Pou& block) {
  if (block.declaration->is_abstract) return;
  for (const Pou* one = &block; one != nullptr; one = one->parent)
    for (const auto& declaration : one->declaration->methods)
      if (const auto found = find_method(block, declaration.name);
          found.declaration != nullptr && found.declaration->is_abstract)
        diagnostics_.error(block.declaration->at, "'" + block.declaration->text + "' has the method '" +
                                                      declaration.text + "', which is ABSTRACT in '" +
                                                      found.declared_in->declaration->text +
                                                      "': override it, or write FUNCTION_BLOCK ABSTRACT");
}

/// Behind the translation of all methods.
void Unit::compare_overrides(const Pou& block) {
  if (block.parent == nullptr) return;
  for (const auto& declaration : block.declaration->methods) {
    const auto inherited = find_method(*block.parent, declaration.name);
    if (inherited.declaration == nullptr || inherited.declaration->access == Access::private_) continue;
    const auto *own = declared_method({&declaration, &block}), *other = declared_method(inherited);
    if (own != nullptr && other != nullptr && !same_parameters(*own, *other))
      diagnostics_.error(declaration.at, "the method '" + declaration.text +
                                             "' has other parameters or another result than that of '" +
                                             inherited.declared_in->declaration->text + "'");
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
  for (const auto* block : blocks) {
    compare_overrides(*block);
    check_interfaces(*block);
    for (const auto& variable : block->variables)  // what a derived block uses is used
      if (variable.used && variable.declared_in != block && variable.declared_in != nullptr)
        if (const auto found = variable.declared_in->names.find(variable.name);
            found != variable.declared_in->names.end())
          found->second->used = true;
  }
  for (const auto* block : blocks) warn_unused(*block);
}

}  // namespace trunnion::st
