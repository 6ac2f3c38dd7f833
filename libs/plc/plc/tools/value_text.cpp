// SPDX-License-Identifier: Apache-2.0
#include "plc/tools/value_text.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "plc/machine/arithmetic.hpp"
#include "plc/machine/pointer.hpp"
#include "plc/machine/strings.hpp"
#include "plc/semantics/time_literal.hpp"
#include "plc/semantics/unit.hpp"
#include "plc/syntax/token.hpp"

namespace trunnion::st {
namespace {

constexpr std::int64_t day_ns = 86400000000000;

std::string real_text(auto value) {
  char digits[40];
  auto* end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  std::string text(digits, end);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string string_text(std::span<const std::uint64_t> cells) {
  const auto length = std::min<std::uint64_t>(cells[0], (cells.size() - 1) * 8);
  return {reinterpret_cast<const char*>(cells.data() + 1), length};
}

std::string duration_text(std::int64_t ns, bool is_long) {
  std::uint64_t memory[12] = {};
  const auto argument = static_cast<std::uint64_t>(ns);
  make_string(StringFunction::from_time, false, memory, 0, 80, &argument);
  const auto text = string_text(memory);
  return is_long ? "L" + text : text;
}

std::string date_text(std::int64_t ns) {
  const std::chrono::sys_days days{std::chrono::days(ns / day_ns)};
  const std::chrono::year_month_day date{days};
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text;
}

std::string clock_text(std::int64_t ns) {
  const auto seconds = ns / 1000000000;
  char text[64];
  std::snprintf(text, sizeof text, "%02d:%02d:%02d", static_cast<int>(seconds / 3600 % 24),
                static_cast<int>(seconds / 60 % 60), static_cast<int>(seconds % 60));
  std::string result = text;
  if (ns % 1000000000 != 0) {
    std::snprintf(text, sizeof text, ".%09d", static_cast<int>(ns % 1000000000));
    result += text;
  }
  return result;
}

}  // namespace

std::string value_text(const Type& type, std::span<const std::uint64_t> cells) {
  const auto value = as_signed(cells[0]);
  switch (type.kind) {
    case Kind::boolean:
      return value != 0 ? "TRUE" : "FALSE";
    case Kind::real:
      return real_text(as_float(cells[0]));
    case Kind::lreal:
      return real_text(as_double(cells[0]));
    case Kind::time:
    case Kind::ltime:
      return duration_text(value, type.kind == Kind::ltime);
    case Kind::date:
      return "D#" + date_text(value);
    case Kind::tod:
      return "TOD#" + clock_text(value);
    case Kind::dt:
      return "DT#" + date_text(value) + "-" + clock_text(value % day_ns);
    case Kind::string:
      return type.wide ? "\"" + string_text(cells) + "\"" : "'" + string_text(cells) + "'";
    case Kind::enumeration:
      for (const auto& enumerator : type.enumerators)
        if (enumerator.value == value) return enumerator.text;
      return std::to_string(value);
    case Kind::interface_:
      return cells[0] == null_reference ? "NULL"
                                        : "an instance at cell " + std::to_string(cells[0] & 0xffffffffu);
    case Kind::reference:
      return cells[0] == null_reference ? "NULL" : "the variable at cell " + std::to_string(cells[0]);
    case Kind::pointer:
      return cells[0] == null_reference
                 ? "NULL"
                 : "byte " + std::to_string(pointer_offset(cells[0])) + " of the variable at cell " +
                       std::to_string(pointer_address(cells[0]));
    case Kind::array: {
      std::string text = "[";
      for (std::uint32_t i = 0; i < type.cells; i += type.element->cells)
        text += (i > 0 ? ", " : "") + value_text(*type.element, cells.subspan(i, type.element->cells));
      return text + "]";
    }
    case Kind::structure: {
      std::string text = "(";
      for (const auto& field : type.fields)
        text += (text.size() > 1 ? ", " : "") + field.text +
                " := " + value_text(*field.type, cells.subspan(field.offset, field.type->cells));
      return text + ")";
    }
    case Kind::block: {
      std::string text = "(";
      for (const auto& v : type.block->pou->variables)
        if (v.section == VariableSection::input || v.section == VariableSection::output)
          text += (text.size() > 1 ? ", " : "") + v.text + " := " +
                  value_text(*v.type, cells.subspan(static_cast<std::size_t>(v.place.offset), v.type->cells));
      return text + ")";
    }
    default:
      return is_signed(type.kind) ? std::to_string(value) : std::to_string(cells[0]);
  }
}

void set_value(const Type& type, const std::string& text, std::span<std::uint64_t> cells) {
  const auto refuse = [&](const std::string& expected) -> std::uint64_t {
    throw std::runtime_error("'" + text + "' is no " + type.name + ": " + expected);
  };
  const auto upper = upper_case(text);
  const auto hash = text.find('#');
  const auto behind = hash == std::string::npos ? text : text.substr(hash + 1);
  std::string problem;
  if (type.kind == Kind::boolean) {
    if (upper != "TRUE" && upper != "FALSE" && text != "1" && text != "0") refuse("write TRUE or FALSE");
    cells[0] = upper == "TRUE" || text == "1" ? 1 : 0;
  } else if (is_integer(type.kind) || is_bits(type.kind)) {
    const bool negative = text.starts_with('-');
    const int base = text.starts_with("16#")  ? 16
                     : text.starts_with("2#") ? 2
                     : text.starts_with("8#") ? 8
                                              : 10;
    const auto digits = base == 10 ? text.substr(negative ? 1 : 0) : behind;
    std::uint64_t value = 0;
    const auto* end = digits.data() + digits.size();
    const auto parsed = std::from_chars(digits.data(), end, value, base);
    const auto result = static_cast<std::int64_t>(negative ? 0 - value : value);
    const bool large =
        !negative && value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (digits.empty() || parsed.ec != std::errc{} || parsed.ptr != end || (negative && result > 0) ||
        !fits(type, result, large))
      refuse("write a whole number " + limits_text(type));
    cells[0] = static_cast<std::uint64_t>(result);
  } else if (is_real(type.kind)) {
    const auto* end = text.data() + text.size();
    double value = 0;
    float single = 0;
    const auto parsed = type.kind == Kind::real ? std::from_chars(text.data(), end, single)
                                                : std::from_chars(text.data(), end, value);
    if (text.empty() || parsed.ec != std::errc{} || parsed.ptr != end) refuse("write a number like 1.5");
    cells[0] = type.kind == Kind::real ? cell_of(single) : cell_of(value);
  } else if (is_duration(type.kind) || is_date(type.kind)) {
    const auto value = is_duration(type.kind)    ? parse_duration(behind, problem)
                       : type.kind == Kind::date ? parse_date(behind, problem)
                       : type.kind == Kind::tod  ? parse_time_of_day(behind, problem)
                                                 : parse_date_and_time(behind, problem);
    if (!value || hash == std::string::npos)
      refuse(problem.empty() ? "write it with its prefix, as T#1s" : problem);
    cells[0] = static_cast<std::uint64_t>(*value);
  } else if (type.kind == Kind::enumeration) {
    const auto* enumerator = type.enumerator(upper_case(behind));
    if (enumerator == nullptr) refuse("write one of its values");
    cells[0] = static_cast<std::uint64_t>(enumerator->value);
  } else if (type.kind == Kind::string) {
    auto content = text;
    const char quote = type.wide ? '"' : '\'';
    if (content.size() >= 2 && content.front() == quote && content.back() == quote)
      content = content.substr(1, content.size() - 2);
    if (type.wide && !is_wide_text(content)) refuse("it has characters of at most 16 bits, in UTF-8");
    if ((type.wide ? characters(content) : content.size()) > type.length)
      refuse("it has " + std::to_string(type.length) + (type.wide ? " characters" : " bytes") + " at most");
    std::fill(cells.begin(), cells.end(), 0);
    cells[0] = content.size();
    std::copy(content.begin(), content.end(), reinterpret_cast<char*>(cells.data() + 1));
  } else if (is_reference(type.kind)) {
    refuse("the programs set it");
  } else {
    refuse("set one of its elements");
  }
}

}  // namespace trunnion::st
