// SPDX-License-Identifier: Apache-2.0
// REF_TO: a reference is the address of a variable that lasts as long as the programs run. NULL is an address
// that no memory has, so every use of it is a fault of the machine.
#include <string>

#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

constexpr const char* register_refusal = "a register has no reference; copy it to a variable";

}  // namespace

Value Lowering::dereference(const Expression& e) {
  const auto value = kept(expression(*e.parts[0]));
  if (value.is_error()) return value;
  const bool points = value.type->kind == Kind::pointer;
  if ((value.type->kind != Kind::reference && !points) || value.type->element == nullptr)
    return failed(e.at, value.type->name + " is no reference, so it has no '^'");
  if (points) return pointed_by(value, e.at);
  Value result;
  result.type = value.type->element;
  result.place = {Place::Base::indirect, 0, cell(value), -1, 0, 0, true, ""};
  return result;
}

/// Why a reference must not name the variable, or nothing.
std::string Lowering::passing(const Expression& e) const {
  const auto* root = &root_of(e);
  if (root->kind == Expression::Kind::direct) return register_refusal;
  if (root->kind != Expression::Kind::name) return "";
  const auto* variable = own_variable(*root);
  if (variable == nullptr) variable = unit_.find_global(root->name);
  if (variable == nullptr) return "";
  if (is_in_image(variable->place)) return register_refusal;
  const auto section = variable->section;
  const auto kind = pou_ == nullptr ? PouKind::program : pou_->declaration->kind;
  const bool of_call = (kind == PouKind::function || kind == PouKind::method) &&
                       variable->declared_in == nullptr && section != VariableSection::global &&
                       section != VariableSection::external;
  if (of_call || section == VariableSection::in_out || section == VariableSection::temporary)
    return "'" + variable->text +
           "' may be gone when the reference is used; REF is for VAR and VAR_OUTPUT "
           "of programs and function blocks, and for global variables";
  return "";
}

std::optional<Value> Lowering::reference_of(const Expression& e) {
  if (e.parts[0]->name != "REF") return std::nullopt;
  if (e.arguments.size() != 1 || e.arguments[0].output) return failed(e.at, "REF has one variable");
  const auto& of = *e.arguments[0].value;
  const auto value = referred(of);
  if (value.is_error()) return value;
  auto refusal = passing(of);
  if (refusal.empty() && (is_in_image(value.place) || value.place.bit >= 0 || value.place.form != 0))
    refusal = register_refusal;
  if (!refusal.empty()) return failed(of.at, refusal);
  const auto* type = unit_.reference_type(*value.type);
  if (value.place.base == Place::Base::absolute) return constant_integer(type, value.place.offset);
  auto result = temporary(type);
  emit_.add(Op::move, result.place.offset, address(value));
  return result;
}

/// ?=: of a reference of the same type, or of an instance of the block that the target refers to; else NULL.
void Lowering::attempt_reference(const Value& target, const Value& value, Position at) {
  const auto& element = *target.type->element;
  if (!is_reference(value.type->kind) || value.type->kind == Kind::pointer) {
    failed(at, "?= takes a reference or a variable of an interface, not " + value.type->name);
    return;
  }
  if (value.type->kind == Kind::null_ || same_type(*value.type, *target.type))
    return store(target, converted(value, *target.type, at));
  auto result = temporary(target.type);
  emit_.constant(result.place.offset, null_reference);
  if (value.type->kind == Kind::interface_ && element.kind == Kind::block) {
    const auto source = cell(value);
    const auto block = emit_.temporary(), wanted = emit_.temporary();
    emit_.add(Op::field_get, block, source, address_bits, address_bits);
    emit_.constant(wanted, unit_.implementer_number(*element.block->pou));
    emit_.add(Op::equal, block, block, wanted);
    const auto next = emit_.add(Op::jump_if_not, 0, block);
    emit_.add(Op::field_get, result.place.offset, source, address_bits, 0);
    emit_.jump_to_here(next);
  }
  store(target, result);
}

}  // namespace trunnion::st
