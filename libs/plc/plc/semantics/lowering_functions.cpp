// SPDX-License-Identifier: Apache-2.0
// The standard functions.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <sstream>

#include "plc/library/functions.hpp"
#include "plc/machine/arithmetic.hpp"
#include "plc/semantics/lowering.hpp"

namespace trunnion::st {
namespace {

/// Arguments in the order of the parameters; an error is reported and gives false.
bool in_order(const FunctionRow& row, const Expression& e, Diagnostics& diagnostics,
              std::vector<const Expression*>& result) {
  const auto report = [&](Position at, const std::string& text) {
    diagnostics.error(at, std::string(row.name) + " " + text);
    return false;
  };
  const auto count = static_cast<int>(e.arguments.size());
  if (count < row.least || count > row.most) {
    const bool one = row.least == row.most;
    return report(e.at, "has " + std::to_string(row.least) + (one ? "" : " or more") +
                            (row.least == 1 && one ? " argument" : " arguments") + ", not " +
                            std::to_string(count));
  }
  std::vector<std::string> names;
  std::istringstream words{std::string(row.parameters)};
  for (std::string word; words >> word;) names.push_back(word);
  result.assign(e.arguments.size(), nullptr);
  std::size_t next = 0;
  for (const auto& argument : e.arguments) {
    auto index = next;
    if (argument.output) return report(argument.at, "has no outputs");
    if (!argument.name.empty()) {
      const auto found = std::find(names.begin(), names.end(), argument.name);
      index = static_cast<std::size_t>(found - names.begin());
      if (row.parameters.empty() && argument.name.rfind("IN", 0) == 0 && argument.name.size() < 5) {
        // IN1 is the first, of MUX IN0 behind K.
        const int number = std::atoi(argument.name.c_str() + 2);
        index = static_cast<std::size_t>(row.name == "MUX" ? number + 1 : std::max(number, 1) - 1);
      }
      if (row.name == "MUX" && argument.name == "K") index = 0;
    }
    if (index >= result.size() || result[index] != nullptr)
      return report(argument.at, argument.name.empty() ? "has two values for one parameter"
                                                       : "has no free parameter '" + argument.name + "'");
    result[index] = argument.value.get();
    next = index + 1;
  }
  return true;
}

Value absolute_literal(Value value) {
  if (value.type->kind == Kind::real_literal) {
    value.real = std::fabs(value.real);
    if (value.text.starts_with('-')) value.text.erase(0, 1);
  } else if (value.integer < 0 && !value.large) {
    value.large = value.integer == std::numeric_limits<std::int64_t>::min();
    value.integer = static_cast<std::int64_t>(0 - static_cast<std::uint64_t>(value.integer));
  }
  return value;
}

/// Whether the arguments have the type of the result.
bool keeps_type(FunctionGroup group) {
  using enum FunctionGroup;
  return group == math || group == absolute || group == arithmetic || group == selection || group == move ||
         group == order_of_bytes;
}

/// The second argument of shifts and of EXPT.
bool has_other_type(const FunctionRow& row) {
  return row.group == FunctionGroup::shift || row.name == "EXPT";
}

/// ADD_INT is ADD with operands of this type (IEC 61131-3:2013, table 21); nullptr for other names.
const FunctionRow* typed_function(const std::string& name, const Type*& type) {
  using enum FunctionGroup;
  const auto at = name.rfind('_');
  if (at == std::string::npos) return nullptr;
  const auto* row = find_function(name.substr(0, at));
  type = elementary(name.substr(at + 1));
  if (row == nullptr || type == nullptr) return nullptr;
  const bool permitted = (keeps_type(row->group) && row->group != order_of_bytes) ||
                         row->group == comparison || row->group == shift;
  return permitted ? row : nullptr;
}

}  // namespace

/// The value in a cell of this type, to which it converts implicitly.
Value Lowering::of_type(const Value& value, const Type& type, Position at) {
  const auto given = converted(value, type, at);
  if (given.is_error() || given.is_constant || same_type(*given.type, type)) return given;
  auto result = temporary(&type);
  emit_.add(Op::move, result.place.offset, cell(given, type));
  return result;
}

std::optional<Value> Lowering::standard_function(const Expression& e, const Type* expected) {
  const Type* operands = nullptr;
  const auto* row = find_function(e.parts[0]->name);
  if (row == nullptr) {
    if (auto value = conversion(e, e.parts[0]->name)) return value;
    if (e.parts[0]->name == "TIME" && unit_.is_codesys(e.at) && e.arguments.empty())
      return plc_time(Kind::time);
    row = typed_function(e.parts[0]->name, operands);
    if (row == nullptr) return std::nullopt;
  }
  const std::string name(row->name);
  std::vector<const Expression*> ordered;
  if (!in_order(*row, e, unit_.diagnostics(), ordered)) return error();
  std::vector<Value> values;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const bool selects = i == 0 && (name == "SEL" || name == "MUX");
    const bool is_typed = operands != nullptr && !selects && (i == 0 || !has_other_type(*row));
    const Type* hint = is_typed ? operands : selects || !keeps_type(row->group) ? nullptr : expected;
    if (i > 0 && !values.back().is_error() && values.back().type->kind == Kind::enumeration)
      hint = values.back().type;
    auto value = expression(*ordered[i], hint);
    if (is_typed) value = of_type(value, *operands, ordered[i]->at);
    for (auto j = i + 1; j < ordered.size(); ++j)
      if (ordered[j]->kind == Expression::Kind::call) value = value.is_error() ? value : kept(value);
    values.push_back(value);
  }
  for (const auto& value : values)
    if (value.is_error()) return error();
  const auto group = row->group;
  const bool counts = group == FunctionGroup::math || group == FunctionGroup::absolute ||
                      group == FunctionGroup::selection || group == FunctionGroup::string;
  for (auto& value : values)
    if (counts && !value.is_literal()) value = as_number(value, e.at);
  for (const auto& value : values)
    if (value.type->kind == Kind::none) return failed(e.at, "the function has no result");
  emit_.place(e.at);
  const auto fold_all = [&](const std::string& op, bool compares) {
    auto result = values[0];
    Value all;
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (!compares) {
        result =
            op == "**" ? power(result, values[i], expected, e.at) : arithmetic(op, result, values[i], e.at);
        if (result.is_error()) return result;
        continue;
      }
      const auto one = comparison(op, values[i - 1], values[i], e.at);
      if (one.is_error()) return one;
      all = i == 1 ? one : operation(Op::and_, elementary(Kind::boolean), all, one, false);
    }
    return compares ? all : result;
  };
  switch (row->group) {
    case FunctionGroup::arithmetic:
      return fold_all(name == "ADD"   ? "+"
                      : name == "MUL" ? "*"
                      : name == "SUB" ? "-"
                      : name == "DIV" ? "/"
                                      : "**",
                      false);
    case FunctionGroup::time:
      if (name.substr(3) == "_LTIME") {
        values[0] = converted(values[0], *elementary(Kind::ltime), e.at);
        if (name == "ADD_LTIME" || name == "SUB_LTIME")
          values[1] = converted(values[1], *elementary(Kind::ltime), e.at);
      }
      if (values[0].is_error() || values[1].is_error()) return error();
      return fold_all(name.rfind("ADD", 0) == 0   ? "+"
                      : name.rfind("SUB", 0) == 0 ? "-"
                      : name.rfind("MUL", 0) == 0 ? "*"
                                                  : "/",
                      false);
    case FunctionGroup::comparison:
      return fold_all(name == "GT"   ? ">"
                      : name == "GE" ? ">="
                      : name == "EQ" ? "="
                      : name == "LE" ? "<="
                      : name == "LT" ? "<"
                                     : "<>",
                      true);
    case FunctionGroup::math: {
      static const std::map<std::string_view, MathFunction> functions = {
          {"SQRT", MathFunction::sqrt}, {"LN", MathFunction::ln},       {"LOG", MathFunction::log},
          {"EXP", MathFunction::exp},   {"SIN", MathFunction::sin},     {"COS", MathFunction::cos},
          {"TAN", MathFunction::tan},   {"ASIN", MathFunction::asin},   {"ACOS", MathFunction::acos},
          {"ATAN", MathFunction::atan}, {"ATAN2", MathFunction::atan2}, {"FLOOR", MathFunction::floor},
          {"CEIL", MathFunction::ceil}};
      return math_function(functions.at(row->name), values, e, expected);
    }
    case FunctionGroup::absolute: {
      const auto kind = values[0].type->kind;
      if (values[0].is_literal()) return absolute_literal(values[0]);
      if (is_real(kind)) return math_function(MathFunction::abs, values, e, expected);
      if (is_duration(kind) || (is_integer(kind) && is_signed(kind))) {
        const auto& value = values[0];
        const auto* type = elementary(value.type->kind);
        auto result = temporary(type);
        const auto zero = emit_.temporary(), negative = emit_.temporary();
        emit_.add(Op::move, result.place.offset, cell(value));
        emit_.constant(zero, 0);
        emit_.add(Op::less_equal, negative, zero, result.place.offset);
        const auto jump = emit_.add(Op::jump_if, 0, negative);
        emit_.add(Op::negate, result.place.offset, result.place.offset);
        if (bits(type->kind) < 64)
          emit_.add(Op::narrow, result.place.offset, result.place.offset, 0, cell_form(type->kind));
        emit_.jump_to_here(jump);
        return result;
      }
      if (is_integer(kind)) return values[0];
      return failed(e.at, "ABS is for numbers, not for " + values[0].type->name);
    }
    case FunctionGroup::shift:
      return shift(name, values, e);
    case FunctionGroup::selection:
      return selection(name, e, std::move(values), expected);
    case FunctionGroup::string:
      return string_function(name, values, e);
    case FunctionGroup::order_of_bytes:
      return byte_order(name.ends_with("BIG_ENDIAN"), values[0], e);
    case FunctionGroup::validation:
      return validity(name == "IS_VALID_BCD", values[0], e);
    case FunctionGroup::move:
    case FunctionGroup::ladder:
      return values[0];
    case FunctionGroup::clock:
      return plc_time(Kind::ltime);
    case FunctionGroup::test:
      return test_function(name, values, e);
  }
  return error();
}

