// SPDX-License-Identifier: Apache-2.0
// Interfaces (IEC 61131-3:2013, 6.6.6). A value of an interface is the address of an instance with the number
// of its function block in the upper half; each method of an interface becomes a routine that chooses by this
// number. So all calls are known before the programs run.
#include <algorithm>

#include "plc/semantics/lowering.hpp"
#include "plc/semantics/unit.hpp"

namespace trunnion::st {
namespace {

bool holds_reference(const Type& type) {
  if (type.kind == Kind::array) return holds_reference(*type.element);
  if (type.kind == Kind::structure)
    return std::any_of(type.fields.begin(), type.fields.end(),
                       [](const Field& field) { return holds_reference(*field.type); });
  if (type.kind != Kind::block) return is_reference(type.kind);
  const auto& variables = type.block->pou->variables;
  return std::any_of(variables.begin(), variables.end(), [](const Variable& variable) {
    return variable.section != VariableSection::in_out && variable.section != VariableSection::external &&
           holds_reference(*variable.type);
  });
}

}  // namespace

void Unit::refuse_retention(const Type& type, const std::string& name, Position at) {
  if (holds_reference(type))
    diagnostics_.error(at, "'" + name +
                               "' names a variable by its place, which changes with the programs: RETAIN is "
                               "not permitted");
}

Interface* Unit::find_interface(const std::string& upper) {
  const auto found = interfaces_.find(upper);
  return found == interfaces_.end() ? nullptr : &found->second;
}

bool Unit::extends(const Interface& interface, const Interface& other) {
  return &interface == &other ||
         std::any_of(interface.parents.begin(), interface.parents.end(),
                     [&](const Interface* parent) { return extends(*parent, other); });
}

bool Unit::implements(const PouDeclaration& block, const Interface& interface) {
  const auto* one = &block;
  // A block that extends itself is an error, which is found later.
  for (std::size_t levels = 0; one != nullptr && levels <= pous.size(); ++levels) {
    for (const auto& name : one->implements)
      if (const auto* found = find_interface(name.name); found != nullptr && extends(*found, interface))
        return true;
    const auto* parent = find_pou(one->extends.name);
    one = parent == nullptr ? nullptr : parent->declaration;
  }
  return false;
}

std::uint64_t Unit::implementer_number(const Pou& block) const {
  const auto found = std::find(implementers_.begin(), implementers_.end(), &block);
  return static_cast<std::uint64_t>(found - implementers_.begin()) + 1;
}

void Unit::declare_interfaces() {
  for (const auto& declaration : tree_.interfaces) {
    auto& interface = interfaces_[declaration.name];
    if (interface.declaration != nullptr || pous.contains(declaration.name) ||
        declared_.contains(declaration.name) || elementary(declaration.name) != nullptr) {
      diagnostics_.error(declaration.at, "'" + declaration.text + "' is declared already");
      if (interface.declaration != nullptr) continue;
    }
    interface.declaration = &declaration;
    interface.type.kind = Kind::interface_;
    interface.type.name = declaration.text;
    interface.type.interface = &interface;
    interface.type.initial = {null_reference};
  }
  for (auto& [name, interface] : interfaces_)
    for (const auto& parent : interface.declaration->extends) {
      auto* found = find_interface(parent.name);
      if (found == nullptr)
        diagnostics_.error(parent.at, "there is no interface '" + parent.text + "'");
      else if (extends(*found, interface))
        diagnostics_.error(parent.at, "the interface '" + parent.text + "' extends itself");
      else
        interface.parents.push_back(found);
    }
  for (auto& one : pous) {
    const auto& declaration = *one.second.declaration;
    for (const auto& wanted : declaration.implements)
      if (find_interface(wanted.name) == nullptr)
        diagnostics_.error(wanted.at, "there is no interface '" + wanted.text + "'");
    const auto implemented = [&](const auto& pair) { return implements(declaration, pair.second); };
    if (!declaration.is_abstract && std::any_of(interfaces_.begin(), interfaces_.end(), implemented))
      implementers_.push_back(&one.second);
  }
}

/// Those that nothing calls are checked too.
void Unit::declare_prototypes() {
  for (auto& [name, interface] : interfaces_)
    for (const auto& declaration : interface.declaration->methods)
      if (prototype(interface, declaration.name)->declaration != &declaration)
        diagnostics_.error(declaration.at, "the method '" + declaration.text + "' is declared twice");
}

Pou* Unit::prototype(Interface& interface, const std::string& upper) {
  for (const auto& declaration : interface.declaration->methods) {
    if (declaration.name != upper) continue;
    auto& method = interface.methods[upper];
    if (method) return method.get();
    method = std::make_unique<Pou>();
    method->declaration = &declaration;
    method->interface = &interface;
    method->type.kind = Kind::block;
    method->type.name = title_of(*method);
    declare_variables(*method);
    method->is_declared = true;
    return method.get();
  }
  for (auto* parent : interface.parents)
    if (auto* method = prototype(*parent, upper)) return method;
  return nullptr;
}

const Pou* Unit::dispatcher(Pou& prototype, Position at) {
  if (prototype.is_declared) return complete(prototype, at) ? &prototype : nullptr;
  diagnostics_.error(at, "the parameters of '" + title_of(prototype) + "' contain a call of it");
  return nullptr;
}

void Unit::translate_dispatcher(Pou& pou) {
  blocks_.push_back({&pou});
  pou.type.block = &blocks_.back();
  pou.frame = static_cast<std::uint32_t>(pou.initial.size());
  Lowering lowering(*this, &pou, pou.frame);
  for (std::size_t i = 0; i < implementers_.size(); ++i) {
    auto& block = *implementers_[i];
    if (!implements(*block.declaration, *pou.interface)) continue;
    // The body of the block may call the method: its variables are known then.
    if (!block.is_declared && translated(block.declaration->name, pou.called_at) == nullptr) continue;
    const auto found = find_method(block, pou.declaration->name);
    if (found.declaration == nullptr) continue;  // check_interfaces() reports it
    const auto* own = method(block, found, pou.called_at);
    if (own != nullptr && same_parameters(*own, pou)) lowering.dispatch(*own, i + 1);
  }
  lowering.end_dispatch();
  pou.frame = lowering.emitter().frame();
  check_frame(pou);
  pou.routine = add_routine(lowering.emitter(), pou.frame);
}

/// Behind the translation of all methods.
void Unit::check_interfaces(const Pou& block) {
  if (block.declaration->is_abstract) return;
  const auto& name = block.declaration->text;
  for (const auto& [upper, interface] : interfaces_) {
    if (!implements(*block.declaration, interface)) continue;
    for (const auto& [own, prototype] : interface.methods) {
      const auto found = find_method(block, own);
      const auto wanted = title_of(*prototype);
      const auto at = found.declaration != nullptr ? found.declaration->at : block.declaration->at;
      if (found.declaration == nullptr)
        diagnostics_.error(at, "'" + name + "' has no method '" + prototype->declaration->text +
                                   "' for the interface '" + interface.declaration->text + "'");
      else if (found.declaration->access != Access::public_)
        diagnostics_.error(at, "the method is that of an interface, '" + wanted + "': write METHOD PUBLIC");
      else if (const auto* method = declared_method(found);
               method != nullptr && !same_parameters(*method, *prototype))
        diagnostics_.error(at, "the method has other parameters or another result than '" + wanted + "'");
    }
  }
}

}  // namespace trunnion::st
