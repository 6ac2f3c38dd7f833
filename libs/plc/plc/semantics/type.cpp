// SPDX-License-Identifier: Apache-2.0
#include "plc/semantics/type.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace trunnion::st {
namespace {

struct Row {
  Kind kind;
  const char* name;
  int bits;
  bool is_signed;
};
constexpr std::array type_rows = std::to_array<Row>({
    {Kind::boolean, "BOOL", 1, false},
    {Kind::byte, "BYTE", 8, false},
    {Kind::word, "WORD", 16, false},
    {Kind::dword, "DWORD", 32, false},
    {Kind::lword, "LWORD", 64, false},
    {Kind::sint, "SINT", 8, true},
    {Kind::int_, "INT", 16, true},
    {Kind::dint, "DINT", 32, true},
    {Kind::lint, "LINT", 64, true},
    {Kind::usint, "USINT", 8, false},
    {Kind::uint_, "UINT", 16, false},
    {Kind::udint, "UDINT", 32, false},
    {Kind::ulint, "ULINT", 64, false},
    {Kind::real, "REAL", 32, false},
    {Kind::lreal, "LREAL", 64, false},
    {Kind::time, "TIME", 64, true},
    {Kind::ltime, "LTIME", 64, true},
    {Kind::date, "DATE", 64, true},
    {Kind::tod, "TIME_OF_DAY", 64, true},
    {Kind::dt, "DATE_AND_TIME", 64, true},
    {Kind::integer_literal, "a whole number", 64, true},
    {Kind::real_literal, "a number with a decimal point", 64, false},
    {Kind::null_, "NULL", 64, false},
    {Kind::none, "nothing", 64, false},
    {Kind::error, "unknown", 64, false},
});

const Row* row(Kind kind) {
  const auto found =
      std::find_if(type_rows.begin(), type_rows.end(), [&](const Row& r) { return r.kind == kind; });
  return found == type_rows.end() ? nullptr : &*found;
}

const std::map<Kind, Type>& elementary_types() {
  static const auto types = [] {
    std::map<Kind, Type> result;
    for (const auto& r : type_rows) {
      auto& type = result[r.kind];
      type.kind = r.kind;
      type.name = r.name;
      type.initial = {0};
    }
    return result;
  }();
  return types;
}

/// To which types a type converts by one step, the smallest first (figure 12 of IEC 61131-3:2013).
const std::map<Kind, std::vector<Kind>>& steps() {
  using enum Kind;
  static const std::map<Kind, std::vector<Kind>> table = {
      {boolean, {byte}},
      {byte, {word}},
      {word, {dword}},
      {dword, {lword}},
      {sint, {int_}},
      {int_, {dint, real}},
      {dint, {lint, lreal}},
      {usint, {int_, uint_}},
      {uint_, {dint, udint, real}},
      {udint, {lint, ulint, lreal}},
      {real, {lreal}},
      {time, {ltime}},
  };
  return table;
}

bool reaches(Kind from, Kind to) {
  if (from == to) return true;
  const auto found = steps().find(from);
  return found != steps().end() && std::any_of(found->second.begin(), found->second.end(),
                                               [&](Kind next) { return reaches(next, to); });
}

}  // namespace

const Field* Type::field(std::string_view upper) const {
  const auto found =
      std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == upper; });
  return found == fields.end() ? nullptr : &*found;
}

const Enumerator* Type::enumerator(std::string_view upper) const {
  if (!space.empty() && upper.starts_with(space) && upper.substr(space.size()).starts_with('.'))
    upper.remove_prefix(space.size() + 1);
  const auto found = std::find_if(enumerators.begin(), enumerators.end(),
                                  [&](const Enumerator& e) { return e.name == upper; });
  return found == enumerators.end() ? nullptr : &*found;
}

const Type* elementary(Kind kind) {
  const auto found = elementary_types().find(kind);
  return found == elementary_types().end() ? nullptr : &found->second;
}

const Type* elementary(std::string_view upper) {
  // Dates count nanoseconds in 64 bits, so the long ones are the same.
  if (upper == "LDATE") return elementary(Kind::date);
  if (upper == "TOD" || upper == "LTOD" || upper == "LTIME_OF_DAY") return elementary(Kind::tod);
  if (upper == "DT" || upper == "LDT" || upper == "LDATE_AND_TIME") return elementary(Kind::dt);
  for (const auto& r : type_rows)
    if (upper == r.name && r.kind < Kind::string) return elementary(r.kind);
  return nullptr;
}

bool is_signed(Kind kind) {
  const auto* r = row(kind);
  return kind == Kind::enumeration || (r != nullptr && r->is_signed);
}
bool is_integer(Kind kind) { return kind >= Kind::sint && kind <= Kind::ulint; }
bool is_real(Kind kind) { return kind == Kind::real || kind == Kind::lreal; }
bool is_bits(Kind kind) { return kind <= Kind::lword; }
bool is_duration(Kind kind) { return kind == Kind::time || kind == Kind::ltime; }
bool is_date(Kind kind) { return kind == Kind::date || kind == Kind::tod || kind == Kind::dt; }
bool is_elementary(Kind kind) { return kind < Kind::string || kind == Kind::enumeration; }
bool is_reference(Kind kind) {
  return kind == Kind::interface_ || kind == Kind::reference || kind == Kind::pointer || kind == Kind::null_;
}
bool is_one_cell(Kind kind) { return is_elementary(kind) || is_reference(kind); }

