// SPDX-License-Identifier: Apache-2.0
#include "plc/library/derived_units.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "plc/library/functions.hpp"

namespace trunnion::st {
namespace {

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The text of a function or block of the library in the same lines.
std::string text_of_unit(const std::string& keyword, const std::string& name) {
  const std::string_view all = standard_blocks_text;
  const auto begin = std::min(all.find(keyword + " " + name + "\n"), all.find(keyword + " " + name + " "));
  const std::string end = "END_" + keyword + "\n";
  const auto lines = std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
  return std::string(static_cast<std::size_t>(lines), '\n') +
         std::string(all.substr(begin, all.find(end, begin) + end.size() - begin));
}

/// The block with another type in the place of `type`.
std::string typed_block(const std::string& name, const std::string& type, const std::string& other) {
  auto text = text_of_unit("FUNCTION_BLOCK", name);
  replace_all(text, name + "\n", name + "_" + other + "\n");
  replace_all(text, ": " + type + ";", ": " + other + ";");
  replace_all(text, "_TO_" + type + "(", "_TO_" + other + "(");
  return text;
}

/// The function with another name.
std::string renamed_function(const std::string& name, const std::string& other) {
  auto text = text_of_unit("FUNCTION", name);
  replace_all(text, name, other);
  return text;
}

}  // namespace

const std::vector<std::string>& derived_units() {
  static const auto units = [] {
    std::vector<std::string> result;
    for (const auto* name : {"CTU", "CTD", "CTUD"})
      for (const auto& [type, low, high] : {std::tuple{"INT", "-32768", "32767"},
                                            {"DINT", "-2147483648", "2147483647"},
                                            {"LINT", "-9223372036854775808", "9223372036854775807"},
                                            {"UDINT", "0", "4294967295"},
                                            {"ULINT", "0", "18446744073709551615"}}) {
        auto text = typed_block(name, "INT", type);
        replace_all(text, "-32768", low);
        replace_all(text, "32767", high);
        result.push_back(std::move(text));
      }
    for (const auto* name : {"TON", "TOF", "TP"})
      for (const auto* type : {"TIME", "LTIME"}) result.push_back(typed_block(name, "TIME", type));
    for (const auto& [name, other] : {std::pair{"CONCAT_DATE", "CONCAT_LDATE"},
                                      {"CONCAT_TOD", "CONCAT_LTOD"},
                                      {"CONCAT_DT", "CONCAT_LDT"},
                                      {"CONCAT_DATE_TOD", "CONCAT_DATE_LTOD"},
                                      {"SPLIT_DATE", "SPLIT_LDATE"},
                                      {"SPLIT_TOD", "SPLIT_LTOD"},
                                      {"SPLIT_DT", "SPLIT_LDT"}})
      result.push_back(renamed_function(name, other));
    return result;
  }();
  return units;
}

}  // namespace trunnion::st
