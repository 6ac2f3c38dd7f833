// SPDX-License-Identifier: Apache-2.0
// Random expressions against an oracle of exact integers and IEEE 754: every integer width, mixed widths, bit
// strings, REAL and LREAL to the bit.
#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "translated.hpp"

namespace trunnion::st {
namespace {

struct Format {
  const char* name;
  int bits;
  bool is_signed;
};
constexpr Format integers[] = {{"SINT", 8, true},    {"INT", 16, true},   {"DINT", 32, true},
                               {"LINT", 64, true},   {"USINT", 8, false}, {"UINT", 16, false},
                               {"UDINT", 32, false}, {"ULINT", 64, false}};

using Wide = __int128;

/// The rule of overflow: the value modulo 2 ** bits, in the range of the format.
Wide wrapped(Wide value, const Format& format) {
  const Wide size = Wide{1} << format.bits;
  Wide rest = value % size;
  if (rest < 0) rest += size;
  return format.is_signed && rest >= size / 2 ? rest - size : rest;
}

std::uint64_t cell_of_integer(Wide value) { return static_cast<std::uint64_t>(value); }

/// The smallest format that has all values of both; nothing for ULINT beside a signed one.
std::optional<Format> common(const Format& a, const Format& b) {
  if (a.is_signed == b.is_signed) return a.bits >= b.bits ? a : b;
  const auto& s = a.is_signed ? a : b;
  const auto& u = a.is_signed ? b : a;
  for (const auto& format : integers)
    if (format.is_signed && format.bits >= s.bits && format.bits > u.bits) return format;
  return std::nullopt;
}

struct Result {
  Format format;
  std::string text;
  std::optional<Wide> value;  ///< nothing: division by zero
};

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {
    for (const auto& format : integers)
      for (int i = 0; i < 3; ++i)
        values_.push_back({format, std::string(format.name) + "_" + std::to_string(i), value(format)});
  }
  std::size_t below(std::size_t count) { return random_() % count; }

  /// Corners often: limits, 0, 1, -1.
  Wide value(const Format& format) {
    const Wide corners[] = {0, 1, -1, Wide{1} << (format.bits - 1), (Wide{1} << (format.bits - 1)) - 1, 2};
    const auto choice = below(10);
    return wrapped(choice < 6 ? corners[choice] : static_cast<Wide>(random_()), format);
  }

  Result leaf(const Format* wanted) {
    for (;;) {
      const auto& variable = values_[below(values_.size())];
      if (wanted == nullptr || std::string(wanted->name) == variable.format.name) return variable;
    }
  }

  /// `wanted`: every operand has this format; otherwise they are mixed.
  Result expression(int depth, const Format* wanted) {
    if (depth == 0 || below(6) == 0) return leaf(wanted);
    if (below(8) == 0) {
      auto inner = expression(depth - 1, wanted);
      if (!inner.format.is_signed) return inner;
      inner.text = "(-" + inner.text + ")";
      if (inner.value) inner.value = wrapped(-*inner.value, inner.format);
      return inner;
    }
    auto left = expression(depth - 1, wanted), right = expression(depth - 1, wanted);
    const auto format = common(left.format, right.format);
    if (!format) return left;
    constexpr const char* operators[] = {"+", "-", "*", "/", "MOD"};
    const std::string op = operators[below(5)];
    Result result{*format, "(" + left.text + " " + op + " " + right.text + ")", std::nullopt};
    if (!left.value || !right.value) return result;
    const Wide a = *left.value, b = *right.value;
    if (op == "/" && b == 0) return result;
    // Products of two 64-bit numbers fit into 128 bits but for their sign: modulo 2 ** 64 that does not
    // count.
    const Wide exact =
        op == "+"   ? a + b
        : op == "-" ? a - b
        : op == "*" ? static_cast<Wide>(static_cast<unsigned __int128>(a) * static_cast<unsigned __int128>(b))
        : op == "/" ? a / b
        : b == 0    ? 0
                    : a % b;
    result.value = wrapped(exact, *format);
    return result;
  }

  const std::vector<Result>& values() const { return values_; }

