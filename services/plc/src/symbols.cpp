// SPDX-License-Identifier: Apache-2.0
#include "symbols.hpp"

#include <stdexcept>

#include "machine/yaml.hpp"
#include "plc/library/register_names.hpp"

namespace trunnion::plc {

Symbols parse_symbols(const std::string& yaml, const std::string& file) {
  Symbols symbols;
  const auto document = machine::parse_yaml(yaml, file);
  for (const auto& node : document["registers"]) {
    const auto name = node["name"].as<std::string>();
    const auto first = parse_address(node["address"].as<std::string>());
    if (!first) throw std::runtime_error(machine::at(file, node["address"]) + "not an address");
    const int count = node["count"] ? node["count"].as<int>() : 0;
    const auto stride = node["stride"] ? node["stride"].as<std::string>() : "1";
    for (int i = 0; i < (count > 0 ? count : 1); ++i) {
      Address address = *first;
      if (stride == "bit")
        address.bit = static_cast<std::int8_t>(address.bit + i);
      else
        address.index = static_cast<std::uint16_t>(address.index + i * std::stoi(stride));
      if (address.index >= register_count || address.bit >= width(address.area))
        throw std::runtime_error(machine::at(file, node) + "'" + name + "' leaves the image");
      if (!symbols.emplace(count > 0 ? name + "_" + std::to_string(i) : name, address).second)
        throw std::runtime_error(machine::at(file, node) + "'" + name + "' is defined twice");
    }
  }
  return symbols;
}

const Symbols& interface_symbols() {
  static const Symbols symbols = parse_symbols(st::registers_text, "registers.yaml");
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
