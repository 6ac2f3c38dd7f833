// SPDX-License-Identifier: Apache-2.0
#include "plc/library/register_names.hpp"

#include <set>
#include <stdexcept>

#include "machine/yaml.hpp"
#include "plc/syntax/token.hpp"

namespace trunnion::st {
namespace {

// From the block of channel 0 to that of each channel.
constexpr int channel_blocks[] = {0, 80, 160, 240, 320, 560, 640, 720};

}  // namespace

std::vector<NamedRegister> parse_register_table(const std::string& yaml, const std::string& file) {
  std::vector<NamedRegister> table;
  std::set<std::string> names;
  const auto document = machine::parse_yaml(yaml, file);
  for (const auto& node : document["registers"]) {
    const auto name = node["name"].as<std::string>();
    const auto first = parse_register(node["address"].as<std::string>(), nullptr);
    if (!first) throw std::runtime_error(machine::at(file, node["address"]) + "not an address");
    const bool channels = node["each"] && node["each"].as<std::string>() == "channel";
    const int count = channels ? 8 : node["count"] ? node["count"].as<int>() : 0;
    const auto stride = node["stride"] ? node["stride"].as<std::string>() : "1";
    const auto unit = node["unit"] ? node["unit"].as<std::string>() : "";
    for (int i = 0; i < (count > 0 ? count : 1); ++i) {
      auto address = *first;
      const int step = channels ? channel_blocks[i] : stride == "bit" ? 0 : i * std::stoi(stride);
      address.index = static_cast<std::uint16_t>(address.index + step);
      if (stride == "bit") {
        const int width = info(address.area).bits, bit = address.bit + i;
        address.index = static_cast<std::uint16_t>(address.index + bit / width);
        address.bit = static_cast<std::int8_t>(bit % width);
      }
      if (address.index >= info(address.area).count || address.bit >= info(address.area).bits)
        throw std::runtime_error(machine::at(file, node) + "'" + name + "' leaves the image");
      auto full = count > 0 ? name + "_" + std::to_string(i) : name;
      if (!names.insert(upper_case(full)).second)
        throw std::runtime_error(machine::at(file, node) + "'" + name + "' is defined twice");
      std::optional<RegisterAddress> before;
      if (node["before"]) {
        before = parse_register(node["before"].as<std::string>(), nullptr);
        if (!before) throw std::runtime_error(machine::at(file, node["before"]) + "not an address");
        before->index = static_cast<std::uint16_t>(before->index + (channels ? 16 * i : step));
        if (stride == "bit") before->bit = static_cast<std::int8_t>(before->bit + i);
      }
      table.push_back({std::move(full), address, unit, before});
    }
  }
  return table;
}

const std::vector<NamedRegister>& register_table() {
  static const auto table = parse_register_table(registers_text, "registers.yaml");
  return table;
}

std::string moved_register(const RegisterAddress& address) {
  const auto meets = [&](const RegisterAddress& other) {
    return other.area == address.area && other.index == address.index &&
           (other.bit < 0 || address.bit < 0 || other.bit == address.bit);
  };
  const NamedRegister* moved = nullptr;
  for (const auto& one : register_table()) {
    if (meets(one.address)) return "";
    if (moved == nullptr && one.before && meets(*one.before)) moved = &one;
  }
  if (moved == nullptr) return "";
  return register_text(address) + " was " + moved->name +
         " in versions up to 0.3; nothing reads or writes it now: use the name, or " +
         register_text(moved->address);
}

const RegisterNames& interface_registers() {
  static const RegisterNames names = [] {
    RegisterNames result;
    for (const auto& one : register_table()) result.emplace(upper_case(one.name), one.address);
    return result;
  }();
  return names;
}

RegisterAddress interface_address(const std::string& name) {
  const auto found = interface_registers().find(upper_case(name));
  if (found == interface_registers().end()) throw std::out_of_range("unknown register " + name);
  return found->second;
}

RegisterAddress interface_address(const std::string& name, std::size_t index) {
  return interface_address(name + "_" + std::to_string(index));
}

}  // namespace trunnion::st