 private:
  std::mt19937_64 random_;
  std::vector<Result> values_;
};

const Symbol& symbol(const Compilation& compilation, const std::string& name) {
  for (const auto& found : compilation.symbols)
    if (found.path == "main." + name) return found;
  throw std::runtime_error(name);
}

// Each seed is a program of 60 expressions; the values of a division by zero are not compared, the fault is.
void check_integers(std::uint64_t seed, bool mixed) {
  Generator generator(seed);
  std::string declarations = "VAR ";
  for (const auto& v : generator.values()) declarations += v.text + " : " + v.format.name + "; ";
  std::vector<Result> results;
  std::string statements;
  for (int i = 0; i < 60; ++i) {
    const auto& format = integers[generator.below(std::size(integers))];
    auto result = generator.expression(4, mixed ? nullptr : &format);
    const auto name = "r" + std::to_string(results.size());
    declarations += name + " : " + result.format.name + "; ";
    statements +=
        "IF run = " + std::to_string(results.size()) + " THEN " + name + " := " + result.text + "; END_IF;\n";
    results.push_back(result);
  }
  declarations += "run : INT; END_VAR";
  Translated program(declarations, statements);
  auto memory = program.run.machine().memory();
  for (const auto& v : generator.values())
    memory[symbol(program.compilation, v.text).address] = cell_of_integer(*v.value);
  for (std::size_t i = 0; i < results.size(); ++i) {
    memory[symbol(program.compilation, "run").address] = i;
    const auto fault = program.scan();
    ASSERT_EQ(fault.find("division by zero") != std::string::npos, !results[i].value)
        << results[i].text << " " << fault;
    if (results[i].value) {
      ASSERT_EQ(memory[symbol(program.compilation, "r" + std::to_string(i)).address],
                cell_of_integer(*results[i].value))
          << "seed " << seed << ": " << results[i].text;
    }
  }
}

TEST(Expressions, OfEachIntegerTypeWrapAround) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) check_integers(seed, false);
}

TEST(Expressions, OfMixedIntegerTypesHaveTheSmallestTypeWithAllValuesOfBoth) {
  for (std::uint64_t seed = 1000; seed <= 1060; ++seed) check_integers(seed, true);
}

template <class Float>
struct Real {
  std::string text;
  Float value;
};

template <class Float>
void check_reals(std::uint64_t seed, const char* type) {
  std::mt19937_64 random(seed);
  const auto any = [&]() -> Float {
    switch (random() % 6) {
      case 0:
        return Float(0.1);
      case 1:
        return Float(-3);
      case 2:
        return static_cast<Float>(
            std::ldexp(static_cast<double>(random() % 1000000), static_cast<int>(random() % 60) - 30));
      case 3:
        return Float(0);
      default:
        return -static_cast<Float>(static_cast<double>(random()) / 1e10);
    }
  };
  std::vector<Real<Float>> variables;
  for (int i = 0; i < 8; ++i) variables.push_back({"v" + std::to_string(i), any()});
  std::function<Real<Float>(int)> expression = [&](int depth) -> Real<Float> {
    if (depth == 0) {
      if (random() % 5 == 0) return {"0.3", Float(0.3)};
      if (random() % 8 == 0) return {"INT#7", Float(7)};
      return variables[random() % variables.size()];
    }
    const auto a = expression(depth - 1), b = expression(depth - 1);
    switch (random() % 6) {
      case 0:
        return {"(" + a.text + " + " + b.text + ")", a.value + b.value};
      case 1:
        return {"(" + a.text + " - " + b.text + ")", a.value - b.value};
      case 2:
        return {"(" + a.text + " * " + b.text + ")", a.value * b.value};
      case 3:
        return {"(" + a.text + " / " + b.text + ")", a.value / b.value};
      case 4:
        return {"SQRT(ABS(" + a.text + " + v0))", std::sqrt(std::abs(a.value + variables[0].value))};
      default:
        return {"MAX(v1, " + a.text + ")", a.value > variables[1].value ? a.value : variables[1].value};
    }
  };
  std::string declarations = "VAR ", statements;
  std::vector<Real<Float>> results;
  for (const auto& v : variables) declarations += v.text + " : " + type + "; ";
  for (int i = 0; i < 40; ++i) {
    auto result = expression(3);
    // Literals alone are of LREAL, and integers alone are divided as integers: with a variable first they are
    // not.
    result.text = "v2 + " + result.text;
    result.value = variables[2].value + result.value;
    declarations += "r" + std::to_string(i) + " : " + type + "; ";
    statements += "r" + std::to_string(i) + " := " + result.text + ";\n";
    results.push_back(result);
  }
  const auto has_constant_part = [](const std::string& text) {
    // "(0.3 op INT#7)" and its like are folded by other rules.
    for (const char* pair :
         {"(0.3 + 0.3", "(0.3 - 0.3", "(0.3 * 0.3", "(0.3 / 0.3", "INT#7 + 0.3", "INT#7 - 0.3", "INT#7 * 0.3",
          "INT#7 / 0.3", "0.3 + INT#7", "0.3 - INT#7", "0.3 * INT#7", "0.3 / INT#7", "INT#7 + INT#7",
          "INT#7 - INT#7", "INT#7 * INT#7", "INT#7 / INT#7"})
      if (text.find(pair) != std::string::npos) return true;
    return false;
  };
  Translated program(declarations + "END_VAR", statements);
  auto memory = program.run.machine().memory();
  const auto cell = [](Float value) -> std::uint64_t {
    if constexpr (sizeof(Float) == 4)
      return std::bit_cast<std::uint32_t>(value);
    else
      return std::bit_cast<std::uint64_t>(value);
  };
  for (const auto& v : variables) memory[symbol(program.compilation, v.text).address] = cell(v.value);
  ASSERT_EQ(program.scan(), "");
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (has_constant_part(results[i].text)) continue;
    const auto found = memory[symbol(program.compilation, "r" + std::to_string(i)).address];
    // The sign and payload of a NaN are the processor's.
    Float value{};
    if constexpr (sizeof(Float) == 4)
      value = std::bit_cast<float>(static_cast<std::uint32_t>(found));
    else
      value = std::bit_cast<double>(found);
    if (std::isnan(results[i].value) && std::isnan(value)) continue;
    ASSERT_EQ(found, cell(results[i].value)) << "seed " << seed << ": " << results[i].text;
  }
}

