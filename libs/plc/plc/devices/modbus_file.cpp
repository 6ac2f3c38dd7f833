// SPDX-License-Identifier: Apache-2.0
#include "plc/devices/modbus_file.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::st {
namespace {

constexpr std::size_t most_connections = 16, most_blocks = 32;
constexpr const char* device_keys = "host, port, unit, period_ms, timeout_ms, inputs, outputs";
constexpr const char* server_keys = "host, port, timeout_ms, inputs, outputs";

const std::map<std::string, ModbusTable> tables = {{"coils", ModbusTable::coils},
                                                   {"discrete_inputs", ModbusTable::discrete_inputs},
                                                   {"holding_registers", ModbusTable::holding_registers},
                                                   {"input_registers", ModbusTable::input_registers}};

class ModbusReader {
 public:
  explicit ModbusReader(const std::string& file) : reader_(file) {}

  ModbusFile read(const YAML::Node& root) {
    reader_.each(root, "devices, server", [&](const std::string& key, const YAML::Node& value) {
      if (key == "devices") return devices(value), true;
      return key == "server" && (server(value), true);
    });
    return std::move(out_);
  }

 private:
  void devices(const YAML::Node& node) {
    if (!node.IsMap() || node.size() > most_connections)
      reader_.fail(node, "expected 1 .. " + std::to_string(most_connections) + " devices by their names");
    std::set<std::string> names;
    for (const auto& entry : node) {
      ModbusDevice device;
      device.name = reader_.text(entry.first);
      if (device.name.empty() || device.name.size() > 32 || !names.insert(device.name).second)
        reader_.fail(entry.first, "a device has a name of its own, of at most 32 bytes");
      reader_.each(entry.second, device_keys, [&](const std::string& key, const YAML::Node& value) {
        if (key == "host") return device.host = reader_.host(value), true;
        if (key == "port") return device.port = whole(value, {1, 65535}), true;
        if (key == "unit") return device.unit = whole(value, {0, 255}), true;
        if (key == "period_ms") return device.period = whole(value, {1, 60000}) / 1000.0, true;
        if (key == "timeout_ms") return device.timeout = whole(value, {10, 60000}) / 1000.0, true;
        if (key == "inputs") return device.inputs = blocks(value, true, false), true;
        return key == "outputs" && (device.outputs = blocks(value, false, false), true);
      });
      if (device.host.empty()) reader_.fail(entry.second, "'host' is missing");
      out_.devices.push_back(std::move(device));
    }
  }

  void server(const YAML::Node& node) {
    auto& server = out_.server.emplace();
    reader_.each(node, server_keys, [&](const std::string& key, const YAML::Node& value) {
      if (key == "host") return server.host = reader_.host(value), true;
      if (key == "port") return server.port = whole(value, {1, 65535}), true;
      if (key == "timeout_ms") return server.timeout = whole(value, {10, 60000}) / 1000.0, true;
      if (key == "inputs") return server.inputs = blocks(value, true, true), true;
      return key == "outputs" && (server.outputs = blocks(value, false, true), true);
    });
  }

  std::uint16_t whole(const YAML::Node& node, machine::Limits limits) const {
    return static_cast<std::uint16_t>(reader_.whole(node, limits));
  }

  std::vector<ModbusBlock> blocks(const YAML::Node& node, bool input, bool serves) {
    if (!node.IsSequence() || node.size() > most_blocks)
      reader_.fail(node, "expected a list of 1 .. " + std::to_string(most_blocks) + " blocks");
    std::vector<ModbusBlock> result;
    std::set<std::pair<ModbusTable, std::uint32_t>> taken;
    for (const auto& one : node) {
      result.push_back(block(one, input, serves));
      for (std::uint32_t i = 0; serves && i < result.back().count; ++i)
        if (!taken.emplace(result.back().table, result.back().address + i).second)
          reader_.fail(one,
                       "the Modbus address " + std::to_string(result.back().address + i) + " is there twice");
    }
    return result;
  }

