// SPDX-License-Identifier: Apache-2.0
// Reading and writing of places, and conversions without a call.
#include <charconv>
#include <cmath>
#include <limits>
#include <span>

#include "plc/machine/arithmetic.hpp"
#include "plc/machine/strings.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {

Value constant_integer(const Type* type, std::int64_t value) {
  Value result;
  result.type = type;
  result.is_constant = true;
  result.integer = value;
  return result;
}

Value constant_real(const Type* type, double value) {
  Value result;
  result.type = type;
  result.is_constant = true;
  result.real = value;
  return result;
}

std::uint64_t constant_cell(const Value& value, const Type& to) {
  const bool from_real = is_real(value.type->kind) || value.type->kind == Kind::real_literal;
  if (to.kind == Kind::real) {
    if (from_real && !value.text.empty()) {
      float exact = 0;  // rounded once
      const auto parsed = std::from_chars(value.text.data(), value.text.data() + value.text.size(), exact);
      return cell_of(parsed.ec == std::errc{} ? exact : static_cast<float>(value.real));
    }
    return cell_of(from_real ? static_cast<float>(value.real) : static_cast<float>(value.integer));
  }
  if (to.kind == Kind::lreal) {
    if (from_real) return cell_of(value.real);
    return cell_of(value.large ? static_cast<double>(static_cast<std::uint64_t>(value.integer))
                               : static_cast<double>(value.integer));
  }
  return static_cast<std::uint64_t>(value.integer);
}

Value Lowering::failed(Position at, const std::string& text) {
  unit_.diagnostics().error(at, text);
  return error();
}

Value Lowering::temporary(const Type* type) {
  Value value;
  value.type = type;
  value.place = {Place::Base::frame,         emit_.temporary(type->cells), 0, -1, 0, 0, false,
                 "is an intermediate result"};
  return value;
}

/// A copy of what another part of the expression may change.
Value Lowering::kept(Value value) {
  if (value.is_constant || !is_one_cell(value.type->kind)) return value;
  if (value.place.base == Place::Base::frame && emit_.is_temporary(value.place.offset) && value.place.bit < 0)
    return value;
  auto copy = temporary(value.type);
  emit_.add(Op::move, copy.place.offset, cell(value));
  return copy;
}

/// A copy in cells of its own; a literal becomes one of the type that takes it.
Value Lowering::own_copy(const Value& value, const Type* expected, Position at) {
  const auto* type = value.is_literal()
                         ? literal_type(*value.type, std::span<const Value>(&value, 1), expected)
                         : value.type;
  auto result = temporary(type);
  result.place.writable = true;
  store(result, converted(value, *type, at));
  result.place.writable = false;
  return result;
}

/// Behind the instructions that store the value: where the jump leads, it is the initial one of its type.
void Lowering::initial_at(std::size_t jump, const Value& value) {
  const auto end = emit_.add(Op::jump);
  emit_.jump_to_here(jump);
  fill(value.place.offset, value.type->initial);
  emit_.jump_to_here(end);
}

/// Cells of the frame, with few instructions.
void Lowering::fill(std::int32_t first, const std::vector<std::uint64_t>& cells) {
  if (cells.size() <= 4) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      emit_.constant(first + static_cast<std::int32_t>(i), cells[i]);
    return;
  }
  const auto from = emit_.temporary(), to = emit_.temporary();
  emit_.constant(from, unit_.allocate(cells));
  emit_.add(Op::address, to, first);
  emit_.add(Op::copy_block, to, from, static_cast<std::int32_t>(cells.size()));
}

Place Lowering::moved(Place place, std::int32_t cells) const {
  place.offset += cells;
  return place;
}

std::int32_t Lowering::address(const Place& place) {
  const auto result = emit_.temporary();
  switch (place.base) {
    case Place::Base::frame:
      emit_.add(Op::address, result, place.offset);
      break;
    case Place::Base::absolute:
      emit_.constant(result, static_cast<std::uint32_t>(place.offset));
      break;
    case Place::Base::indirect: {
      if (place.offset == 0) return place.cell;
      const auto offset = emit_.temporary();
      emit_.constant(offset, static_cast<std::uint32_t>(place.offset));
      emit_.add(Op::add, result, place.cell, offset);
      break;
    }
    case Place::Base::none:
    case Place::Base::pointer:  // located() gives it an address
      emit_.constant(result, 0);
      break;
  }
  return result;
}

std::int32_t Lowering::address(const Value& value) {
  if (!value.is_constant) return address(located(value).place);
  const auto result = emit_.temporary();
  emit_.constant(result, unit_.string_constant(value.text));
  return result;
}