Value Lowering::plc_time(Kind kind) {
  auto result = temporary(elementary(kind));
  const auto offset = emit_.temporary();
  emit_.add(Op::now, result.place.offset);
  emit_.add(Op::load, offset, static_cast<std::int32_t>(Unit::clock_offset_cell));
  emit_.add(Op::add, result.place.offset, result.place.offset, offset);
  return result;
}

Value Lowering::math_function(MathFunction function, const std::vector<Value>& values, const Expression& e,
                              const Type* expected) {
  const bool of_literals =
      std::all_of(values.begin(), values.end(), [](const Value& v) { return v.is_literal(); });
  const bool single = of_literals ? expected != nullptr && expected->kind == Kind::real
                                  : std::all_of(values.begin(), values.end(), [](const Value& v) {
                                      return v.type->kind == Kind::real || v.is_literal() ||
                                             widens(*v.type, *elementary(Kind::real));
                                    });
  const auto* type = elementary(single ? Kind::real : Kind::lreal);
  std::int32_t cells[2] = {0, 0};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i].is_literal() && !widens(*values[i].type, *type))
      return failed(e.at, e.parts[0]->text + " is for REAL and LREAL, not for " + values[i].type->name);
    cells[i] = cell(converted(values[i], *type, e.at), *type);
  }
  auto result = temporary(type);
  emit_.add(single ? Op::math_f : Op::math, result.place.offset, cells[0],
            values.size() > 1 ? cells[1] : cells[0], static_cast<std::uint16_t>(function));
  return result;
}

