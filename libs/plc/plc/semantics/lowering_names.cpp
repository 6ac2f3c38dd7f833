// SPDX-License-Identifier: Apache-2.0
// Literals, names and parts of variables.
#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>

#include "plc/semantics/lowering.hpp"
#include "plc/semantics/time_literal.hpp"

namespace trunnion::st {

Value Lowering::literal_integer(const Expression& e) {
  std::uint64_t value = 0;
  const auto* end = e.text.data() + e.text.size();
  const auto parsed = std::from_chars(e.text.data(), end, value, e.base);
  if (parsed.ec != std::errc{} || parsed.ptr != end)
    return failed(e.at, "the number is larger than 64 bits (18446744073709551615)");
  auto result = constant_integer(elementary(Kind::integer_literal), static_cast<std::int64_t>(value));
  result.large = value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return result;
}

Value Lowering::literal_time(const Expression& e) {
  std::string problem;
  const bool is_long = e.name[0] == 'L';
  const auto prefix = is_long ? e.name.substr(1) : e.name;
  const bool is_duration = prefix == "T" || prefix == "TIME";
  const auto value = is_duration                                  ? parse_duration(e.text, problem)
                     : prefix == "D" || prefix == "DATE"          ? parse_date(e.text, problem)
                     : prefix == "TOD" || prefix == "TIME_OF_DAY" ? parse_time_of_day(e.text, problem)
                                                                  : parse_date_and_time(e.text, problem);
  if (!value) return failed(e.at, e.name + "#" + e.text + ": " + problem);
  const auto kind = is_duration                                  ? (is_long ? Kind::ltime : Kind::time)
                    : prefix == "D" || prefix == "DATE"          ? Kind::date
                    : prefix == "TOD" || prefix == "TIME_OF_DAY" ? Kind::tod
                                                                 : Kind::dt;
  return constant_integer(elementary(kind), *value);
}

Value Lowering::typed(const Expression& e) {
  const auto* type = unit_.named_type(e.name);
  if (type == nullptr) return failed(e.at, "there is no type '" + e.text + "'");
  const auto& inner = *e.parts[0];
  if (type->kind == Kind::enumeration) {
    const auto* enumerator = inner.kind == Expression::Kind::name ? type->enumerator(inner.name) : nullptr;
    if (enumerator == nullptr) return failed(inner.at, e.text + " has no value '" + inner.text + "'");
    return constant_integer(type, enumerator->value);
  }
  if (inner.kind == Expression::Kind::name)
    return failed(inner.at, "expected a literal behind '" + e.text + "#'");
  if (type->kind == Kind::error || !(is_elementary(type->kind) || type->kind == Kind::string))
    return failed(e.at, e.text + " has no literals");
  if (type->kind == Kind::string && type->wide && inner.kind == Expression::Kind::string) {
    Expression wide;  // WSTRING#'OK' is WSTRING#"OK"
    wide.kind = inner.kind;
    wide.at = inner.at;
    wide.text = inner.text;
    wide.base = 16;
    return converted(expression(wide), *type, inner.at);
  }
  return converted(expression(inner), *type, inner.at);
}

Value Lowering::variable_value(Variable& variable) {
  variable.used = true;
  Value value;
  value.type = variable.type;
  value.variable = &variable;
  if (variable.type->kind == Kind::error) return error();
  if (variable.constant.is_constant) {
    value = variable.constant;
    value.variable = &variable;
    return value;
  }
  value.place = variable.place;
  if (variable.place.base != Place::Base::frame) return value;
  const bool of_instance = pou_ != nullptr && pou_->is_method() && variable.declared_in != nullptr;
  auto reference = variable.place.offset;
  if (of_instance) value.place.base = Place::Base::indirect, value.place.cell = self().cell;
  if (variable.section != VariableSection::in_out) return value;
  if (of_instance) {
    reference = emit_.temporary(static_cast<std::uint32_t>(variable.initial.size()));
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(variable.initial.size()); ++i)
      emit_.add(Op::load_at, reference + i, self().cell, variable.place.offset + i);
  }
  if (variable.type->open) value.limits = reference + 1;
  value.place = {Place::Base::indirect, 0, reference, -1, 0, 0, true, ""};
  return value;
}

Value Lowering::name(const Expression& e, const Type* expected) {
  if (const auto found = defined_.find(e.name); found != defined_.end()) return found->second;
  const auto noted = [&](Value value) {
    note_read(e, value);
    return value;
  };
  if (auto* own = own_variable(e)) {
    const auto refusal = hidden(*own);
    return refusal.empty() ? noted(variable_value(*own)) : failed(e.at, refusal);
  }
  if (e.scope != NameScope::any) return failed(e.at, scope_problem(e));
  if (e.name == "THIS" && instance() != nullptr) {
    Value value;
    value.type = &instance()->type;
    value.place = self();
    return value;
  }
  if (auto* global = unit_.find_global(e.name)) return noted(variable_value(*global));
  if (expected != nullptr && expected->kind == Kind::enumeration)
    if (const auto* enumerator = expected->enumerator(e.name))
      return constant_integer(expected, enumerator->value);
  const Type* type = nullptr;
  if (const auto* enumerator = unit_.find_enumerator(e.name, &type))
    return constant_integer(type, enumerator->value);
  if (const auto found = unit_.registers().find(e.name); found != unit_.registers().end())
    return noted(unit_.register_value(found->second, nullptr, e.at));
  if (e.name == "NULL")
    return constant_integer(elementary(Kind::null_), static_cast<std::int64_t>(null_reference));
  if (auto* instance = in_test() ? unit_.find_instance(e.name) : nullptr) return variable_value(*instance);
  if (auto* pou = unit_.find_pou(e.name)) {
    if (pou->declaration->kind == PouKind::program && in_test() && !unit_.is_configured(*pou)) {
      if (unit_.translated(e.name, e.at) == nullptr) return error();
      Value value;
      value.type = &pou->type;
      value.place = {Place::Base::absolute, static_cast<std::int32_t>(pou->base), 0, -1, 0, 0, true, ""};
      return value;
    }
    const bool block = pou->declaration->kind == PouKind::function_block;
    return failed(e.at,
                  block ? "'" + e.text + "' is a function block: declare an instance, name : " + e.text + ";"
                        : "'" + e.text + "' is no variable; a function is called with parentheses");
  }
  return failed(e.at, "there is no variable '" + e.text + "'");
}

