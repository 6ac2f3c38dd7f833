// SPDX-License-Identifier: Apache-2.0
#include "plc/devices/hal_pins.hpp"

#include <set>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::st {
namespace {

constexpr std::size_t most_pins = 512, longest_pin = 32;

class HalPinsReader {
 public:
  explicit HalPinsReader(const std::string& file) : reader_(file) {}

  HalPinsFile read(const YAML::Node& root) {
    reader_.each(root, "host, port, period_ms, timeout_ms, outputs, inputs",
                 [&](const std::string& key, const YAML::Node& value) {
                   if (key == "host") return out_.host = reader_.host(value), true;
                   if (key == "port") return out_.port = whole(value, {1, 65535}), true;
                   if (key == "period_ms") return out_.period = whole(value, {1, 1000}) / 1000.0, true;
                   if (key == "timeout_ms") return out_.timeout = whole(value, {10, 10000}) / 1000.0, true;
                   if (key == "outputs") return out_.outputs = blocks(value, false), true;
                   return key == "inputs" && (out_.inputs = blocks(value, true), true);
                 });
    if (names_.empty()) reader_.fail(root, "'outputs' or 'inputs' with pins are missing");
    return std::move(out_);
  }

 private:
  std::uint16_t whole(const YAML::Node& node, machine::Limits limits) const {
    return static_cast<std::uint16_t>(reader_.whole(node, limits));
  }

  std::vector<HalPins> blocks(const YAML::Node& node, bool inputs) {
    if (!node.IsSequence()) reader_.fail(node, "expected a list of blocks");
    std::vector<HalPins> result;
    for (const auto& one : node) result.push_back(block(one, inputs));
    return result;
  }

  HalPins block(const YAML::Node& node, bool input) {
    static const std::map<std::string, ModbusTable> written = {
        {"coils", ModbusTable::coils}, {"holding_registers", ModbusTable::holding_registers}};
    static const std::map<std::string, ModbusTable> read = {
        {"discrete_inputs", ModbusTable::discrete_inputs}, {"input_registers", ModbusTable::input_registers}};
    HalPins result;
    bool has_table = false;
    reader_.each(node, "table, address, pins", [&](const std::string& key, const YAML::Node& value) {
      if (key == "table")
        return result.table = reader_.choice(value, input ? written : read), has_table = true;
      if (key == "address") return result.address = whole(value, {0, 65535}), true;
      return key == "pins" && (pins(value, result), true);
    });
    if (!has_table || result.pins.empty()) reader_.fail(node, "a block has 'table', 'address' and 'pins'");
    // The largest requests of the protocol (MODBUS Application Protocol V1.1b3, 6.2 to 6.12).
    const std::size_t most = has_bits(result.table) ? most_pins : input ? 123 : 125;
    if (result.pins.size() > most)
      reader_.fail(node, "a block has at most " + std::to_string(most) + " pins");
    if (result.address + result.pins.size() > 65536)
      reader_.fail(node, "the block ends behind the address 65535");
    return result;
  }

  void pins(const YAML::Node& node, HalPins& block) {
    if (!node.IsSequence()) reader_.fail(node, "expected a list of names");
    for (const auto& one : node) {
      auto name = reader_.text(one);
      if (name.empty() || name.size() > longest_pin ||
          name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-.") != std::string::npos)
        reader_.fail(one, "the name of a pin has 1 .. 32 characters: a .. z, 0 .. 9, '-' and '.'");
      if (!names_.insert(name).second) reader_.fail(one, "the pin '" + name + "' is there twice");
      if (names_.size() > most_pins)
        reader_.fail(one, "there are more than " + std::to_string(most_pins) + " pins");
      block.pins.push_back(std::move(name));
    }
  }

  machine::YamlReader reader_;
  HalPinsFile out_;
  std::set<std::string> names_;
};

}  // namespace

HalPinsFile read_hal_pins(const std::string& yaml, const std::string& file) {
  return HalPinsReader(file).read(machine::parse_yaml(yaml, file));
}

}  // namespace trunnion::st
