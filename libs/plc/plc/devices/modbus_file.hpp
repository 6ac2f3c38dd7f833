// SPDX-License-Identifier: Apache-2.0
// modbus.yaml: inputs and outputs of the PLC over Modbus TCP.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "plc/machine/register_area.hpp"

namespace trunnion::st {

enum class ModbusTable : std::uint8_t { coils, discrete_inputs, holding_registers, input_registers };
constexpr bool has_bits(ModbusTable table) { return table <= ModbusTable::discrete_inputs; }

/// Consecutive elements of a table, bits or words of 16 bits, at consecutive registers of the PLC from
/// `first` on. A bit is a bit of a register. A word is a register of 16 bits, two of 8 bits (the low byte
/// first), or half of one of 32 bits (the low word first).
struct ModbusBlock {
  ModbusTable table = ModbusTable::coils;
  std::uint16_t address = 0, count = 1;
  RegisterAddress first;  ///< of bits with the first bit
  std::optional<std::uint16_t>
      at_loss;  ///< of inputs: each element without a connection; none: the last value
  bool operator==(const ModbusBlock& other) const {
    const auto key = [](const ModbusBlock& b) {
      return std::tuple(b.table, b.address, b.count, b.first.area, b.first.index, b.first.bit, b.at_loss);
    };
    return key(*this) == key(other);
  }
};
/// The register and the bit of element `i`; of a word the lowest bit.
RegisterAddress place_of(const ModbusBlock& block, std::uint32_t i);

/// A device that the PLC asks.
struct ModbusDevice {
  std::string name, host;
  std::uint16_t port = 502, unit = 1;
  double period = 0.05, timeout = 0.5;  ///< s, between two exchanges; for one answer
  std::vector<ModbusBlock> inputs, outputs;
  bool operator==(const ModbusDevice&) const = default;
};

/// What other devices may ask of the PLC. Coils and holding registers are inputs (X), which they write.
struct ModbusServer {
  std::string host = "127.0.0.1";
  std::uint16_t port = 502;
  double timeout = 0;  ///< s without a write after which the connection counts as lost; 0: never
  std::vector<ModbusBlock> inputs, outputs;
  bool operator==(const ModbusServer&) const = default;
};

struct ModbusFile {
  std::vector<ModbusDevice> devices;
  std::optional<ModbusServer> server;
  bool operator==(const ModbusFile&) const = default;
};

/// Whether a device or a client writes the bit X of the inputs.
bool writes_input(const ModbusFile& file, const RegisterAddress& bit);

/// One line for each connection that begins, ends or begins anew when `next` replaces `running`.
std::vector<std::string> changes_of(const ModbusFile& running, const ModbusFile& next);

/// Throws std::runtime_error, beginning with file:line:column, for unknown and missing keys, numbers beyond
/// their limits, blocks that leave their area, and inputs that are written twice.
ModbusFile read_modbus(const std::string& yaml, const std::string& file);

}  // namespace trunnion::st
