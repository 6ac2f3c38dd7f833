// SPDX-License-Identifier: Apache-2.0
// X_TO_Y of all pairs of types, and TRUNC, with values at the limits, against the rules of docs/plc.md in
// C++.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "translated.hpp"

namespace trunnion::st {
namespace {

enum class Family { whole, bits, real, time };

struct Converted {
  const char* name;
  Family family;
  int bits;
  bool is_signed;
  std::int64_t unit;  ///< of times: ns of the number 1
};
constexpr Converted all_types[] = {
    {"SINT", Family::whole, 8, true, 0},    {"INT", Family::whole, 16, true, 0},
    {"DINT", Family::whole, 32, true, 0},   {"LINT", Family::whole, 64, true, 0},
    {"USINT", Family::whole, 8, false, 0},  {"UINT", Family::whole, 16, false, 0},
    {"UDINT", Family::whole, 32, false, 0}, {"ULINT", Family::whole, 64, false, 0},
    {"BOOL", Family::bits, 1, false, 0},    {"BYTE", Family::bits, 8, false, 0},
    {"WORD", Family::bits, 16, false, 0},   {"DWORD", Family::bits, 32, false, 0},
    {"LWORD", Family::bits, 64, false, 0},  {"REAL", Family::real, 32, true, 0},
    {"LREAL", Family::real, 64, true, 0},   {"TIME", Family::time, 64, true, 1000000},
    {"LTIME", Family::time, 64, true, 1}};

bool is_number(const Converted& type) { return type.family == Family::whole || type.bits == 1; }
bool is_boolean(const Converted& type) { return type.bits == 1; }

/// The cell of the number modulo 2 ** bits.
std::uint64_t cell_modulo(const Converted& type, std::uint64_t value) {
  if (type.bits == 64) return value;
  const auto size = std::uint64_t{1} << type.bits;
  const auto rest = value % size;
  return type.is_signed && rest >= size / 2 ? rest - size : rest;
}

double real_of(const Converted& type, std::uint64_t cell) {
  return type.bits == 32 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(cell)))
                         : std::bit_cast<double>(cell);
}

/// The whole number nearest to the value within the range; long double has 64 bits of them.
std::uint64_t nearest(const Converted& type, double value, bool truncates) {
  if (std::isnan(value)) return 0;
  const long double whole = truncates ? std::trunc(value) : std::rint(value);
  const long double high = std::ldexp(1.0L, type.is_signed ? type.bits - 1 : type.bits) - 1;
  const long double low = type.is_signed ? -high - 1 : 0;
  const long double within = std::min(std::max(whole, low), high);
  return within < 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(within))
                    : static_cast<std::uint64_t>(within);
}

/// Nothing: there is no such conversion.
std::optional<std::uint64_t> converted_cell(const Converted& from, const Converted& to, std::uint64_t cell,
                                            bool truncates = false) {
  const auto of_real = [&](double value) {
    return to.bits == 32 ? std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(value))}
                         : std::bit_cast<std::uint64_t>(value);
  };
  if (from.family == Family::real) {
    const double value = real_of(from, cell);
    if (truncates && to.family != Family::whole) return std::nullopt;
    if (is_boolean(to)) return value != 0;
    if (to.family == Family::whole) return nearest(to, value, truncates);
    if (to.family == Family::time) return nearest(to, value * static_cast<double>(to.unit), false);
    if (to.family == Family::bits) return from.bits == to.bits ? std::optional(cell) : std::nullopt;
    return of_real(value);
  }
  if (truncates) return std::nullopt;
  if (is_boolean(to)) return cell != 0;
  if (from.family == Family::time) {
    const auto time = static_cast<std::int64_t>(cell);
    if (to.family == Family::time) return cell;
    if (to.family == Family::real) return of_real(static_cast<double>(time) / static_cast<double>(from.unit));
    return cell_modulo(to, static_cast<std::uint64_t>(time / from.unit));
  }
  if (to.family == Family::time) return cell * static_cast<std::uint64_t>(to.unit);
  if (to.family != Family::real) return cell_modulo(to, cell);
  if (!is_number(from)) return from.bits == to.bits ? std::optional(cell) : std::nullopt;
  // Rounded once, to the type itself.
  if (to.bits == 32)
    return std::bit_cast<std::uint32_t>(from.is_signed ? static_cast<float>(static_cast<std::int64_t>(cell))
                                                       : static_cast<float>(cell));
  return std::bit_cast<std::uint64_t>(from.is_signed ? static_cast<double>(static_cast<std::int64_t>(cell))
                                                     : static_cast<double>(cell));
}

