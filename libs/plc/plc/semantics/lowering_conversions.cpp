// SPDX-License-Identifier: Apache-2.0
// X_TO_Y, TO_Y, TRUNC, BCD (IEC 61131-3:2013, tables 22 to 27).
#include <cmath>
#include <optional>

#include "plc/library/functions.hpp"
#include "plc/machine/arithmetic.hpp"
#include "plc/semantics/lowering.hpp"
#include "plc/semantics/time_literal.hpp"

namespace trunnion::st {
namespace {

bool whole(Kind kind) { return is_integer(kind) || is_bits(kind) || kind == Kind::enumeration; }
bool timed(Kind kind) { return is_duration(kind) || is_date(kind); }

}  // namespace

std::optional<Value> Lowering::conversion(const Expression& e, const std::string& name) {
  const auto parts =
      conversion_name(name, [&](const std::string& type) { return unit_.named_type(type) != nullptr; });
  if (!parts) return std::nullopt;
  const auto* from = parts->from.empty() ? nullptr : unit_.named_type(parts->from);
  const auto* to = unit_.named_type(parts->to);
  if (e.arguments.size() != 1)
    return failed(e.at, e.parts[0]->text + " has 1 argument, not " + std::to_string(e.arguments.size()));
  auto value = expression(*e.arguments[0].value, from);
  if (value.is_error()) return value;
  if (from != nullptr) {
    value = from->kind == Kind::string && value.type->kind == Kind::string && from->wide == value.type->wide
                ? value
                : converted(value, *from, e.arguments[0].at);
    if (value.is_error()) return value;
  } else if (value.type->kind == Kind::integer_literal) {
    const bool digits = parts->kind == ConversionKind::from_bcd,
               number = parts->kind == ConversionKind::to_bcd;
    value = converted(value, *elementary(digits ? Kind::lword : number ? Kind::ulint : Kind::lint), e.at);
  } else if (value.type->kind == Kind::real_literal) {
    value = converted(value, *elementary(Kind::lreal), e.at);
  }
  if (parts->kind == ConversionKind::from_bcd || parts->kind == ConversionKind::to_bcd)
    return converted_digits(value, *to, parts->kind == ConversionKind::from_bcd, e.at);
  return converted_to(value, *to, parts->kind == ConversionKind::truncation, e.at);
}

/// Between unsigned integers and bit strings of decimal digits; digits that do not fit are cut off.
Value Lowering::converted_digits(const Value& value, const Type& to, bool from_digits, Position at) {
  const auto holds_digits = [](Kind kind) { return is_bits(kind) && kind != Kind::boolean; };
  const auto holds_number = [](Kind kind) { return is_integer(kind) && !is_signed(kind); };
  const auto from = value.type->kind;
  if (from_digits ? !holds_digits(from) || !holds_number(to.kind)
                  : !holds_number(from) || !holds_digits(to.kind))
    return failed(at, "decimal digits are converted between BYTE .. LWORD and USINT .. ULINT, not from " +
                          value.type->name + " to " + to.name);
  const auto source = cell(value);
  auto result = temporary(elementary(to.kind));
  const auto target = result.place.offset;
  emit_.add(from_digits ? Op::from_bcd : Op::to_bcd, target, source);
  if (bits(to.kind) < 64) emit_.add(Op::narrow, target, target, 0, cell_form(to.kind));
  return result;
}

Value Lowering::converted_to(const Value& value, const Type& to, bool truncate, Position at) {
  const auto from = value.type->kind;
  const auto undefined = [&] {
    return failed(at, "there is no conversion from " + value.type->name + " to " + to.name);
  };
  if (truncate && !is_real(from))
    return failed(at, "TRUNC is for REAL and LREAL, not for " + value.type->name);
  if (truncate && !is_integer(to.kind)) return failed(at, "TRUNC gives an integer, not " + to.name);
  const auto is_string_of_bits = [](Kind kind) { return is_bits(kind) && kind != Kind::boolean; };
  const bool codesys = unit_.is_codesys(at);
  const bool transfers = !codesys && ((is_real(from) && is_string_of_bits(to.kind)) ||
                                      (is_string_of_bits(from) && is_real(to.kind)));
  if (transfers && bits(from) != bits(to.kind))
    return failed(at, "there is no conversion from " + value.type->name + " to " + to.name +
                          "; REAL and DWORD, LREAL and LWORD exchange their bits, integers their value");
  if (from == Kind::integer_literal) return converted(value, to, at);
  if (from == Kind::string) {
    const bool number = is_integer(to.kind) || (is_bits(to.kind) && to.kind != Kind::boolean);
    if (to.kind == Kind::string) {
      if (to.wide == value.type->wide) return value;
      // WSTRING is kept in UTF-8, of which a character has up to three bytes.
      const std::int32_t argument[] = {address(value)};
      return string_result(to.wide ? StringFunction::to_wide : StringFunction::copy, argument,
                           to.wide ? value.type->length : 3 * value.type->length, to.wide);
    }
    if (!number && !is_real(to.kind) && to.kind != Kind::boolean) return undefined();
    const auto first = emit_.temporary();
    emit_.add(Op::move, first, address(value));
    auto result = temporary(elementary(to.kind));
    const auto function = to.kind == Kind::real      ? StringFunction::to_real
                          : to.kind == Kind::lreal   ? StringFunction::to_lreal
                          : to.kind == Kind::boolean ? StringFunction::to_bool
                                                     : StringFunction::to_int;
    emit_.add(Op::string_query, result.place.offset, first, 0, static_cast<std::uint16_t>(function));
    if (number) emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(to.kind));
    return result;
  }
  if (!is_elementary(from)) return undefined();
  if (to.kind == Kind::string) {
    if (is_date(from)) return undefined();
    const auto function = from == Kind::boolean ? StringFunction::from_bool
                          : from == Kind::real  ? StringFunction::from_real
                          : from == Kind::lreal ? StringFunction::from_lreal
                          : is_duration(from)   ? StringFunction::from_time
                          : is_signed(from)     ? StringFunction::from_int
                                                : StringFunction::from_uint;
    const std::int32_t argument[] = {cell(value)};
    return string_result(function, argument, 40, to.wide);
  }
  if (!is_elementary(to.kind)) return undefined();
  const auto* type = to.kind == Kind::enumeration || to.ranged ? &to : elementary(to.kind);
  if (value.is_constant && whole(from) && is_integer(to.kind) &&
      !fits(to, value.integer, from == Kind::ulint && value.integer < 0))
    unit_.diagnostics().warning(at, std::to_string(value.integer) + " is outside " + limits_text(to) +
                                        " of " + to.name + "; the result is another number");
  const auto source = cell(value);
  auto result = temporary(type);
  const auto target = result.place.offset;
  const auto scale = [&](Kind duration) {
    if (codesys && (duration == Kind::date || duration == Kind::dt)) return 1000 * millisecond;
    if (codesys && duration == Kind::tod) return millisecond;
    return duration == Kind::ltime || is_date(duration) ? std::int64_t{1} : millisecond;
  };
  if (to.kind == Kind::boolean) {
    // Any value but zero is TRUE.
    const auto zero = emit_.temporary();
    emit_.constant(zero, 0);
    emit_.add(from == Kind::real    ? Op::equal_f
              : from == Kind::lreal ? Op::equal_d
                                    : Op::equal,
              target, source, zero);
    emit_.add(Op::not_, target, target);
  } else if (transfers) {
    emit_.add(Op::move, target, source);
  } else if (whole(from) && whole(to.kind)) {
    emit_.add(Op::narrow, target, source, 0, cell_form(to.kind));
  } else if (is_real(from) && (whole(to.kind) || is_duration(to.kind))) {
    auto wide = source;
    if (from == Kind::real) {
      wide = emit_.temporary();
      emit_.add(Op::f_to_d, wide, source);
    }
    const auto form = whole(to.kind) ? cell_form(to.kind) : cell_form(Kind::lint);
    if (is_duration(to.kind)) {
      const auto factor = emit_.temporary(), product = emit_.temporary();
      emit_.constant(factor, cell_of(static_cast<double>(scale(to.kind))));
      emit_.add(Op::multiply_d, product, wide, factor);
      wide = product;
    }
    emit_.add(truncate ? Op::d_truncate : Op::d_round, target, wide, 0, form);
  } else if (whole(from) && is_real(to.kind)) {
    const bool is_unsigned = !is_signed(from);
    emit_.add(to.kind == Kind::real ? (is_unsigned ? Op::uint_to_f : Op::int_to_f)
                                    : (is_unsigned ? Op::uint_to_d : Op::int_to_d),
              target, source);
  } else if (is_real(from) && is_real(to.kind)) {
    emit_.add(from == to.kind ? Op::move : from == Kind::real ? Op::f_to_d : Op::d_to_f, target, source);
  } else if (timed(from) && (is_real(to.kind) || whole(to.kind))) {
    const auto divisor = emit_.temporary();
    if (is_real(to.kind)) {
      emit_.constant(divisor, cell_of(static_cast<double>(scale(from))));
      emit_.add(Op::int_to_d, target, source);
      emit_.add(Op::divide_d, target, target, divisor);
      if (to.kind == Kind::real) emit_.add(Op::d_to_f, target, target);
    } else {
      emit_.constant(divisor, static_cast<std::uint64_t>(scale(from)));
      emit_.add(Op::divide, target, source, divisor);
      emit_.add(Op::narrow, target, target, 0, cell_form(to.kind));
    }
  } else if (whole(from) && (is_duration(to.kind) || (codesys && is_date(to.kind)))) {
    const auto factor = emit_.temporary();
    emit_.constant(factor, static_cast<std::uint64_t>(scale(to.kind)));
    emit_.add(Op::multiply, target, source, factor);
  } else if ((is_duration(from) && is_duration(to.kind)) || (from == Kind::date && to.kind == Kind::dt) ||
             (codesys && (is_duration(from) || from == Kind::tod) &&
              (is_duration(to.kind) || to.kind == Kind::tod))) {
    emit_.add(Op::move, target, source);
  } else if (from == Kind::dt && (to.kind == Kind::date || to.kind == Kind::tod)) {
    const auto day = emit_.temporary(), rest = emit_.temporary();
    emit_.constant(day, 86400000000000u);
    emit_.add(Op::modulo, rest, source, day);
    emit_.add(to.kind == Kind::tod ? Op::move : Op::subtract, target, to.kind == Kind::tod ? rest : source,
              rest);
  } else if (from == to.kind) {
    emit_.add(Op::move, target, source);
  } else {
    return undefined();
  }
  if (type->ranged) emit_.add(Op::check_range, target, unit_.range_entry({type->low, type->high, 1}));
  return result;
}

}  // namespace trunnion::st
