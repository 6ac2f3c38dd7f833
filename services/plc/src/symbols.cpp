// SPDX-License-Identifier: Apache-2.0
#include "symbols.hpp"

#include <stdexcept>

#include "plc/library/register_names.hpp"

namespace trunnion::plc {

const Symbols& interface_symbols() {
  static const Symbols symbols = [] {
    Symbols result;
    for (const auto& one : st::register_table())
      result[one.name] = {one.address.area, one.address.index, one.address.bit};
    return result;
  }();
  return symbols;
}

Address interface_address(const std::string& name) {
  const auto found = interface_symbols().find(name);
  if (found == interface_symbols().end()) throw std::out_of_range("unknown register " + name);
  return found->second;
}

Address interface_address(const std::string& name, std::size_t index) {
  return interface_address(name + "_" + std::to_string(index));
}

}  // namespace trunnion::plc
