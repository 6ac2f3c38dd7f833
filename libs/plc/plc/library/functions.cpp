// SPDX-License-Identifier: Apache-2.0
#include "plc/library/functions.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "plc/semantics/type.hpp"

namespace trunnion::st {
namespace {

using enum FunctionGroup;
constexpr int many = 100;
constexpr std::array rows = std::to_array<FunctionRow>({
    {"ABS", absolute, 1, 1, "IN", "absolute value"},
    {"SQRT", math, 1, 1, "IN", "square root"},
    {"LN", math, 1, 1, "IN", "natural logarithm"},
    {"LOG", math, 1, 1, "IN", "logarithm to base 10"},
    {"EXP", math, 1, 1, "IN", "e to the power of IN"},
    {"SIN", math, 1, 1, "IN", "sine, IN in radians"},
    {"COS", math, 1, 1, "IN", "cosine, IN in radians"},
    {"TAN", math, 1, 1, "IN", "tangent, IN in radians"},
    {"ASIN", math, 1, 1, "IN", "arc sine in radians"},
    {"ACOS", math, 1, 1, "IN", "arc cosine in radians"},
    {"ATAN", math, 1, 1, "IN", "arc tangent in radians"},
    {"ATAN2", math, 2, 2, "Y X", "angle of the vector (X, Y) in radians"},
    {"FLOOR", math, 1, 1, "IN", "largest whole number not above IN"},
    {"CEIL", math, 1, 1, "IN", "smallest whole number not below IN"},
    {"EXPT", arithmetic, 2, 2, "IN1 IN2", "IN1 to the power of IN2"},
    {"ADD", arithmetic, 2, many, "", "sum"},
    {"MUL", arithmetic, 2, many, "", "product"},
    {"SUB", arithmetic, 2, 2, "IN1 IN2", "difference"},
    {"DIV", arithmetic, 2, 2, "IN1 IN2", "quotient"},
    {"GT", comparison, 2, many, "", "IN1 > IN2 > ..."},
    {"GE", comparison, 2, many, "", "IN1 >= IN2 >= ..."},
    {"EQ", comparison, 2, many, "", "all are equal"},
    {"LE", comparison, 2, many, "", "IN1 <= IN2 <= ..."},
    {"LT", comparison, 2, many, "", "IN1 < IN2 < ..."},
    {"NE", comparison, 2, 2, "IN1 IN2", "not equal"},
    {"SHL", shift, 2, 2, "IN N", "IN shifted left by N bits"},
    {"SHR", shift, 2, 2, "IN N", "IN shifted right by N bits"},
    {"ROL", shift, 2, 2, "IN N", "IN rotated left by N bits"},
    {"ROR", shift, 2, 2, "IN N", "IN rotated right by N bits"},
    {"SEL", selection, 3, 3, "G IN0 IN1", "IN1 when G, otherwise IN0"},
    {"MAX", selection, 2, many, "", "the largest"},
    {"MIN", selection, 2, many, "", "the smallest"},
    {"LIMIT", selection, 3, 3, "MN IN MX", "IN, but at least MN and at most MX"},
    {"MUX", selection, 2, many, "", "argument number K of those behind it, from 0; the last one beyond"},
    {"MOVE", move, 1, 1, "IN", "the value"},
    {"MOV", ladder, 1, 1, "S", "the value; with D it is written there"},
    {"DISAS", ladder, 3, 3, "N D S", "N bytes of S, the low one first, into N registers from D on"},
    {"LEN", string, 1, 1, "IN", "length of the string, in bytes or, of WSTRING, characters"},
    {"LEFT", string, 2, 2, "IN L", "the first L"},
    {"RIGHT", string, 2, 2, "IN L", "the last L"},
    {"MID", string, 3, 3, "IN L P", "L from position P"},
    {"CONCAT", string, 2, many, "", "the strings one after the other"},
    {"INSERT", string, 3, 3, "IN1 IN2 P", "IN2 inserted into IN1 behind position P"},
    {"DELETE", string, 3, 3, "IN L P", "IN without L from position P"},
    {"REPLACE", string, 4, 4, "IN1 IN2 L P", "IN1 with L from position P replaced by IN2"},
    {"FIND", string, 2, 2, "IN1 IN2", "position of IN2 in IN1, 0 when it is not there"},
    {"ADD_TIME", time, 2, 2, "IN1 IN2", "sum of two TIME"},
    {"ADD_TOD_TIME", time, 2, 2, "IN1 IN2", "TIME_OF_DAY and TIME"},
    {"ADD_DT_TIME", time, 2, 2, "IN1 IN2", "DATE_AND_TIME and TIME"},
    {"SUB_TIME", time, 2, 2, "IN1 IN2", "difference of two TIME"},
    {"SUB_DATE_DATE", time, 2, 2, "IN1 IN2", "TIME between two dates"},
    {"SUB_TOD_TIME", time, 2, 2, "IN1 IN2", "TIME_OF_DAY before"},
    {"SUB_TOD_TOD", time, 2, 2, "IN1 IN2", "TIME between"},
    {"SUB_DT_TIME", time, 2, 2, "IN1 IN2", "DATE_AND_TIME before"},
    {"SUB_DT_DT", time, 2, 2, "IN1 IN2", "TIME between"},
    {"MUL_TIME", time, 2, 2, "IN1 IN2", "TIME times a number"},
    {"DIV_TIME", time, 2, 2, "IN1 IN2", "TIME divided by a number"},
    {"ADD_LTIME", time, 2, 2, "IN1 IN2", "sum of two LTIME"},
    {"SUB_LTIME", time, 2, 2, "IN1 IN2", "difference of two LTIME"},
    {"MUL_LTIME", time, 2, 2, "IN1 IN2", "LTIME times a number"},
    {"DIV_LTIME", time, 2, 2, "IN1 IN2", "LTIME divided by a number"},
    {"ADD_LTOD_LTIME", time, 2, 2, "IN1 IN2", "as ADD_TOD_TIME"},
    {"ADD_LDT_LTIME", time, 2, 2, "IN1 IN2", "as ADD_DT_TIME"},
    {"SUB_LDATE_LDATE", time, 2, 2, "IN1 IN2", "as SUB_DATE_DATE"},
    {"SUB_LTOD_LTIME", time, 2, 2, "IN1 IN2", "as SUB_TOD_TIME"},
    {"SUB_LTOD_LTOD", time, 2, 2, "IN1 IN2", "as SUB_TOD_TOD"},
    {"SUB_LDT_LTIME", time, 2, 2, "IN1 IN2", "as SUB_DT_TIME"},
    {"SUB_LDT_LDT", time, 2, 2, "IN1 IN2", "as SUB_DT_DT"},
    {"TO_BIG_ENDIAN", order_of_bytes, 1, 1, "IN", "the bytes in reverse order"},
    {"TO_LITTLE_ENDIAN", order_of_bytes, 1, 1, "IN", "the bytes in their order"},
    {"FROM_BIG_ENDIAN", order_of_bytes, 1, 1, "IN", "the bytes in reverse order"},
    {"FROM_LITTLE_ENDIAN", order_of_bytes, 1, 1, "IN", "the bytes in their order"},
    {"IS_VALID", validation, 1, 1, "IN", "IN is neither infinite nor NaN"},
    {"IS_VALID_BCD", validation, 1, 1, "IN", "every four bits of IN are a decimal digit"},
    {"PLC_TIME", clock, 0, 0, "", "LTIME for which the PLC has run, the same within one scan"},
    {"ASSERT_TRUE", test, 1, 1, "IN", "the test fails unless IN"},
    {"ASSERT_FALSE", test, 1, 1, "IN", "the test fails when IN"},
    {"ASSERT_EQ", test, 2, 2, "ACTUAL EXPECTED", "the test fails unless both are equal"},
    {"ASSERT_NEAR", test, 3, 3, "ACTUAL EXPECTED TOLERANCE",
     "the test fails when they differ by more than TOLERANCE"},
    {"ADVANCE", test, 1, 1, "IN", "time of the PLC passes"},
});

}  // namespace

std::span<const FunctionRow> standard_functions() { return rows; }

const FunctionRow* find_function(std::string_view upper) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == upper; });
  return found == rows.end() ? nullptr : &*found;
}

