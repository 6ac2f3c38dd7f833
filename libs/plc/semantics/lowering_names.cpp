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
  if (variable.section == VariableSection::in_out && variable.place.base == Place::Base::frame)
    value.place = {Place::Base::indirect, 0, variable.place.offset, -1, 0, 0, true, ""};
  return value;
}

Value Lowering::name(const Expression& e, const Type* expected) {
  if (const auto found = defined_.find(e.name); found != defined_.end()) return found->second;
  const auto noted = [&](Value value) {
    note_read(e, value);
    return value;
  };
  if (pou_ != nullptr)
    if (const auto found = pou_->names.find(e.name); found != pou_->names.end())
      return noted(variable_value(*found->second));
  if (auto* global = unit_.find_global(e.name)) return noted(variable_value(*global));
  if (expected != nullptr && expected->kind == Kind::enumeration)
    if (const auto* enumerator = expected->enumerator(e.name))
      return constant_integer(expected, enumerator->value);
  const Type* type = nullptr;
  if (const auto* enumerator = unit_.find_enumerator(e.name, &type))
    return constant_integer(type, enumerator->value);
  if (const auto found = unit_.registers().find(e.name); found != unit_.registers().end())
    return noted(unit_.register_value(found->second, nullptr, e.at));
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
  if (owner.kind == Expression::Kind::name && (pou_ == nullptr || !pou_->names.contains(owner.name)))
    if (const auto* type = unit_.find_global(owner.name) == nullptr ? unit_.named_type(owner.name) : nullptr;
        type != nullptr && type->kind == Kind::enumeration)
      if (const auto* enumerator = type->enumerator(e.name)) return constant_integer(type, enumerator->value);
  auto value = expression(owner);
  if (value.is_error()) return value;
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
    const bool is_public =
        variable.section == VariableSection::input || variable.section == VariableSection::output;
    if (!is_public && !(is_program && variable.place.base != Place::Base::none))
      return failed(e.at, "'" + e.text + "' is inside " + value.type->name +
                              "; only its inputs and outputs are accessible");
    if (variable.constant.is_constant) return variable.constant;
    value.type = variable.type;
    if (variable.place.base != Place::Base::frame) {
      value.place = variable.place;
      return value;
    }
    value.place = moved(value.place, variable.place.offset);
    value.place.writable = variable.section == VariableSection::input || is_program;
    value.place.refusal = "output of a function block is set by the block alone";
    return value;
  }
  return failed(
      e.at, value.type->name + " has no members; '." + e.text + "' needs a structure or a function block");
}

// w.%X3, w.%B1, w.%W0, w.%D1 (6.5.2.2 of the standard)
Value Lowering::part(const Expression& e) {
  auto value = expression(*e.parts[0]);
  if (value.is_error()) return value;
  if (value.is_constant) return failed(e.at, "a part of a constant is not accessible");
  const int whole = bits(value.type->kind);
  if (!is_bits(value.type->kind) || whole < 8)
    return failed(e.at, "a part is of BYTE, WORD, DWORD or LWORD, not of " + value.type->name);
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

Value Lowering::index(const Expression& e) {
  auto value = expression(*e.parts[0]);
  if (value.is_error()) return value;
  if (value.type->kind != Kind::array)
    return failed(e.at, value.type->name + " is no array and has no index");
  const auto& type = *value.type;
  if (e.parts.size() - 1 != type.dimensions.size())
    return failed(e.at, "the array has " + std::to_string(type.dimensions.size()) +
                            (type.dimensions.size() == 1 ? " dimension, not " : " dimensions, not ") +
                            std::to_string(e.parts.size() - 1));
  std::int64_t stride = type.cells, offset = 0;
  std::optional<std::int32_t> sum;
  bool good = true;
  for (std::size_t i = 0; i < type.dimensions.size(); ++i) {
    const auto& dimension = type.dimensions[i];
    stride /= dimension.high - dimension.low + 1;
    const auto& at = e.parts[i + 1]->at;
    auto number = expression(*e.parts[i + 1]);
    if (number.is_error()) {
      good = false;
      continue;
    }
    if (!is_integer(number.type->kind) && number.type->kind != Kind::integer_literal) {
      failed(at, "an index is a whole number, not " + number.type->name);
      good = false;
      continue;
    }
    if (number.is_constant) {
      if (number.large || number.integer < dimension.low || number.integer > dimension.high) {
        failed(at, "index " + std::to_string(number.integer) + " is outside " +
                       std::to_string(dimension.low) + " .. " + std::to_string(dimension.high) +
                       " of the array");
        good = false;
        continue;
      }
      offset += (number.integer - dimension.low) * stride;
      continue;
    }
    const auto source = cell(number);
    const auto scaled = emit_.temporary();
    emit_.place(at);
    emit_.add(Op::check_index, scaled, source, unit_.range_entry({dimension.low, dimension.high, stride}));
    if (!sum)
      sum = scaled;
    else
      emit_.add(Op::add, *sum, *sum, scaled);
  }
  if (!good) return error();
  value.variable = nullptr;
  value.type = type.element;
  value.place = moved(value.place, static_cast<std::int32_t>(offset));
  if (value.place.base == Place::Base::absolute && sum)
    unit_.use_register(static_cast<std::uint32_t>(value.place.offset - offset), type.cells, false);
  if (sum) {
    auto place = value.place;
    if (place.base == Place::Base::absolute)
      unit_.use_register(static_cast<std::uint32_t>(place.offset - offset), type.cells, true);
    const auto start = address(place);
    const auto result = emit_.temporary();
    emit_.add(Op::add, result, start, *sum);
    value.place = {Place::Base::indirect, 0, result, -1, 0, 0, place.writable, place.refusal};
  }
  return value;
}

}  // namespace trunnion::st
