// SPDX-License-Identifier: Apache-2.0
// The rules of CoDeSys 2.3 for operands of different types, in its exports only: bit strings count as
// unsigned numbers, integers as bit strings, times as milliseconds, and a target takes what fits into it.
#include <utility>

#include "plc/machine/arithmetic.hpp"
#include "plc/semantics/lowering.hpp"
#include "plc/semantics/time_literal.hpp"

namespace trunnion::st {

/// Outside of exports, and of what is no integer and no bit string, the value. Up to 16 bits are computed
/// in 32.
Value Lowering::as_number(const Value& value, Position at) {
  const auto kind = value.type->kind;
  const bool counts = is_integer(kind) || (is_bits(kind) && kind != Kind::boolean);
  if (!unit_.is_codesys(at) || !counts) return value;
  auto result = value;
  result.type = elementary(bits(kind) <= 16      ? Kind::dint
                           : kind == Kind::dword ? Kind::udint
                           : kind == Kind::lword ? Kind::ulint
                                                 : kind);
  if (value.is_constant || bits(kind) > 16) return result;
  auto wide = temporary(result.type);
  emit_.add(Op::move, wide.place.offset, cell(value));
  return wide;
}

Value Lowering::as_bits(const Value& value, Position at) {
  const auto kind = value.type->kind;
  if (!unit_.is_codesys(at) || !is_integer(kind)) return value;
  const auto* type = elementary(bits(kind) == 8    ? Kind::byte
                                : bits(kind) == 16 ? Kind::word
                                : bits(kind) == 32 ? Kind::dword
                                                   : Kind::lword);
  return converted_to(value, *type, false, at);
}

/// Operands of arithmetic and comparisons: a number beside a time is one of milliseconds.
void Lowering::mix(const std::string& op, Value& left, Value& right, Position at) {
  if (!unit_.is_codesys(at)) return;
  left = as_number(left, at);
  right = as_number(right, at);
  const auto timed = [](const Value& v) { return is_duration(v.type->kind) || v.type->kind == Kind::tod; };
  if (timed(left) == timed(right)) return;
  auto& number = timed(left) ? right : left;
  const auto& time = timed(left) ? left : right;
  if (op == "*" && timed(right)) return std::swap(left, right);
  const bool beside = op != "*" && op != "/" && op != "MOD";
  const auto kind = number.type->kind;
  if (!beside || !(is_integer(kind) || kind == Kind::integer_literal)) return;
  if (const auto same = converted_freely(number, *elementary(Kind::time), at))
    number = *same, number.type = is_duration(time.type->kind) ? time.type : number.type;
}

std::optional<Value> Lowering::converted_freely(const Value& value, const Type& to, Position at) {
  const auto from = value.type->kind;
  if (!unit_.is_codesys(at) || to.kind >= Kind::string) return std::nullopt;
  const bool bits_of_to = is_integer(to.kind) || (is_bits(to.kind) && to.kind != Kind::boolean);
  if (from == Kind::integer_literal) {
    std::int64_t time = 0;
    if (is_duration(to.kind))
      return __builtin_mul_overflow(value.integer, millisecond, &time)
                 ? failed(at, "the time is longer than 292 years")
                 : constant_integer(&to, time);
    if (!bits_of_to) return std::nullopt;
    return constant_integer(&to, static_cast<std::int64_t>(narrowed(static_cast<std::uint64_t>(value.integer),
                                                                    cell_form(to.kind))));
  }
  if (from == Kind::pointer && bits_of_to) return converted_to(number_of_pointer(value), to, false, at);
  if (from >= Kind::string || (to.kind == Kind::boolean) != (from == Kind::boolean)) return std::nullopt;
  return converted_to(value, to, false, at);
}

}  // namespace trunnion::st