/// The PLC has the low byte first.
Value Lowering::byte_order(bool reverse, const Value& value, const Expression& e) {
  const auto kind = value.type->kind;
  if (!is_integer(kind) && !is_bits(kind) && !is_real(kind) && !is_duration(kind))
    return failed(e.at,
                  e.parts[0]->text + (value.is_literal()
                                          ? " needs a typed literal, as WORD#16#FF"
                                          : " is for integers, bit strings, REAL, LREAL and times, not for " +
                                                value.type->name));
  if (!reverse || bits(kind) <= 8) return value;
  const auto source = cell(value);
  auto result = temporary(elementary(kind));
  const auto form = is_integer(kind) ? cell_form(kind) : static_cast<std::uint16_t>(bits(kind));
  emit_.add(Op::swap_bytes, result.place.offset, source, 0, form);
  return result;
}

Value Lowering::validity(bool digits, const Value& value, const Expression& e) {
  const auto kind = value.type->kind;
  const bool single = kind == Kind::real;
  if (digits ? !is_bits(kind) || kind == Kind::boolean : !is_real(kind))
    return failed(e.at,
                  e.parts[0]->text +
                      (digits ? " is for BYTE .. LWORD, not for " : " is for REAL and LREAL, not for ") +
                      value.type->name);
  const auto source = cell(value);
  auto result = temporary(elementary(Kind::boolean));
  const auto target = result.place.offset;
  if (digits) {
    emit_.add(Op::is_bcd, target, source);
  } else {  // of infinite values and NaN the difference is NaN, which equals nothing
    const auto zero = emit_.temporary();
    emit_.add(single ? Op::subtract_f : Op::subtract_d, zero, source, source);
    emit_.add(single ? Op::equal_f : Op::equal_d, target, zero, zero);
  }
  return result;
}