/// The cell that holds the value of the place.
std::int32_t Lowering::load(const Place& place, const Type& type) {
  if (place.base == Place::Base::frame && place.bit < 0 && place.form == 0) return place.offset;
  const auto result = emit_.temporary();
  auto raw = place.offset;
  if (place.base != Place::Base::frame) {
    raw = result;
    if (place.base == Place::Base::pointer)
      emit_.add(Op::point_load, result, moved_pointer(place), unit_.pointed(*place.pointed));
    else if (place.base == Place::Base::absolute)
      emit_.add(Op::load, result, place.offset);
    else
      emit_.add(Op::load_at, result, place.cell, place.offset);
  }
  if (place.bit >= 0) {
    if (place.width == 1)
      emit_.add(Op::bit_get, result, raw, 0, static_cast<std::uint16_t>(place.bit));
    else
      emit_.add(Op::field_get, result, raw, place.width, static_cast<std::uint16_t>(place.bit));
  } else if (place.form != 0) {
    emit_.add(Op::narrow, result, raw, 0, cell_form(type.kind));
  }
  return result;
}

/// The cell with the value as the elementary type `type`, to which it converts implicitly.
std::int32_t Lowering::cell(const Value& value, const Type& type) {
  if (value.is_error()) return 0;
  if (value.is_constant) {
    const auto result = emit_.temporary();
    emit_.constant(result, constant_cell(value, type));
    return result;
  }
  const auto from = value.type->kind, to = type.kind;
  const auto source = load(value.place, *value.type);
  if (from == to || (!is_real(from) && !is_real(to))) return source;
  const auto result = emit_.temporary();
  const bool is_unsigned = !is_signed(from);
  if (from == Kind::real)
    emit_.add(Op::f_to_d, result, source);
  else if (to == Kind::real)
    emit_.add(is_unsigned ? Op::uint_to_f : Op::int_to_f, result, source);
  else
    emit_.add(is_unsigned ? Op::uint_to_d : Op::int_to_d, result, source);
  return result;
}

void Lowering::store_cell(const Place& place, const Type& type, std::int32_t source) {
  if (place.bit >= 0) {
    auto whole = place;
    whole.bit = -1;
    whole.form = 0;
    const auto cell = load(whole, type);
    if (place.width == 1)
      emit_.add(Op::bit_put, cell, source, 0, static_cast<std::uint16_t>(place.bit));
    else
      emit_.add(Op::field_put, cell, source, place.width, static_cast<std::uint16_t>(place.bit));
    if (place.form != 0 && (place.form & signed_flag) != 0) emit_.add(Op::narrow, cell, cell, 0, place.form);
    if (place.base != Place::Base::frame) store_cell(whole, type, cell);
    return;
  }
  if (place.form != 0) {
    const auto narrow = emit_.temporary();
    emit_.add(Op::narrow, narrow, source, 0, place.form);
    source = narrow;
  }
  switch (place.base) {
    case Place::Base::frame:
      if (source != place.offset) emit_.add(Op::move, place.offset, source);
      break;
    case Place::Base::absolute:
      emit_.add(Op::save, source, place.offset);
      break;
    case Place::Base::indirect:
      emit_.add(Op::save_at, source, place.cell, place.offset);
      break;
    case Place::Base::pointer:
      emit_.add(Op::point_save, source, moved_pointer(place), unit_.pointed(*place.pointed));
      break;
    case Place::Base::none:
      break;
  }
}

void Lowering::check_range(const Type& type, const Value& value, std::int32_t cell) {
  if (!type.ranged || value.is_constant) return;
  if (value.type->ranged && value.type->low >= type.low && value.type->high <= type.high) return;
  emit_.add(Op::check_range, cell, unit_.range_entry({type.low, type.high, 1}));
}

/// Writes a value that was converted to the type of the target.
void Lowering::store(const Value& target, const Value& value) {
  if (target.is_error() || value.is_error()) return;
  mark_written(target);
  const auto& type = *target.type;
  if (!is_one_cell(type.kind)) return copy(target, value);
  const auto source = cell(value, type);
  check_range(type, value, source);
  const auto& place = target.place;
  const bool simple = place.base == Place::Base::frame && place.bit < 0 && place.form == 0;
  if (simple && !type.ranged && emit_.redirect(source, place.offset)) return;
  store_cell(place, type, source);
}

void Lowering::copy(const Value& target, const Value& value) {
  const auto to = address(target);
  const auto from = address(value);
  if (target.type->kind == Kind::string && (value.is_constant || value.type->length != target.type->length))
    emit_.add(Op::string_make, to, from, static_cast<std::int32_t>(target.type->length),
              string_code(StringFunction::copy, target.type->wide));
  else
    emit_.add(Op::copy_block, to, from, static_cast<std::int32_t>(target.type->cells));
}

void Lowering::mark_written(const Value& target) {
  if (target.place.base == Place::Base::absolute)
    unit_.use_register(static_cast<std::uint32_t>(target.place.offset), target.type->cells, true);
}

bool Lowering::check_writable(const Value& target, Position at) {
  if (target.is_error()) return false;
  if (target.is_constant || target.place.base == Place::Base::none) {
    unit_.diagnostics().error(at, target.variable != nullptr
                                      ? "'" + target.variable->text + "' is a constant and cannot be written"
                                      : "a value cannot be written here: a variable is required");
    return false;
  }
  if (!target.place.writable) {
    const auto name = target.variable != nullptr ? "'" + target.variable->text + "' " : std::string("this ");
    unit_.diagnostics().error(at, name + target.place.refusal + " and cannot be written");
    return false;
  }
  return true;
}