Value Lowering::member(const Expression& e) {
  const auto& owner = *e.parts[0];
  if (owner.kind == Expression::Kind::name && own_variable(owner) == nullptr)
    if (const auto* type = unit_.find_global(owner.name) == nullptr ? unit_.named_type(owner.name) : nullptr;
        type != nullptr && type->kind == Kind::enumeration)
      if (const auto* enumerator = type->enumerator(e.name)) return constant_integer(type, enumerator->value);
  auto value = expression(owner);
  if (value.is_error()) return value;
  value = located(value);
  value.variable = nullptr;
  if (value.type->kind == Kind::structure) {
    const auto* field = value.type->field(e.name);
    if (field == nullptr) return failed(e.at, value.type->name + " has no field '" + e.text + "'");
    value.type = field->type;
    value.place = moved(value.place, static_cast<std::int32_t>(field->offset));
    return value;
  }
  if (value.type->kind == Kind::block) {
    const auto& pou = *value.type->block->pou;
    const auto found = pou.names.find(e.name);
    const bool is_program = pou.declaration->kind == PouKind::program;
    if (found == pou.names.end()) return failed(e.at, value.type->name + " has no variable '" + e.text + "'");
    const auto& variable = *found->second;
    const bool is_open = variable.section == VariableSection::local && variable.access == Access::public_;
    const bool is_public =
        variable.section == VariableSection::input || variable.section == VariableSection::output || is_open;
    if (!is_public && !(is_program && variable.place.base != Place::Base::none))
      return failed(e.at, "'" + e.text + "' is inside " + value.type->name +
                              "; only its inputs and outputs are accessible");
    if (is_open && variable.is_internal && !is_program)
      if (const auto refusal = internal(e.text, *variable.declared_in->declaration); !refusal.empty())
        return failed(e.at, refusal);
    if (variable.constant.is_constant) return variable.constant;
    value.type = variable.type;
    if (variable.place.base != Place::Base::frame) {
      value.place = variable.place;
      return value;
    }
    value.place = moved(value.place, variable.place.offset);
    value.place.writable =
        variable.section == VariableSection::input || is_program || (is_open && variable.place.writable);
    value.place.refusal =
        is_open ? variable.place.refusal : "output of a function block is set by the block alone";
    return value;
  }
  if (value.type->kind == Kind::interface_)
    return failed(e.at, "the interface '" + value.type->name + "' has no method '" + e.text + "'");
  return failed(
      e.at, value.type->name + " has no members; '." + e.text + "' needs a structure or a function block");
}

// w.%X3, w.%B1, w.%W0, w.%D1 (6.5.2.2 of the standard)
Value Lowering::part(const Expression& e) {
  auto value = expression(*e.parts[0]);
  if (value.is_error()) return value;
  if (value.is_constant) return failed(e.at, "a part of a constant is not accessible");
  const auto kind = value.type->kind;
  const int whole = bits(kind);
  const bool of_bits = is_bits(kind) && whole >= 8;
  const bool of_integer = is_integer(kind) && unit_.is_codesys(e.at);
  if (!of_bits && !of_integer)
    return failed(e.at, "a part is of BYTE, WORD, DWORD or LWORD, not of " + value.type->name);
  // A bit that is written may change the sign.
  if (of_integer && is_signed(kind) && value.place.form == 0) value.place.form = cell_form(kind);
  const char size = e.name.empty() ? '?' : e.name[0];
  const bool plain_number = size >= '0' && size <= '9';
  const int width = size == 'X' || plain_number ? 1
                    : size == 'B'               ? 8
                    : size == 'W'               ? 16
                    : size == 'D'               ? 32
                                                : 0;
  const auto digits = plain_number ? e.name : e.name.substr(1);
  int number = -1;
  std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (width == 0 || digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
    return failed(e.at, "a part is a bit .%X3, a byte .%B1, a word .%W0 or a double word .%D0");
  if (width >= whole || number < 0 || number > whole / width - 1)
    return failed(e.at, "%" + e.name + " is outside " + value.type->name + ", which has the parts 0 .. " +
                            std::to_string(std::max(whole / width - 1, 0)) + " of this size");
  value.variable = nullptr;
  value.type = elementary(width == 1    ? Kind::boolean
                          : width == 8  ? Kind::byte
                          : width == 16 ? Kind::word
                                        : Kind::dword);
  value.place.bit = std::max(value.place.bit, 0) + number * width;
  value.place.width = width;
  return value;
}

}  // namespace trunnion::st