std::optional<ConversionName> conversion_name(const std::string& upper,
                                              const std::function<bool(const std::string&)>& is_type) {
  using enum ConversionKind;
  if (upper == "TRUNC") return ConversionName{truncation, "", "DINT"};
  // The name of a type may contain these words too.
  for (const auto& [word, kind] : {std::pair{std::string("BCD_TO_"), from_bcd},
                                   {"TO_BCD_", to_bcd},
                                   {"TRUNC_", truncation},
                                   {"TO_", plain}})
    for (auto at = upper.find(word); at != std::string::npos; at = upper.find(word, at + 1)) {
      if (at > 0 && upper[at - 1] != '_') continue;
      ConversionName result{kind, at == 0 ? "" : upper.substr(0, at - 1), upper.substr(at + word.size())};
      if ((at == 0 || is_type(result.from)) && is_type(result.to)) return result;
    }
  return std::nullopt;
}

bool is_replaceable_function(const std::string& upper) {
  constexpr auto names = std::to_array<std::string_view>({"ATAN2", "FLOOR", "CEIL", "DAY_OF_WEEK"});
  return std::ranges::count(names, upper) > 0;
}

bool is_standard_function(const std::string& upper) {
  constexpr auto operators = std::to_array<std::string_view>({"NOT", "AND", "OR", "XOR", "MOD"});
  return find_function(upper) != nullptr || std::ranges::count(operators, upper) > 0 ||
         conversion_name(upper, [](const std::string& name) {
           return name == "STRING" || name == "WSTRING" || elementary(name) != nullptr;
         });
}

}  // namespace trunnion::st
