// SPDX-License-Identifier: Apache-2.0
// Registers of the PLC as values of Modbus tables, and back.
#pragma once

#include <array>
#include <span>

#include "memory.hpp"
#include "plc/devices/modbus_file.hpp"

namespace trunnion::plc {

/// Bits of area X that come from the network.
struct NetworkInputs {
  std::array<std::uint8_t, register_count> value{}, mask{};

  /// Byte `i` of X with these bits in it.
  std::uint8_t in(std::uint8_t current, std::size_t i) const {
    return static_cast<std::uint8_t>((current & ~mask[i]) | (value[i] & mask[i]));
  }
  void merge(const NetworkInputs& other);
};

/// The elements of the block, one value each: 0 or 1, or 16 bits.
void read_block(const Registers& registers, const st::ModbusBlock& block, std::span<std::uint16_t> values);
/// The block is one of inputs (area X).
void put_block(const st::ModbusBlock& block, std::span<const std::uint16_t> values, NetworkInputs& inputs);
/// What the inputs of the blocks are without a connection; those without at_loss stay.
void put_losses(std::span<const st::ModbusBlock> blocks, NetworkInputs& inputs);
/// X32 .. X35: the registers of the blocks, for messages.
std::string registers_text(std::span<const st::ModbusBlock> blocks);

}  // namespace trunnion::plc
