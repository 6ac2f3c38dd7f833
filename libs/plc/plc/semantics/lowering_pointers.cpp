// SPDX-License-Identifier: Apache-2.0
// POINTER TO, ADR, SIZEOF: see machine/pointer.hpp. Whoever takes a pointer says which variable it is for, so
// the machine checks every use against that variable and its type.
#include <string>

#include "plc/machine/pointer.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

static_assert(null_pointer == null_reference);

bool counts_bytes(Kind kind) {
  return is_integer(kind) || kind == Kind::integer_literal || (is_bits(kind) && kind != Kind::boolean);
}

/// Of a function block while its variables are not all known.
bool is_incomplete(const Type& type) {
  const auto& element = innermost(type);
  return element.kind == Kind::block && element.block != nullptr &&
         element.block->pou->state == Pou::State::in_progress;
}

}  // namespace

Value Lowering::refused_incomplete(const Type& type, Position at) {
  return failed(at, "the size of '" + innermost(type).name +
                        "' is not known inside of it, so it has no pointers and no SIZEOF there");
}

/// ADR(variable), SIZEOF(variable or type); nothing for other calls.
std::optional<Value> Lowering::pointer_function(const Expression& e) {
  const auto& name = e.parts[0]->name;
  if (name != "ADR" && name != "SIZEOF") return std::nullopt;
  if (e.arguments.size() != 1 || e.arguments[0].output) return failed(e.at, name + " has one variable");
  const auto& of = *e.arguments[0].value;
  return name == "ADR" ? pointer_to(of) : size_of(of);
}

Value Lowering::size_of(const Expression& of) {
  const Type* type = nullptr;
  if (auto* variable = own_variable(root_of(of)); variable != nullptr)
    variable->used = true;
  else if (of.kind == Expression::Kind::name && unit_.find_global(of.name) == nullptr)
    type = unit_.named_type(of.name);
  if (type == nullptr) type = instance_type(of);
  if (type == nullptr) type = expression(of).type;
  const auto kind = type->kind;
  if (kind == Kind::error) return error();
  if (type->open || kind == Kind::none || kind == Kind::null_ || kind == Kind::integer_literal ||
      kind == Kind::real_literal)
    return failed(of.at, "SIZEOF is for variables and types of one size, not for " + type->name);
  if (is_incomplete(*type)) return refused_incomplete(*type, of.at);
  return constant_integer(elementary(Kind::integer_literal), static_cast<std::int64_t>(bytes_of(*type)));
}

/// Why a pointer must not name the variable, or nothing.
std::string Lowering::pointing(const Expression& of, const Value& value) {
  const auto& place = value.place;
  if (is_in_image(place) || place.bit >= 0 || place.form != 0)
    return "registers and parts of variables have no address; copy it to a variable";
  if (value.type->open) return "ARRAY[*] has no pointer; write ADR of its first element";
  const auto& root = root_of(of);
  auto* variable = root.kind == Expression::Kind::name ? own_variable(root) : nullptr;
  if (variable == nullptr) return "";
  if (is_of_method(*variable))
    return "'" + variable->text +
           "' may be gone when the pointer is used; in a method ADR is for variables " +
           "of the block and for global variables";
  if (variable->section == VariableSection::in_out) variable->pointed = true;
  return "";
}

/// The variables of a method are among the intermediate results of its caller.
bool Lowering::is_of_method(const Variable& variable) const {
  return pou_->is_method() && variable.declared_in == nullptr &&
         variable.section != VariableSection::external;
}

/// A pointer to an element moves through its array.
Value Lowering::pointer_to(const Expression& of) {
  const auto* array = of.kind == Expression::Kind::index ? instance_type(*of.parts[0]) : nullptr;
  if (array != nullptr && array->kind == Kind::array && !array->open) {
    const auto first = pointer_to(*of.parts[0]);
    if (first.is_error()) return first;
    const auto found = element(of, pointed_by(first, of.at));
    return found.is_error() ? found : pointer_of(found);
  }
  const auto value = referred(of);
  if (value.is_error()) return value;
  if (const auto refusal = pointing(of, value); !refusal.empty()) return failed(of.at, refusal);
  if (is_incomplete(*value.type)) return refused_incomplete(*value.type, of.at);
  return pointer_of(value);
}

Value Lowering::pointer_of(const Value& value) {
  const auto* type = unit_.reference_type(*value.type, Kind::pointer);
  auto result = temporary(type);
  if (value.place.base == Place::Base::pointer) {
    emit_.add(Op::move, result.place.offset, moved_pointer(value.place));
    return result;
  }
  const auto entry = unit_.pointed(*value.type);
  if (value.place.base == Place::Base::absolute) {
    const auto address = static_cast<std::uint32_t>(value.place.offset);
    return constant_integer(
        type, static_cast<std::int64_t>(pointer_cell(address, static_cast<std::uint32_t>(entry))));
  }
  emit_.add(Op::point, result.place.offset, address(value), entry);
  return result;
}

/// What p^ is.
Value Lowering::pointed_by(const Value& pointer, Position at) {
  const auto& element = *pointer.type->element;
  if (is_incomplete(element)) return refused_incomplete(element, at);
  Value result;
  result.type = &element;
  result.place = {Place::Base::pointer, 0, cell(pointer), -1, 0, 0, true, "", &element};
  return result;
}