TEST(Expressions, OfRealAreExactToTheBit) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) check_reals<float>(seed, "REAL");
}

TEST(Expressions, OfLrealAreExactToTheBit) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) check_reals<double>(seed, "LREAL");
}

TEST(Expressions, OfBitStringsKeepTheirWidth) {
  struct Bits {
    const char* name;
    int bits;
  };
  std::mt19937_64 random(5);
  for (int round = 0; round < 60; ++round)
    for (const auto& [name, bits] :
         {Bits{"BYTE", 8}, Bits{"WORD", 16}, Bits{"DWORD", 32}, Bits{"LWORD", 64}}) {
      const auto mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
      const auto a = random() & mask, b = random() & mask;
      const auto n = random() % static_cast<unsigned>(bits + 4);
      const auto r = n % static_cast<unsigned>(bits);
      const auto rotated = [mask, width = static_cast<unsigned>(bits)](std::uint64_t v, std::uint64_t by) {
        return by == 0 ? v : ((v << by) | (v >> (width - by))) & mask;
      };
      Translated program(std::string("VAR a, b, r1, r2, r3, r4, r5, r6 : ") + name + "; n : UINT; END_VAR",
                         "r1 := a AND NOT b XOR (a OR b); r2 := SHL(a, n); r3 := SHR(a, n); r4 := ROL(a, n); "
                         "r5 := ROR(a, n);\n"
                         "r6 := NOT a;");
      auto memory = program.run.machine().memory();
      const auto at = [&](const char* variable) -> std::uint64_t& {
        return memory[symbol(program.compilation, variable).address];
      };
      at("a") = a, at("b") = b, at("n") = n;
      ASSERT_EQ(program.scan(), "");
      ASSERT_EQ(at("r1"), ((a & ~b) ^ (a | b)) & mask);
      ASSERT_EQ(at("r2"), n >= static_cast<unsigned>(bits) ? 0 : (a << n) & mask);
      ASSERT_EQ(at("r3"), n >= static_cast<unsigned>(bits) ? 0 : a >> n);
      ASSERT_EQ(at("r4"), rotated(a, r));
      ASSERT_EQ(at("r5"), rotated(a, (static_cast<unsigned>(bits) - r) % static_cast<unsigned>(bits)));
      ASSERT_EQ(at("r6"), ~a & mask);
    }
}

// What the translator folds and what the machine computes are the same.
TEST(Expressions, OfConstantsAreThoseOfVariables) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 300; ++i) {
    const auto a = static_cast<std::int32_t>(random() % 2001) - 1000,
               b = static_cast<std::int32_t>(random() % 2001) - 1000;
    constexpr const char* operators[] = {"+", "-", "*", "/", "MOD", "<", "<=", "=", "<>", ">", ">="};
    const std::string op = operators[random() % std::size(operators)];
    if (b == 0) continue;
    const bool compares = op.find_first_of("<>=") != std::string::npos;
    const auto literals = std::to_string(a) + " " + op + " " + std::to_string(b);
    Translated program(std::string("VAR a, b : DINT; x, y : ") + (compares ? "BOOL" : "DINT") + "; END_VAR",
                       "x := " + literals + "; y := a " + op + " b;");
    program.set("a", std::to_string(a)), program.set("b", std::to_string(b));
    program.scan();
    ASSERT_EQ(program.get("x"), program.get("y")) << literals;
  }
}

}  // namespace
}  // namespace trunnion::st