Value Lowering::shift(const std::string& name, const std::vector<Value>& values, const Expression& e) {
  if (values[0].type->kind == Kind::integer_literal)
    return failed(e.at, name + " needs a typed literal, as WORD#16#FF");
  const auto bit_string = as_bits(values[0], e.at), places = as_number(values[1], e.at);
  const auto kind = bit_string.type->kind;
  if (!is_bits(kind)) return failed(e.at, name + " is for bit strings, not for " + values[0].type->name);
  const auto count_kind = places.type->kind;
  if (!is_integer(count_kind) && count_kind != Kind::integer_literal)
    return failed(e.at, "the number of places is an integer, not " + values[1].type->name);
  const auto source = cell(bit_string);
  const auto count = cell(
      converted(places, count_kind == Kind::integer_literal ? *elementary(Kind::uint_) : *places.type, e.at));
  auto result = temporary(elementary(kind));
  const Op op = name == "SHL"   ? Op::shift_left
                : name == "SHR" ? Op::shift_right
                : name == "ROL" ? Op::rotate_left
                                : Op::rotate_right;
  emit_.add(op, result.place.offset, source, count, static_cast<std::uint16_t>(bits(kind)));
  return result;
}

Value Lowering::string_result(StringFunction function, std::span<const std::int32_t> arguments,
                              std::uint32_t length, bool wide) {
  const auto first = emit_.temporary(static_cast<std::uint32_t>(arguments.size()));
  for (std::size_t i = 0; i < arguments.size(); ++i)
    emit_.add(Op::move, first + static_cast<std::int32_t>(i), arguments[i]);
  const std::uint32_t longest = wide ? longest_wide_string : longest_string;
  auto result = temporary(unit_.string_type(std::clamp<std::uint32_t>(length, 1, longest), wide));
  emit_.add(Op::string_make, address(result.place), first, static_cast<std::int32_t>(result.type->length),
            string_code(function, wide));
  return result;
}

Value Lowering::string_function(const std::string& name, const std::vector<Value>& values,
                                const Expression& e) {
  static const std::map<std::string_view, std::pair<StringFunction, int>> functions = {
      {"LEN", {StringFunction::length, 1}},    {"LEFT", {StringFunction::left, 1}},
      {"RIGHT", {StringFunction::right, 1}},   {"MID", {StringFunction::mid, 1}},
      {"CONCAT", {StringFunction::concat, 2}}, {"INSERT", {StringFunction::insert, 2}},
      {"DELETE", {StringFunction::erase, 1}},  {"REPLACE", {StringFunction::replace, 2}},
      {"FIND", {StringFunction::find, 2}}};
  const auto [function, strings] = functions.at(name);
  std::vector<std::int32_t> cells;
  std::uint32_t length = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_string = i < static_cast<std::size_t>(strings) || function == StringFunction::concat;
    const auto kind = values[i].type->kind;
    if (is_string ? kind != Kind::string : !is_integer(kind) && kind != Kind::integer_literal)
      return failed(e.at, "argument " + std::to_string(i + 1) + " of " + name + " is " +
                              (is_string ? "a string" : "an integer") + ", not " + values[i].type->name);
    if (is_string && values[i].type->wide != values[0].type->wide)
      return failed(e.at,
                    name + " is for STRING or for WSTRING, not for both; convert with STRING_TO_WSTRING");
    if (is_string) length += values[i].type->length;
    cells.push_back(is_string ? address(values[i]) : cell(values[i], *elementary(Kind::lint)));
  }
  const bool wide = values[0].type->wide;
  if (function == StringFunction::length || function == StringFunction::find) {
    const auto first = emit_.temporary(static_cast<std::uint32_t>(cells.size()));
    for (std::size_t i = 0; i < cells.size(); ++i)
      emit_.add(Op::move, first + static_cast<std::int32_t>(i), cells[i]);
    auto result = temporary(elementary(Kind::int_));
    emit_.add(Op::string_query, result.place.offset, first, 0, string_code(function, wide));
    return result;
  }
  if (function != StringFunction::concat) return string_result(function, cells, length, wide);
  Value joined = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    const std::int32_t pair[] = {address(joined), cells[i]};
    joined = string_result(function, pair, joined.type->length + values[i].type->length, wide);
  }
  return joined;
}

