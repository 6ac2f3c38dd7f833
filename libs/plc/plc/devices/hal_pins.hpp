// SPDX-License-Identifier: Apache-2.0
// io.yaml: HAL pins for elements of the PLC's Modbus server.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plc/devices/modbus_file.hpp"

namespace trunnion::st {

/// Consecutive elements of a table, one pin each: bits, or words of 16 bits as unsigned numbers.
struct HalPins {
  ModbusTable table = ModbusTable::discrete_inputs;
  std::uint16_t address = 0;
  std::vector<std::string> pins;
};

struct HalPinsFile {
  std::string host = "127.0.0.1";
  std::uint16_t port = 502;
  double period = 0.01;          ///< s between two exchanges
  double timeout = 0.3;          ///< s for one answer; outputs are 0 from then on
  std::vector<HalPins> outputs;  ///< of the PLC: discrete_inputs, input_registers
  std::vector<HalPins> inputs;   ///< of the PLC: coils, holding_registers
};

/// Throws std::runtime_error, beginning with file:line:column, for unknown and missing keys, numbers beyond
/// their limits, and pins that are named twice or have characters that HAL does not take.
HalPinsFile read_hal_pins(const std::string& yaml, const std::string& file);

}  // namespace trunnion::st
