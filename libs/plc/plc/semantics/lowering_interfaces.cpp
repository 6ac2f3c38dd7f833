// SPDX-License-Identifier: Apache-2.0
// Values of interfaces: the address of an instance, and above it the number of its function block.
#include <vector>

#include "plc/semantics/lowering.hpp"

namespace trunnion::st {

Value Lowering::converted_to_interface(const Value& value, const Type& to, Position at) {
  const auto kind = value.type->kind;
  if (kind == Kind::null_) return constant_integer(&to, static_cast<std::int64_t>(null_reference));
  if (kind == Kind::interface_ && Unit::extends(*value.type->interface, *to.interface)) {
    auto result = value;
    result.type = &to;
    return result;
  }
  if (kind != Kind::block || !unit_.implements(*value.type->block->pou->declaration, *to.interface))
    return failed(at, "expected an instance of a block that implements " + to.name + ", found " +
                          (value.is_literal() ? "a number" : value.type->name));
  auto result = temporary(&to);
  const auto number = emit_.temporary();
  emit_.constant(number, unit_.implementer_number(*value.type->block->pou) << address_bits);
  emit_.add(Op::or_, result.place.offset, address(value), number);
  return result;
}

/// A fault when the value is NULL: no memory has its address.
void Lowering::require_instance(std::int32_t value) {
  const auto mask = emit_.temporary(), address = emit_.temporary();
  emit_.constant(mask, null_reference | ((std::uint64_t{1} << address_bits) - 1));
  emit_.add(Op::and_, address, value, mask);
  emit_.add(Op::load_at, address, address);
}

Value Lowering::call_interface(const MethodCall& called, const Expression& e) {
  const auto value = expression(*called.of);
  if (value.is_error()) return value;
  const auto at = e.parts[0]->at;
  const auto* method = unit_.dispatcher(*called.prototype, at);
  if (method == nullptr) return error();
  const auto self = cell(value);
  emit_.place(at);
  require_instance(self);
  return call_with_frame(*method, self, e);
}

/// Within the frame.
void Lowering::copy_cells(std::int32_t to, std::int32_t from, std::size_t count) {
  if (count <= 4) {
    for (std::size_t i = 0; i < count; ++i)
      emit_.add(Op::move, to + static_cast<std::int32_t>(i), from + static_cast<std::int32_t>(i));
    return;
  }
  const auto target = emit_.temporary(), source = emit_.temporary();
  emit_.add(Op::address, target, to);
  emit_.add(Op::address, source, from);
  emit_.add(Op::copy_block, target, source, static_cast<std::int32_t>(count));
}

void Lowering::dispatch(const Pou& method, std::uint64_t number) {
  const auto mark = emit_.mark();
  const auto self = static_cast<std::int32_t>(pou_->self);
  const auto block = emit_.temporary(), wanted = emit_.temporary();
  emit_.place(pou_->declaration->at);
  emit_.add(Op::field_get, block, self, address_bits, address_bits);
  emit_.constant(wanted, number);
  emit_.add(Op::equal, block, block, wanted);
  const auto next = emit_.add(Op::jump_if_not, 0, block);
  const auto start = emit_.temporary(method.frame);
  emit_.add(Op::field_get, start + static_cast<std::int32_t>(method.self), self, address_bits, 0);
  // Both have the same parameters, in the same order but at other cells.
  struct Pair {
    const Variable *own, *of_method;
  };
  std::vector<Pair> pairs;
  auto other = method.variables.begin();
  for (const auto& variable : pou_->variables) {
    if (!is_parameter(variable, *pou_)) continue;
    while (!is_parameter(*other, method)) ++other;
    pairs.push_back({&variable, &*other++});
  }
  for (const auto& pair : pairs)
    if (pair.own->section != VariableSection::output)
      copy_cells(start + pair.of_method->place.offset, pair.own->place.offset, pair.own->initial.size());
  const auto frame = emit_.temporary();
  emit_.add(Op::address, frame, start);
  emit_.add(Op::call_at, static_cast<std::int32_t>(method.routine), frame);
  for (const auto& pair : pairs)
    if (pair.own->section == VariableSection::output)
      copy_cells(pair.own->place.offset, start + pair.of_method->place.offset, pair.own->initial.size());
  if (pou_->result != nullptr)
    copy_cells(pou_->result->place.offset, start + method.result->place.offset, pou_->result->initial.size());
  returns_.push_back(emit_.add(Op::jump));
  emit_.jump_to_here(next);
  emit_.release(mark);
}

/// No block has the number.
void Lowering::end_dispatch() {
  const auto none = emit_.temporary();
  emit_.place(pou_->declaration->at);
  emit_.constant(none, null_reference);
  emit_.add(Op::load_at, none, none);
  body({});
}

/// ?=: the value if its instance implements the interface of the target, otherwise NULL.
void Lowering::attempt(const Value& target, const Value& value, Position at) {
  if (target.type->kind == Kind::reference) return attempt_reference(target, value, at);
  const auto kind = value.type->kind;
  if (target.type->kind != Kind::interface_ || !(kind == Kind::block || is_reference(kind)) ||
      kind == Kind::pointer) {
    failed(at, "?= is for references and variables of an interface");
    return;
  }
  const auto& interface = *target.type->interface;
  if (kind == Kind::null_ ||
      (kind == Kind::block && unit_.implements(*value.type->block->pou->declaration, interface)))
    return store(target, converted(value, *target.type, at));
  auto result = temporary(target.type);
  const auto block = emit_.temporary(), wanted = emit_.temporary();
  emit_.constant(result.place.offset, null_reference);
  if (kind == Kind::interface_) {
    const auto source = cell(value);
    for (const auto* one : unit_.implementers()) {
      if (!unit_.implements(*one->declaration, interface)) continue;
      emit_.add(Op::field_get, block, source, address_bits, address_bits);
      emit_.constant(wanted, unit_.implementer_number(*one));
      emit_.add(Op::equal, block, block, wanted);
      const auto next = emit_.add(Op::jump_if_not, 0, block);
      emit_.add(Op::move, result.place.offset, source);
      emit_.jump_to_here(next);
    }
  }
  store(target, result);
}

}  // namespace trunnion::st