Value Lowering::test_function(const std::string& name, const std::vector<Value>& values,
                              const Expression& e) {
  Value none;
  none.type = elementary(Kind::none);
  if (!in_test()) return failed(e.at, name + " is for TEST only");
  if (name == "ADVANCE") {
    const auto time = converted(values[0], *elementary(Kind::ltime), e.at);
    if (time.is_error()) return time;
    const auto sum = emit_.temporary(), by = cell(time);
    emit_.add(Op::load, sum, static_cast<std::int32_t>(Unit::clock_offset_cell));
    emit_.add(Op::add, sum, sum, by);
    emit_.add(Op::save, sum, static_cast<std::int32_t>(Unit::clock_offset_cell));
    return none;
  }
  Assertion assertion;
  Value condition;
  if (name == "ASSERT_TRUE" || name == "ASSERT_FALSE") {
    condition = converted(values[0], *elementary(Kind::boolean), e.at);
    if (condition.is_error()) return condition;
    auto result = temporary(elementary(Kind::boolean));
    emit_.add(name == "ASSERT_TRUE" ? Op::move : Op::not_, result.place.offset, cell(condition));
    condition = result;
  } else {
    auto actual = values[0], wanted = values[1];
    if (name == "ASSERT_NEAR") {
      const auto* lreal = elementary(Kind::lreal);
      for (auto* value : {&actual, &wanted})
        *value = widens(*value->type, *lreal) || value->is_literal()
                     ? converted(*value, *lreal, e.at)
                     : converted_to(*value, *lreal, false, e.at);
      const auto difference = arithmetic("-", actual, wanted, e.at);
      if (difference.is_error()) return difference;
      auto distance = temporary(lreal);
      emit_.add(Op::math, distance.place.offset, cell(difference), cell(difference),
                static_cast<std::uint16_t>(MathFunction::abs));
      condition = comparison("<=", distance, values[2], e.at);
    } else {
      condition = comparison("=", actual, wanted, e.at);
    }
    if (condition.is_error()) return condition;
    condition = condition.is_constant ? condition : kept(condition);
    const auto* type = is_elementary(actual.type->kind) ? actual.type : wanted.type;
    const auto* common = is_elementary(type->kind) ? common_type(actual.is_literal() ? *type : *actual.type,
                                                                 wanted.is_literal() ? *type : *wanted.type)
                                                   : nullptr;
    if (common != nullptr) {
      assertion.kind = common->kind == Kind::real    ? Assertion::Kind::real
                       : common->kind == Kind::lreal ? Assertion::Kind::lreal
                       : is_signed(common->kind)     ? Assertion::Kind::integer
                                                     : Assertion::Kind::unsigned_integer;
      assertion.actual = cell(converted(actual, *common, e.at), *common);
      assertion.expected = cell(converted(wanted, *common, e.at), *common);
    }
  }
  unit_.code.assertions.push_back(assertion);
  emit_.place(e.at);
  emit_.add(Op::assert_, cell(condition), static_cast<std::int32_t>(unit_.code.assertions.size() - 1));
  return none;
}

}  // namespace trunnion::st