int bits(Kind kind) {
  const auto* r = row(kind);
  return kind == Kind::enumeration ? 32 : r != nullptr ? r->bits : 64;
}

const Type& innermost(const Type& type) { return type.kind == Kind::array ? innermost(*type.element) : type; }

bool has_bytes(const Type& type) {
  if (type.kind == Kind::string) return !type.wide;
  return !type.ranged && (is_integer(type.kind) || is_bits(type.kind) || is_real(type.kind));
}

std::uint64_t bytes_of(const Type& type) {
  switch (type.kind) {
    case Kind::array:
      return type.cells / std::max<std::uint32_t>(type.element->cells, 1) * bytes_of(*type.element);
    case Kind::structure: {
      std::uint64_t bytes = 0;
      for (const auto& field : type.fields) bytes += bytes_of(*field.type);
      return bytes;
    }
    case Kind::string:
      return (type.wide ? 2u : 1u) * std::uint64_t{type.length + 1};
    case Kind::block:
      return 8 * std::uint64_t{type.cells};
    case Kind::time:
    case Kind::date:
    case Kind::tod:
    case Kind::dt:
    case Kind::interface_:
    case Kind::reference:
    case Kind::pointer:
      return 4;
    default:
      return static_cast<std::uint64_t>(std::max(bits(type.kind) / 8, 1));
  }
}

std::uint16_t cell_form(Kind kind) {
  return static_cast<std::uint16_t>(bits(kind) + (is_signed(kind) ? 128 : 0));
}

bool fits(const Type& type, std::int64_t value, bool is_large_unsigned) {
  if (type.ranged) return !is_large_unsigned && value >= type.low && value <= type.high;
  const int width = bits(type.kind);
  if (is_large_unsigned) return !is_signed(type.kind) && width == 64;
  if (is_signed(type.kind)) {
    if (width == 64) return true;
    const auto limit = std::int64_t{1} << (width - 1);
    return value >= -limit && value < limit;
  }
  return value >= 0 && (width == 64 || value < (std::int64_t{1} << width));
}

std::string limits_text(const Type& type) {
  if (type.ranged) return std::to_string(type.low) + " .. " + std::to_string(type.high);
  const int width = bits(type.kind);
  if (is_signed(type.kind)) {
    const auto top = static_cast<std::int64_t>((std::uint64_t{1} << (width - 1)) - 1);
    return std::to_string(-top - 1) + " .. " + std::to_string(top);
  }
  return "0 .. " + std::to_string(width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1);
}

bool same_type(const Type& a, const Type& b) {
  if (&a == &b) return true;
  if (a.kind != b.kind) return false;
  if (a.kind < Kind::string) return true;
  if (a.kind == Kind::string) return a.length == b.length && a.wide == b.wide;
  if (a.kind == Kind::array) {
    const auto equal = [](const Dimension& x, const Dimension& y) {
      return x.low == y.low && x.high == y.high;
    };
    return a.open == b.open && a.dimensions.size() == b.dimensions.size() &&
           std::equal(a.dimensions.begin(), a.dimensions.end(), b.dimensions.begin(), equal) &&
           same_limited_type(*a.element, *b.element);
  }
  // A type with an initial value of its own is the same type.
  const auto named = [](const auto& x, const auto& y) { return x.name == y.name; };
  // Structures without a name of their own all have the same one.
  const auto same_field = [](const Field& x, const Field& y) {
    return x.name == y.name && same_limited_type(*x.type, *y.type);
  };
  if (a.kind == Kind::structure)
    return a.name == b.name &&
           std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(), same_field);
  if (a.kind == Kind::enumeration)
    return a.name == b.name && std::equal(a.enumerators.begin(), a.enumerators.end(), b.enumerators.begin(),
                                          b.enumerators.end(), named);
  if (a.kind == Kind::reference || a.kind == Kind::pointer)
    return a.element != nullptr && b.element != nullptr && same_limited_type(*a.element, *b.element);
  if (a.kind == Kind::interface_) return a.interface == b.interface;
  return a.kind == Kind::block && a.block == b.block;
}

bool same_limited_type(const Type& a, const Type& b) {
  return same_type(a, b) && a.ranged == b.ranged && a.low == b.low && a.high == b.high;
}

bool fits_parameter(const Type& value, const Type& parameter) {
  if (parameter.open)
    return value.kind == Kind::array && value.dimensions.size() == parameter.dimensions.size() &&
           fits_parameter(*value.element, *parameter.element) &&
           value.element->low == parameter.element->low && value.element->high == parameter.element->high;
  return same_type(value, parameter) && value.ranged == parameter.ranged;
}

bool widens(const Type& from, const Type& to) {
  if (same_type(from, to)) return true;
  if (from.kind == Kind::string && to.kind == Kind::string) return from.wide == to.wide;
  return from.kind < Kind::string && to.kind < Kind::string && reaches(from.kind, to.kind);
}

const Type* common_type(const Type& a, const Type& b) {
  if (same_type(a, b)) return a.kind < Kind::string ? elementary(a.kind) : &a;
  if (a.kind >= Kind::string || b.kind >= Kind::string) return nullptr;
  if (reaches(a.kind, b.kind)) return elementary(b.kind);
  if (reaches(b.kind, a.kind)) return elementary(a.kind);
  // In the order of the table the smallest type comes first within each family.
  for (const auto& r : type_rows)
    if (r.kind < Kind::string && reaches(a.kind, r.kind) && reaches(b.kind, r.kind))
      return elementary(r.kind);
  return nullptr;
}

}  // namespace trunnion::st