std::int32_t Lowering::moved_pointer(const Place& place) {
  if (place.offset == 0) return place.cell;
  const auto result = emit_.temporary(), by = emit_.temporary();
  emit_.constant(by, static_cast<std::uint64_t>(std::int64_t{place.offset}));
  emit_.add(Op::point_move, result, place.cell, by);
  return result;
}

/// What is used as a whole has the address of its cells: it must be of the type of the pointer.
Value Lowering::located(Value value) {
  if (value.place.base != Place::Base::pointer) return value;
  const auto pointer = moved_pointer(value.place), result = emit_.temporary();
  emit_.add(Op::point_cells, result, pointer, unit_.pointed(*value.place.pointed));
  value.place = {Place::Base::indirect, 0, result, -1, 0, 0, value.place.writable, value.place.refusal};
  return value;
}

Value Lowering::converted_to_pointer(const Value& value, const Type& to, Position at) {
  const auto kind = value.type->kind;
  if (kind == Kind::null_ || (kind == Kind::integer_literal && value.integer == 0))
    return constant_integer(&to, static_cast<std::int64_t>(null_pointer));
  const auto expected =
      "expected " + to.name + ", found " + (value.is_literal() ? "a number" : value.type->name);
  if (kind != Kind::pointer) return failed(at, expected + "; a pointer is ADR of a variable");
  if (!same_type(*value.type, to)) {
    const bool known = value.type->element != nullptr && to.element != nullptr;
    const auto& from = known ? innermost(*value.type->element) : *value.type;
    const auto& wanted = known ? innermost(*to.element) : to;
    const bool bytes = has_bytes(from) && has_bytes(wanted) && wanted.kind != Kind::string;
    if (!bytes && !(known && same_limited_type(from, wanted)))
      return failed(at, expected +
                            "; of other types pointers to numbers and bit strings reach the bytes of "
                            "numbers, bit strings and STRING");
  }
  auto result = value;
  result.type = &to;
  result.variable = nullptr;
  return result;
}

/// As a number pointers are compared, and an export keeps them in a DWORD.
Value Lowering::number_of_pointer(const Value& pointer) {
  const auto* type = elementary(Kind::udint);
  if (pointer.is_constant)
    return constant_integer(
        type, static_cast<std::int64_t>(pointer_number(static_cast<std::uint64_t>(pointer.integer))));
  const auto source = cell(pointer);
  auto result = temporary(type);
  emit_.add(Op::point_number, result.place.offset, source);
  return result;
}

/// p + bytes, p - bytes; p - q is a number of bytes.
Value Lowering::pointer_arithmetic(const std::string& op, const Value& left, const Value& right,
                                   Position at) {
  const bool first = left.type->kind == Kind::pointer;
  const auto& pointer = first ? left : right;
  const auto& number = first ? right : left;
  if (first && op == "-" && right.type->kind == Kind::pointer) {
    const auto a = cell(number_of_pointer(left)), b = cell(number_of_pointer(right));
    auto result = temporary(elementary(Kind::dint));
    emit_.add(Op::subtract, result.place.offset, a, b);
    emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(Kind::dint));
    return result;
  }
  if (!counts_bytes(number.type->kind) || !(op == "+" || (op == "-" && first)))
    return failed(at, "'" + op + "' between " + left.type->name + " and " + right.type->name +
                          " is not defined; a pointer moves by a whole number of bytes");
  const auto from = cell(pointer);
  auto by = cell(number);
  if (op == "-") {
    const auto negative = emit_.temporary();
    emit_.add(Op::negate, negative, by);
    by = negative;
  }
  auto result = temporary(pointer.type);
  emit_.add(Op::point_move, result.place.offset, from, by);
  return result;
}

/// Pointers among the operands of a comparison become numbers; false: the error is reported.
bool Lowering::number_pointers(const std::string& op, Value& left, Value& right, Position at) {
  const bool first = left.type->kind == Kind::pointer, second = right.type->kind == Kind::pointer;
  if (!first && !second) return true;
  const auto is_null = [](const Value& v) {
    return v.type->kind == Kind::null_ || (v.type->kind == Kind::integer_literal && v.integer == 0);
  };
  auto& other = first ? right : left;
  const bool compares =
      (first && second) || is_null(other) || (unit_.is_codesys(at) && counts_bytes(other.type->kind));
  if (!compares) {
    failed(at, "'" + op + "' between " + left.type->name + " and " + right.type->name +
                   " is not defined; pointers are compared with pointers and NULL");
    return false;
  }
  if (is_null(other)) other = constant_integer(elementary(Kind::udint), 0);
  for (auto* side : {&left, &right})
    if (side->type->kind == Kind::pointer) *side = number_of_pointer(*side);
  return true;
}

/// A pointer to VAR_IN_OUT may be used later than the call, so the variable must be there then.
bool Lowering::check_pointed(const Expression& argument, const Variable& parameter) {
  const auto& root = root_of(argument);
  auto* variable = root.kind == Expression::Kind::name ? own_variable(root) : nullptr;
  if (!parameter.pointed || variable == nullptr) return true;
  if (is_of_method(*variable)) {
    failed(argument.at, "'" + variable->text + "' is gone after the method, but VAR_IN_OUT '" +
                            parameter.text + "' has pointers; copy it to a variable of the block and back");
    return false;
  }
  if (variable->section == VariableSection::in_out) variable->pointed = true;
  return true;
}

}  // namespace trunnion::st
