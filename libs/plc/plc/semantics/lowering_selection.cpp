// SPDX-License-Identifier: Apache-2.0
// SEL, MUX, MAX, MIN and LIMIT (IEC 61131-3:2013, table 32).
#include <algorithm>
#include <optional>
#include <span>

#include "plc/semantics/lowering.hpp"

namespace trunnion::st {

const Type* literal_type(const Type& type, std::span<const Value> values, const Type* expected) {
  const bool whole = type.kind == Kind::integer_literal;
  const auto* wide = elementary(whole ? Kind::lint : Kind::lreal);
  if (expected == nullptr) return wide;
  const auto kind = expected->kind;
  if (is_real(kind)) return elementary(kind);
  if (!whole || (!is_integer(kind) && !is_bits(kind))) return wide;
  const auto* plain = elementary(kind);
  const bool has_all = std::all_of(values.begin(), values.end(),
                                   [&](const Value& v) { return fits(*plain, v.integer, v.large); });
  return has_all ? plain : wide;
}

/// MAX, MIN and LIMIT of literals are literals. Only of numbers.
Value Lowering::extreme_literal(const std::string& name, std::vector<Value> values, Position at) {
  if (name == "LIMIT") {
    const auto raised = extreme_literal("MAX", {values[1], values[0]}, at);
    return extreme_literal("MIN", {raised, values[2]}, at);
  }
  auto result = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!settle(result, values[i], name, at)) return error();
    if (folded_comparison(name == "MAX" ? ">" : "<", values[i], result).integer != 0) result = values[i];
  }
  return result;
}

/// The common type of the values; nullptr when there is none, which is reported.
const Type* Lowering::selected_type(const std::string& name, std::span<const Value> values, Position at) {
  const auto* type = values[0].type;
  for (const auto& value : values) {
    if (value.is_literal() && (!values[0].is_literal() || value.type->kind == Kind::integer_literal))
      continue;
    if (type->kind == Kind::integer_literal || (type->kind == Kind::real_literal && !value.is_literal())) {
      type = value.is_literal() || !is_integer(value.type->kind) ? value.type : elementary(value.type->kind);
      continue;
    }
    const auto* common = value.is_literal() ? type : common_type(*type, *value.type);
    if (common == nullptr && type->kind == Kind::string && value.type->kind == Kind::string &&
        type->wide == value.type->wide)
      common = type->length >= value.type->length ? type : value.type;
    if (common == nullptr) {
      failed(at, name + " needs values of one type, not " + type->name + " and " + value.type->name);
      return nullptr;
    }
    type = common;
  }
  return type;
}

/// The value that the selector counts from 0; the last one for other numbers.
void Lowering::store_chosen(const Value& target, const Value& selector, std::span<const Value> values,
                            Position at) {
  const auto k = selector.is_constant ? cell(selector, *elementary(Kind::lint)) : cell(selector);
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::optional<std::size_t> next;
    if (i + 1 < values.size()) {
      const auto number = emit_.temporary(), other = emit_.temporary();
      emit_.constant(number, i);
      emit_.add(Op::not_equal, other, k, number);
      next = emit_.add(Op::jump_if, 0, other);
    }
    store(target, converted(values[i], *target.type, at));
    if (next) {
      ends.push_back(emit_.add(Op::jump));
      emit_.jump_to_here(*next);
    }
  }
  emit_.jump_to_here(ends);
}

Value Lowering::selection(const std::string& name, const Expression& e, std::vector<Value> values,
                          const Type* expected) {
  Value selector;
  if (name == "SEL" || name == "MUX") {
    selector = values[0];
    values.erase(values.begin());
    if (name == "SEL") selector = converted(selector, *elementary(Kind::boolean), e.at);
    if (selector.is_error()) return selector;
    if (name == "MUX" && !is_integer(selector.type->kind) && selector.type->kind != Kind::integer_literal)
      return failed(e.at, "the first argument of MUX is an integer, not " + selector.type->name);
  }
  const bool orders = name != "SEL" && name != "MUX";
  const bool of_literals =
      std::all_of(values.begin(), values.end(), [](const Value& v) { return v.is_literal(); });
  if (orders && of_literals) return extreme_literal(name, std::move(values), e.at);
  const auto* type = selected_type(name, values, e.at);
  if (type == nullptr) return error();
  if (of_literals) type = literal_type(*type, values, expected);
  const bool ordered =
      (is_elementary(type->kind) && type->kind != Kind::enumeration) || type->kind == Kind::string;
  if (orders && !ordered) return failed(e.at, name + " is for elementary values, not for " + type->name);
  auto result = temporary(type);
  const auto place = result.place;
  result.place.writable = true;
  const auto put = [&](const Value& value) { store(result, converted(value, *type, e.at)); };
  if (!orders) {
    store_chosen(result, selector, values, e.at);
  } else if (name == "LIMIT") {
    // As the standard defines it: MIN(MAX(IN, MN), MX).
    put(values[1]);
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
      const auto limit = converted(values[i], *type, e.at);
      const auto beyond = comparison(i == 0 ? "<" : ">", result, limit, e.at);
      const auto jump = emit_.add(Op::jump_if_not, 0, cell(beyond));
      put(limit);
      emit_.jump_to_here(jump);
    }
  } else {
    put(values[0]);
    for (std::size_t i = 1; i < values.size(); ++i) {
      const auto value = converted(values[i], *type, e.at);
      if (value.is_error()) return value;
      const auto better = comparison(name == "MAX" ? ">" : "<", value, result, e.at);
      const auto jump = emit_.add(Op::jump_if_not, 0, cell(better));
      put(value);
      emit_.jump_to_here(jump);
    }
  }
  result.place = place;
  return result;
}

}  // namespace trunnion::st
