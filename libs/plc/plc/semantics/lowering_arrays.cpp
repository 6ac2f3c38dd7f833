// SPDX-License-Identifier: Apache-2.0
// Elements of arrays, and arrays whose limits are those of the caller's.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "plc/semantics/lowering.hpp"

namespace trunnion::st {

Value Lowering::index_number(const Expression& e) {
  const auto number = as_number(expression(e), e.at);
  if (number.is_error() || is_integer(number.type->kind) || number.type->kind == Kind::integer_literal)
    return number;
  return failed(e.at, "an index is a whole number, not " + number.type->name);
}

Value Lowering::index(const Expression& e) { return element(e, expression(*e.parts[0])); }

Value Lowering::element(const Expression& e, Value value) {
  if (value.is_error()) return value;
  if (value.type->kind != Kind::array)
    return failed(e.at, value.type->name + " is no array and has no index");
  const auto& type = *value.type;
  if (e.parts.size() - 1 != type.dimensions.size())
    return failed(e.at, "the array has " + std::to_string(type.dimensions.size()) +
                            (type.dimensions.size() == 1 ? " dimension, not " : " dimensions, not ") +
                            std::to_string(e.parts.size() - 1));
  if (type.open) return open_element(e, value);
  const bool pointed = value.place.base == Place::Base::pointer;
  std::int64_t stride = pointed ? static_cast<std::int64_t>(bytes_of(type)) : type.cells, offset = 0;
  std::optional<std::int32_t> sum;
  bool good = true;
  for (std::size_t i = 0; i < type.dimensions.size(); ++i) {
    const auto& dimension = type.dimensions[i];
    stride /= dimension.high - dimension.low + 1;
    const auto& at = e.parts[i + 1]->at;
    const auto number = index_number(*e.parts[i + 1]);
    if (number.is_error()) {
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
    if (stride > most_cells)
      return failed(at, "the elements have more than " + std::to_string(most_cells) +
                            " bytes, too many for the index behind a pointer");
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
  if (pointed) value.place.pointed = type.element;
  if (value.place.base == Place::Base::absolute && sum)
    unit_.use_register(static_cast<std::uint32_t>(value.place.offset - offset), type.cells, false);
  if (sum && pointed) {
    const auto result = emit_.temporary();
    emit_.add(Op::point_move, result, moved_pointer(value.place), *sum);
    value.place.cell = result, value.place.offset = 0;
  } else if (sum) {
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

/// Of ARRAY[*]: limits and strides are computed while the program runs.
Value Lowering::open_element(const Expression& e, Value value) {
  const auto& element = *value.type->element;
  const auto sum = emit_.temporary(), offset = emit_.temporary(), size = emit_.temporary(),
             factor = emit_.temporary();
  for (std::size_t i = 0; i < value.type->dimensions.size(); ++i) {
    const auto limits = value.limits + static_cast<std::int32_t>(2 * i);
    const auto number = index_number(*e.parts[i + 1]);
    if (number.is_error()) return number;
    const auto source = cell(number);
    emit_.place(e.parts[i + 1]->at);
    emit_.add(Op::check_limits, offset, source, limits);
    if (i == 0) {
      emit_.add(Op::move, sum, offset);
      continue;
    }
    emit_.constant(factor, 1);
    emit_.add(Op::subtract, size, limits + 1, limits);
    emit_.add(Op::add, size, size, factor);
    emit_.add(Op::multiply, sum, sum, size);
    emit_.add(Op::add, sum, sum, offset);
  }
  if (element.cells != 1) {
    emit_.constant(factor, element.cells);
    emit_.add(Op::multiply, sum, sum, factor);
  }
  const auto start = address(value.place);
  const auto result = emit_.temporary();
  emit_.add(Op::add, result, start, sum);
  const auto place = value.place;
  value.variable = nullptr;
  value.limits = -1;
  value.type = &element;
  value.place = {Place::Base::indirect, 0, result, -1, 0, 0, place.writable, place.refusal};
  return value;
}

/// Behind the address of the array that ARRAY[*] gets: the limits of each dimension.
void Lowering::add_limits(const Value& array, std::vector<std::int32_t>& cells) {
  for (std::size_t i = 0; i < array.type->dimensions.size(); ++i) {
    const auto& dimension = array.type->dimensions[i];
    const auto first = static_cast<std::int32_t>(2 * i);
    for (std::int32_t k = 0; k < 2; ++k) {
      cells.push_back(array.type->open ? array.limits + first + k : emit_.temporary());
      if (!array.type->open)
        emit_.constant(cells.back(), static_cast<std::uint64_t>(k == 0 ? dimension.low : dimension.high));
    }
  }
}

/// LOWER_BOUND, UPPER_BOUND; nothing for other calls.
std::optional<Value> Lowering::array_bound(const Expression& e, const Type* expected) {
  const auto& name = e.parts[0]->name;
  if (name != "LOWER_BOUND" && name != "UPPER_BOUND") return std::nullopt;
  const Expression *of = nullptr, *dimension = nullptr;
  for (std::size_t i = 0; i < e.arguments.size(); ++i) {
    const auto& argument = e.arguments[i];
    (argument.name == "ARR" || (argument.name.empty() && i == 0) ? of : dimension) = argument.value.get();
  }
  if (e.arguments.size() != 2 || of == nullptr || dimension == nullptr)
    return failed(e.at, name + " has an array and the number of a dimension");
  const auto array = expression(*of);
  Value number;
  if (array.is_error() || !unit_.constant(*dimension, *elementary(Kind::dint), pou_, number)) return error();
  if (array.type->kind != Kind::array) return failed(of->at, array.type->name + " is no array");
  const auto count = static_cast<std::int64_t>(array.type->dimensions.size());
  if (number.integer < 1 || number.integer > count)
    return failed(dimension->at, "the array has the dimensions 1 .. " + std::to_string(count) + ", not " +
                                     std::to_string(number.integer));
  const auto index = static_cast<std::size_t>(number.integer - 1);
  const bool upper = name == "UPPER_BOUND";
  const auto& limits = array.type->dimensions[index];
  if (!array.type->open)
    return constant_integer(elementary(Kind::integer_literal), upper ? limits.high : limits.low);
  return open_limit(array.limits + static_cast<std::int32_t>(2 * index) + (upper ? 1 : 0), expected, e.at);
}

/// As the integer type of what takes it: what does not fit is a fault.
Value Lowering::open_limit(std::int32_t limit, const Type* expected, Position at) {
  const bool fits = expected != nullptr && is_integer(expected->kind);
  auto result = temporary(elementary(fits ? expected->kind : Kind::dint));
  emit_.add(Op::move, result.place.offset, limit);
  const auto kind = result.type->kind;
  if (widens(*elementary(Kind::dint), *result.type)) return result;
  const auto top = (std::int64_t{1} << (std::min(bits(kind), 33) - 1)) - 1;
  emit_.place(at);
  emit_.add(Op::check_range, result.place.offset,
            unit_.range_entry(is_signed(kind) ? Range{-top - 1, top, 1} : Range{0, 2 * top + 1, 1}));
  return result;
}

}  // namespace trunnion::st
