// SPDX-License-Identifier: Apache-2.0
// Methods: their variables, the running instance, calls. The frame of a method is among the intermediate
// results of its caller, so a task that is interrupted in one keeps it.
#include <optional>
#include <string>
#include <vector>

#include "plc/semantics/lowering.hpp"
#include "plc/semantics/namespaces.hpp"

namespace trunnion::st {

Pou* Lowering::instance() const {
  if (pou_ == nullptr) return nullptr;
  if (pou_->is_method()) return pou_->instance;
  return pou_->declaration->kind == PouKind::function_block ? pou_ : nullptr;
}

const Pou* Lowering::declaring() const {
  return pou_ != nullptr && pou_->is_method() ? pou_->declared_in : instance();
}

Place Lowering::self() const {
  if (!pou_->is_method()) return {Place::Base::frame, 0, 0, -1, 0, 0, true, ""};
  return {Place::Base::indirect, 0, static_cast<std::int32_t>(pou_->self), -1, 0, 0, true, ""};
}

Variable* Lowering::own_variable(const Expression& name) const {
  if (pou_ == nullptr || name.scope == NameScope::base) return nullptr;
  if (name.scope == NameScope::any)
    if (const auto found = pou_->names.find(name.name); found != pou_->names.end()) return found->second;
  const auto* block = instance();
  if (block == nullptr) return nullptr;
  const auto found = block->names.find(name.name);
  return found != block->names.end() && is_inherited(*found->second) ? found->second : nullptr;
}

/// Whether the block that declares this body or method has the variable. Those of a block that extends it are
/// in the instance too, but its code means others by their names.
bool Lowering::is_inherited(const Variable& variable) const {
  const auto* block = declaring();
  while (block != nullptr && block != variable.declared_in) block = block->parent;
  return block != nullptr;
}

/// Why the method must not use the variable of its block, or nothing.
std::string Lowering::hidden(const Variable& variable) const {
  if (variable.declared_in == nullptr) return "";
  const bool in_method = pou_->declaration->kind == PouKind::method;
  if (in_method && variable.section == VariableSection::temporary)
    return "VAR_TEMP '" + variable.text + "' has a value in the body of the function block only";
  // The variable that the last call of the body has given may be gone.
  if (in_method && variable.section == VariableSection::in_out)
    return "VAR_IN_OUT '" + variable.text + "' is of calls of the body: pass the variable to the method";
  if (variable.access == Access::private_ && variable.declared_in != declaring())
    return "'" + variable.text + "' is PRIVATE in '" + variable.declared_in->declaration->text + "'";
  return variable.is_internal ? internal(variable.text, *variable.declared_in->declaration) : "";
}

/// Why what is INTERNAL in a function block must not be used here, or nothing.
std::string Lowering::internal(const std::string& text, const PouDeclaration& of) const {
  if (of.space.empty() || (pou_ != nullptr && is_within(pou_->declaration->space, of.space))) return "";
  return "'" + text + "' of '" + of.text + "' is INTERNAL and visible in the namespace '" +
         of.text.substr(0, of.text.rfind('.')) + "' only";
}

/// Why THIS.name or SUPER.name means nothing.
std::string Lowering::scope_problem(const Expression& name) const {
  if (instance() == nullptr) return "THIS and SUPER are for function blocks and their methods";
  const auto& own = declaring()->declaration->text;
  if (name.scope == NameScope::instance) return "'" + own + "' has no variable '" + name.text + "'";
  if (declaring()->parent == nullptr) return "'" + own + "' extends no function block, so it has no SUPER";
  const auto& parent = *declaring()->parent->declaration;
  return "SUPER is for methods, and '" + parent.text + "' has no method '" + name.text + "'";
}

/// A method of the running instance that the block whose code this is has too. A PRIVATE one of this block
/// comes first: others cannot override it.
MethodDeclaration Lowering::own_method(const Expression& callee) const {
  const auto* parent = declaring()->parent;
  if (callee.scope == NameScope::base && parent == nullptr) return {};
  if (callee.scope == NameScope::base && callee.name.empty()) return {parent->declaration, parent};
  if (callee.scope == NameScope::base) return Unit::find_method(*parent, callee.name);
  const auto own = Unit::find_method(*declaring(), callee.name);
  const bool is_private = own.declared_in == declaring() && own.declaration->access == Access::private_;
  return own.declaration == nullptr || is_private ? own : Unit::find_method(*instance(), callee.name);
}

std::optional<Lowering::MethodCall> Lowering::called_method(const Expression& callee) const {
  MethodCall result;
  if (callee.kind == Expression::Kind::name) {
    const auto* variable = own_variable(callee);
    result.instance = instance();
    if (result.instance == nullptr || (variable != nullptr && variable->type->kind == Kind::block))
      return std::nullopt;
    result.method = own_method(callee);
  } else if (callee.kind == Expression::Kind::member) {
    const auto* type = instance_type(*callee.parts[0]);
    if (type != nullptr && type->kind == Kind::interface_) {
      result.of = callee.parts[0].get();
      result.prototype = unit_.prototype(*type->interface, callee.name);
      if (result.prototype != nullptr) result.method.declaration = result.prototype->declaration;
    }
    if (type == nullptr || type->kind != Kind::block || type->block->pou->names.contains(callee.name))
      return result.prototype == nullptr ? std::nullopt : std::optional(result);
    result.instance = type->block->pou;
    result.of = callee.parts[0].get();
    result.method = Unit::find_method(*result.instance, callee.name);
  }
  if (result.method.declaration == nullptr) return std::nullopt;
  return result;
}

bool Lowering::is_accessible(const MethodCall& called) const {
  const auto access = called.method.declaration->access;
  if (access == Access::public_) return true;
  return called.of == nullptr && (access == Access::protected_ || called.method.declared_in == declaring());
}

Value Lowering::call_method(const MethodCall& called, const Expression& e) {
  if (called.prototype != nullptr) return call_interface(called, e);
  const auto at = e.parts[0]->at;
  const auto& declaration = *called.method.declaration;
  if (declaration.is_class) return failed(at, "'" + declaration.text + "' is a class and has no body");
  const bool is_method = declaration.kind == PouKind::method;
  if (is_method && e.parts[0]->scope == NameScope::base && declaration.is_abstract)
    return failed(at, "the method '" + declaration.text + "' is ABSTRACT and has no statements");
  if (!is_accessible(called))
    return failed(at, "the method '" + declaration.text + "' of '" +
                          called.method.declared_in->declaration->text + "' is " +
                          (declaration.access == Access::private_ ? "PRIVATE" : "PROTECTED"));
  if (is_method && declaration.is_internal)
    if (const auto refusal = internal(declaration.text, *called.method.declared_in->declaration);
        !refusal.empty())
      return failed(at, refusal);
  // A reference may name an instance of the block that contains this one.
  if (!called.instance->is_declared)
    return failed(at, "'" + called.instance->declaration->text + "' contains '" +
                          (pou_ == nullptr ? std::string() : title_of(*pou_)) +
                          "', which therefore cannot call its method '" + declaration.text + "'");
  auto place = called.of == nullptr ? self() : Place{};
  if (called.of != nullptr) {
    const auto instance = target(*called.of);
    if (instance.is_error()) return instance;
    auto access = writing();
    access.calls = true;
    note(*called.of, instance, access);
    place = located(instance).place;
  }
  const auto* method = unit_.method(*called.instance, called.method, at);
  return method == nullptr ? error() : call_with_frame(*method, address(place), e);
}

Value Lowering::call_with_frame(const Pou& method, std::int32_t self, const Expression& e) {
  std::vector<const Argument*> bound;
  if (!bind(method, e, false, bound)) return error();
  if (emit_.mark() + std::uint64_t{method.frame} > most_cells)
    return failed(e.parts[0]->at, "the variables of the methods that this statement calls need more than " +
                                      std::to_string(most_cells) + " cells");
  const auto start = emit_.temporary(method.frame);
  const auto value_of = [&](const Variable& variable, bool writable) {
    Value value;
    value.type = variable.type;
    value.place = {Place::Base::frame, start + variable.place.offset, 0, -1, 0, 0,
                   writable,           "is an intermediate result"};
    return value;
  };
  emit_.add(Op::move, start + static_cast<std::int32_t>(method.self), self);
  std::size_t i = 0;
  for (const auto& variable : method.variables) {
    if (!is_parameter(variable, method)) continue;
    const auto* argument = bound[i++];
    if (variable.section == VariableSection::output) continue;
    const auto parameter = value_of(variable, true);
    if (variable.section == VariableSection::in_out) {
      const auto sources = reference(*argument, variable);
      for (std::size_t k = 0; k < sources.size(); ++k)
        emit_.add(Op::move, parameter.place.offset + static_cast<std::int32_t>(k), sources[k]);
    } else if (argument == nullptr) {
      fill(parameter.place.offset, variable.initial);
    } else {
      store(parameter,
            converted(expression(*argument->value, variable.type), *variable.type, argument->value->at));
    }
  }
  const auto frame = emit_.temporary();
  emit_.add(Op::address, frame, start);
  emit_.add(Op::call_at, static_cast<std::int32_t>(method.routine), frame);
  i = 0;
  for (const auto& variable : method.variables) {
    if (!is_parameter(variable, method)) continue;
    const auto* argument = bound[i++];
    if (argument != nullptr && variable.section == VariableSection::output)
      give_output(*argument, value_of(variable, false));
  }
  if (method.result != nullptr) return value_of(*method.result, false);
  Value none;
  none.type = elementary(Kind::none);
  return none;
}

}  // namespace trunnion::st