  ModbusBlock block(const YAML::Node& node, bool input, bool serves) {
    ModbusBlock result;
    YAML::Node place, loss;
    bool has_table = false;
    reader_.each(node, input ? "table, address, count, at, at_loss" : "table, address, count, at",
                 [&](const std::string& key, const YAML::Node& value) {
                   if (key == "table") return result.table = reader_.choice(value, tables), has_table = true;
                   if (key == "address") return result.address = whole(value, {0, 65535}), true;
                   if (key == "count") return result.count = whole(value, {1, 4096}), true;
                   if (key == "at") return place = value, true;
                   return input && key == "at_loss" && (loss = value, true);
                 });
    if (!has_table || !place.IsDefined() || place.IsNull())
      reader_.fail(node, "a block has 'table', 'address', 'count' and 'at'");
    const bool bits = has_bits(result.table);
    const bool writable =
        result.table == ModbusTable::coils || result.table == ModbusTable::holding_registers;
    if (serves && input && !writable) reader_.fail(node, "others can write coils and holding_registers only");
    if (serves && !input && writable)
      reader_.fail(node, "outputs that others read are discrete_inputs or input_registers");
    if (!serves && !input && !writable)
      reader_.fail(node, "outputs are written to coils or holding_registers");
    // The largest requests of the protocol (MODBUS Application Protocol V1.1b3, 6.1 to 6.12).
    const int most = serves ? (bits ? 4096 : 512) : bits ? (input ? 2000 : 1968) : input ? 125 : 123;
    if (result.count > most)
      reader_.fail(node, "count is " + std::to_string(result.count) + ", at most " + std::to_string(most));
    if (result.address + result.count > 65536) reader_.fail(node, "the block ends behind the address 65535");
    const auto text = reader_.text(place);
    const char* problem = "";
    const auto first = parse_register(text, &problem);
    if (!first) reader_.fail(place, "'" + text + "': " + problem);
    result.first = *first;
    if (input && first->area != Area::x) reader_.fail(place, "inputs are registers of area X");
    if (!bits && first->bit >= 0) reader_.fail(place, "words begin at a register, not at a bit");
    if (bits && first->bit < 0) result.first.bit = 0;
    const auto last =
        place_of(result, result.count - 1u).index + (!bits && info(first->area).bits == 8 ? 1u : 0u);
    if (last >= info(first->area).count)
      reader_.fail(place, "the block leaves the area " + std::string(1, info(first->area).letter));
    if (input) write_inputs(place, result);
    if (loss.IsDefined() && !loss.IsNull() && reader_.text(loss) != "hold")
      result.at_loss = whole(loss, {0, bits ? 1.0 : 65535.0});
    return result;
  }

  // Two blocks must not write the same bits.
  void write_inputs(const YAML::Node& node, const ModbusBlock& block) {
    for (std::uint32_t i = 0; i < block.count; ++i) {
      const auto at = place_of(block, i);
      for (const auto part : {0u, 1u}) {
        if (part == 1 && has_bits(block.table)) break;
        auto& written = written_.at(at.index + part);
        const auto bits = static_cast<std::uint8_t>(at.bit >= 0 ? 1u << at.bit : 0xffu);
        if ((written & bits) != 0)
          reader_.fail(node, "X" + std::to_string(at.index + part) + " is written by another block already");
        written = static_cast<std::uint8_t>(written | bits);
      }
    }
  }

  machine::YamlReader reader_;
  ModbusFile out_;
  std::array<std::uint8_t, 512> written_{};  ///< bits of X
};

}  // namespace

bool writes_input(const ModbusFile& file, const RegisterAddress& bit) {
  const auto writes = [&](const ModbusBlock& block) {
    for (std::uint32_t i = 0; i < block.count; ++i) {
      const auto at = place_of(block, i);
      // A word takes two registers of 8 bits.
      const auto distance = bit.index - at.index;
      if (at.is_bit() ? at == bit : distance == 0 || distance == 1) return true;
    }
    return false;
  };
  const auto any = [&](const std::vector<ModbusBlock>& blocks) {
    return std::any_of(blocks.begin(), blocks.end(), writes);
  };
  return (file.server && any(file.server->inputs)) ||
         std::any_of(file.devices.begin(), file.devices.end(), [&](const auto& d) { return any(d.inputs); });
}

RegisterAddress place_of(const ModbusBlock& block, std::uint32_t i) {
  const auto width = static_cast<std::uint32_t>(info(block.first.area).bits);
  auto at = block.first;
  const auto moved = [&](std::uint32_t registers) {
    at.index = static_cast<std::uint16_t>(at.index + registers);
    return at;
  };
  if (has_bits(block.table)) {
    const auto bit = static_cast<std::uint32_t>(at.bit) + i;
    at.bit = static_cast<std::int8_t>(bit % width);
    return moved(bit / width);
  }
  if (width == 32) {
    at.bit = static_cast<std::int8_t>(i % 2 * 16);
    return moved(i / 2);
  }
  return moved(width == 8 ? 2 * i : i);
}

std::vector<std::string> changes_of(const ModbusFile& running, const ModbusFile& next) {
  std::vector<std::string> lines;
  const auto named = [](const ModbusFile& file, const std::string& name) {
    const auto found = std::find_if(file.devices.begin(), file.devices.end(),
                                    [&](const auto& device) { return device.name == name; });
    return found == file.devices.end() ? nullptr : &*found;
  };
  constexpr const char* held = "; its inputs keep their last values";
  for (const auto& device : running.devices) {
    const auto* other = named(next, device.name);
    if (other == nullptr)
      lines.push_back("Modbus: the device '" + device.name + "' is no longer asked" + held);
    else if (*other != device)
      lines.push_back("Modbus: the device '" + device.name + "' changes: it is connected again");
  }
  for (const auto& device : next.devices)
    if (named(running, device.name) == nullptr)
      lines.push_back("Modbus: the device '" + device.name + "' is new");
  if (running.server && !next.server)
    lines.push_back(std::string("Modbus: the server ends") + held);
  else if (!running.server && next.server)
    lines.emplace_back("Modbus: the server is new");
  else if (running.server != next.server)
    lines.emplace_back("Modbus: the server changes: its connections end, and others may connect again");
  return lines;
}

ModbusFile read_modbus(const std::string& yaml, const std::string& file) {
  return ModbusReader(file).read(machine::parse_yaml(yaml, file));
}

}  // namespace trunnion::st
