// SPDX-License-Identifier: Apache-2.0
#include "plc/instruction_list/symbols.hpp"

#include <stdexcept>

#include "plc/library/register_names.hpp"

namespace trunnion::il {

std::optional<st::RegisterAddress> parse_address(std::string_view text) {
  const bool percent = text.starts_with('%');
  if (percent) text.remove_prefix(1);
  // Not the names of the standard. Without percent sign T1 or D2 may be a name of the program.
  const std::string_view letters = percent ? "XYFGRBWDTCKP" : "XYFGRB";
  if (text.empty() || letters.find(text[0]) == std::string_view::npos) return std::nullopt;
  return st::parse_register(text, nullptr);
}

const Symbols& interface_symbols() {
  static const Symbols symbols = [] {
    Symbols result;
    for (const auto& one : st::register_table()) result[one.name] = one.address;
    return result;
  }();
  return symbols;
}

st::RegisterAddress interface_address(const std::string& name) {
  const auto found = interface_symbols().find(name);
  if (found == interface_symbols().end()) throw std::out_of_range("unknown register " + name);
  return found->second;
}

st::RegisterAddress interface_address(const std::string& name, std::size_t index) {
  return interface_address(name + "_" + std::to_string(index));
}

}  // namespace trunnion::il