std::vector<std::uint64_t> values_at_limits(const Converted& type) {
  std::vector<std::uint64_t> result;
  if (type.family == Family::real) {
    const double infinite = std::numeric_limits<double>::infinity();
    std::vector<double> values = {0,       0.25,         0.5,          1.5,    2.5,    0.4999999, 1e6,
                                  1e-40,   1e10,         1e25,         3e38,   127.5,  255.5,     32767.5,
                                  65535.5, 2147483647.5, 4294967295.5, 9.3e18, 1.9e19, 9.3e12,    infinite};
    for (int bits : {7, 8, 15, 16, 31, 32, 53, 63, 64})
      for (const double near :
           {std::ldexp(1, bits), std::nextafter(std::ldexp(1, bits), 0), std::ldexp(1, bits) - 1})
        values.push_back(near);
    for (const double value : values)
      for (const double both : {value, -value})
        result.push_back(type.bits == 32
                             ? std::uint64_t{std::bit_cast<std::uint32_t>(static_cast<float>(both))}
                             : std::bit_cast<std::uint64_t>(both));
    result.push_back(type.bits == 32 ? 0x7FC00000u : 0x7FF8000000000000u);  // NaN
    return result;
  }
  for (int bits : {0, 1, 7, 8, 15, 16, 20, 24, 31, 32, 53, 62, 63})
    for (const int offset : {0, 1, -1, 3})
      for (const int sign : {1, -1})
        result.push_back(
            cell_modulo(type, static_cast<std::uint64_t>(sign) *
                                  ((std::uint64_t{1} << bits) + static_cast<std::uint64_t>(offset))));
  for (const int ns : {499999, 500000, 999999, 1000001, 1500000})
    for (const int sign : {1, -1}) result.push_back(cell_modulo(type, static_cast<std::uint64_t>(sign * ns)));
  return result;
}

std::uint32_t address_of(const Compilation& compilation, const std::string& path) {
  for (const auto& symbol : compilation.symbols)
    if (symbol.path == path) return symbol.address;
  throw std::runtime_error(path);
}

// `call`: the name of the conversion, with the types for X and Y.
void check_all_pairs(const std::string& call, bool truncates, int expected_pairs) {
  const auto name_of = [&](const Converted& from, const Converted& to) {
    auto name = call;
    name.replace(name.find('Y'), 1, to.name);
    if (name.starts_with('X')) name.replace(0, 1, from.name);
    return name;
  };
  int pairs = 0;
  for (const auto& from : all_types) {
    std::string declarations = std::string("VAR x : ") + from.name + "; ", statements;
    std::vector<const Converted*> targets;
    for (const auto& to : all_types) {
      const auto variable = "y_" + std::string(to.name);
      const auto statement = variable + " := " + name_of(from, to) + "(x);\n";
      if (converted_cell(from, to, 0, truncates)) {
        declarations += variable + " : " + to.name + "; ";
        statements += statement;
        targets.push_back(&to);
        continue;
      }
      const auto refused =
          compile({{"t.st", "PROGRAM main VAR x : " + std::string(from.name) + "; " + variable + " : " +
                                to.name + "; END_VAR\n" + statement + "END_PROGRAM\n"}},
                  interface_registers());
      EXPECT_FALSE(refused.good()) << statement;
    }
    if (targets.empty()) continue;
    pairs += static_cast<int>(targets.size());
    Translated program(declarations + "END_VAR", statements);
    const auto memory = program.run.machine().memory();
    for (const auto cell : values_at_limits(from)) {
      memory[address_of(program.compilation, "main.x")] = cell;
      ASSERT_EQ(program.scan(), "");
      for (const auto* to : targets)
        EXPECT_EQ(memory[address_of(program.compilation, "main.y_" + std::string(to->name))],
                  *converted_cell(from, *to, cell, truncates))
            << name_of(from, *to) << " of the cell " << cell;
    }
  }
  EXPECT_EQ(pairs, expected_pairs);
}

// Of 17 * 17 pairs REAL and LREAL with BYTE, WORD and the longer or shorter bit string, both ways, do not
// exist.
TEST(Conversions, OfAllPairsOfTypesFollowTheirRules) {
  check_all_pairs("X_TO_Y", false, 17 * 17 - 2 * 2 * 3);
}

TEST(Conversions, WithoutTheTypeOfTheArgumentAreTheSame) {
  check_all_pairs("TO_Y", false, 17 * 17 - 2 * 2 * 3);
}

TEST(Conversions, TruncateTowardsZeroToEveryInteger) {
  check_all_pairs("X_TRUNC_Y", true, 2 * 8);
  check_all_pairs("TRUNC_Y", true, 2 * 8);
}

}  // namespace
}  // namespace trunnion::st