Value Lowering::converted(Value value, const Type& to, Position at) {
  if (value.is_error() || to.kind == Kind::error) return error();
  const auto from = value.type->kind;
  if (from == Kind::none) return failed(at, "the function has no result");
  if (value.type->open || to.open)
    return failed(at, "ARRAY[*] is used by its elements, or passed on as VAR_IN_OUT");
  if (from == Kind::null_ && to.kind == Kind::reference)
    return constant_integer(&to, static_cast<std::int64_t>(null_reference));
  if (to.kind == Kind::interface_) return converted_to_interface(value, to, at);
  if (to.kind == Kind::pointer) return converted_to_pointer(value, to, at);
  if (from == Kind::integer_literal) {
    const bool number = is_integer(to.kind) || (is_bits(to.kind)) || to.kind == Kind::integer_literal;
    if (number) {
      if (to.kind == Kind::boolean && (value.integer < 0 || value.integer > 1))
        return failed(at, "BOOL is TRUE or FALSE, not " + std::to_string(value.integer));
      if (to.kind != Kind::integer_literal && !fits(to, value.integer, value.large)) {
        if (const auto free = converted_freely(value, to, at)) return *free;
        const auto shown = value.large ? std::to_string(static_cast<std::uint64_t>(value.integer))
                                       : std::to_string(value.integer);
        return failed(at, shown + " is outside " + limits_text(to) + " of " + to.name);
      }
      auto result = constant_integer(&to, value.integer);
      result.large = value.large;
      return result;
    }
    if (is_real(to.kind)) {
      const auto real = value.large ? static_cast<double>(static_cast<std::uint64_t>(value.integer))
                                    : static_cast<double>(value.integer);
      if (to.kind == Kind::real && !value.large &&
          static_cast<std::int64_t>(static_cast<float>(real)) != value.integer)
        unit_.diagnostics().warning(
            at, std::to_string(value.integer) + " is not exact as REAL (24 bits); use LREAL");
      return constant_real(&to, to.kind == Kind::real ? static_cast<double>(static_cast<float>(real)) : real);
    }
  } else if (from == Kind::real_literal && is_real(to.kind)) {
    auto result = constant_real(&to, value.real);
    if (to.kind == Kind::real) {
      const auto narrow = as_float(constant_cell(value, to));
      if (std::isinf(narrow) || std::abs(value.real) > std::numeric_limits<float>::max())
        return failed(at, "the value is too large for REAL; use LREAL");
      result.real = static_cast<double>(narrow);
    }
    return result;
  } else if (widens(*value.type, to)) {
    if (value.is_constant && is_elementary(to.kind)) {
      if (is_integer(to.kind) && to.ranged && !fits(to, value.integer))
        return failed(at,
                      std::to_string(value.integer) + " is outside " + limits_text(to) + " of " + to.name);
      auto result = value;
      result.type = &to;
      if (is_real(to.kind) && !is_real(from)) result = constant_real(&to, static_cast<double>(value.integer));
      result.text.clear();
      return result;
    }
    if (to.kind == Kind::string && value.is_constant) {
      const auto length = to.wide ? characters(value.text) : value.text.size();
      if (length > to.length)
        unit_.diagnostics().warning(at, "the string has " + std::to_string(length) +
                                            (to.wide ? " characters, " : " bytes, ") + to.name + " keeps " +
                                            std::to_string(to.length));
    }
    return value;
  }
  if (const auto free = converted_freely(value, to, at)) return *free;
  const auto& from_name = value.type->name;
  std::string text = "expected " + to.name + ", found " +
                     (from == Kind::integer_literal || from == Kind::real_literal ? "a number" : from_name);
  const bool numbers = from < Kind::string && to.kind < Kind::string;
  if (numbers) text += "; convert with " + elementary(from)->name + "_TO_" + elementary(to.kind)->name;
  if (from == Kind::string && to.kind == Kind::string)
    text += to.wide ? "; convert with STRING_TO_WSTRING" : "; convert with WSTRING_TO_STRING";
  if (from == Kind::real_literal && (is_integer(to.kind) || is_bits(to.kind)))
    text = "expected a whole number (" + to.name + "), found a number with a decimal point";
  else if ((from == Kind::integer_literal || from == Kind::real_literal) && is_duration(to.kind))
    text = "expected " + to.name + ", found a number; write a time with its unit: T#100ms";
  else if (to.kind == Kind::boolean && is_integer(from))
    text = "expected BOOL, found " + from_name + "; compare: value <> 0";
  return failed(at, text);
}

void Lowering::initialize(const Variable& variable) {
  if (variable.type->kind == Kind::error || variable.place.base != Place::Base::frame) return;
  const auto mark = emit_.mark();
  if (pou_->is_method() && variable.declared_in != nullptr) {
    auto place = self();
    place.offset = variable.place.offset;
    const auto from = emit_.temporary(), to = address(place);
    emit_.constant(from, unit_.allocate(variable.initial));
    emit_.add(Op::copy_block, to, from, static_cast<std::int32_t>(variable.initial.size()));
  } else {
    fill(variable.place.offset, variable.initial);
  }
  emit_.release(mark);
}

}  // namespace trunnion::st
