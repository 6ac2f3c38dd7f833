// SPDX-License-Identifier: Apache-2.0
#include "plc/library/register_names.hpp"

#include <stdexcept>

#include "machine/yaml.hpp"
#include "plc/syntax/token.hpp"

namespace trunnion::st {

RegisterNames parse_register_names(const std::string& yaml, const std::string& file) {
  RegisterNames names;
  const auto document = machine::parse_yaml(yaml, file);
  for (const auto& node : document["registers"]) {
    const auto name = upper_case(node["name"].as<std::string>());
    const auto first = parse_register(node["address"].as<std::string>(), nullptr);
    if (!first) throw std::runtime_error(machine::at(file, node["address"]) + "not an address");
    const int count = node["count"] ? node["count"].as<int>() : 0;
    const auto stride = node["stride"] ? node["stride"].as<std::string>() : "1";
    for (int i = 0; i < (count > 0 ? count : 1); ++i) {
      auto address = *first;
      if (stride == "bit")
        address.bit = static_cast<std::int8_t>(address.bit + i);
      else
        address.index = static_cast<std::uint16_t>(address.index + i * std::stoi(stride));
      names.emplace(count > 0 ? name + "_" + std::to_string(i) : name, address);
    }
  }
  return names;
}

const RegisterNames& interface_registers() {
  static const RegisterNames names = parse_register_names(registers_text, "registers.yaml");
  return names;
}

}  // namespace trunnion::st
