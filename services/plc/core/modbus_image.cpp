// SPDX-License-Identifier: Apache-2.0
#include "modbus_image.hpp"

#include <string>
#include <vector>

#include "address.hpp"

namespace trunnion::plc {
namespace {

void put_byte(NetworkInputs& inputs, std::size_t index, std::uint8_t value, std::uint8_t bits) {
  inputs.mask[index] = static_cast<std::uint8_t>(inputs.mask[index] | bits);
  inputs.value[index] = static_cast<std::uint8_t>((inputs.value[index] & ~bits) | (value & bits));
}

}  // namespace

void NetworkInputs::merge(const NetworkInputs& other) {
  for (std::size_t i = 0; i < value.size(); ++i)
    if (other.mask[i] != 0) put_byte(*this, i, other.value[i], other.mask[i]);
}

void read_block(const Registers& registers, const st::ModbusBlock& block, std::span<std::uint16_t> values) {
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const auto at = st::place_of(block, i);
    if (st::has_bits(block.table)) {
      values[i] = load(registers, {at.area, at.index, at.bit}) != 0 ? 1 : 0;
      continue;
    }
    auto word = static_cast<std::uint32_t>(load(registers, {at.area, at.index, -1}));
    if (width(at.area) == 8)
      word |=
          static_cast<std::uint32_t>(load(registers, {at.area, static_cast<std::uint16_t>(at.index + 1), -1}))
          << 8;
    else if (at.bit > 0)
      word >>= at.bit;
    values[i] = static_cast<std::uint16_t>(word);
  }
}

void put_block(const st::ModbusBlock& block, std::span<const std::uint16_t> values, NetworkInputs& inputs) {
  for (std::uint32_t i = 0; i < values.size(); ++i) {
    const auto at = st::place_of(block, i);
    if (st::has_bits(block.table)) {
      const auto bit = static_cast<std::uint8_t>(1u << at.bit);
      put_byte(inputs, at.index, values[i] != 0 ? bit : 0, bit);
    } else {
      put_byte(inputs, at.index, static_cast<std::uint8_t>(values[i]), 0xff);
      put_byte(inputs, at.index + 1u, static_cast<std::uint8_t>(values[i] >> 8), 0xff);
    }
  }
}

void put_losses(std::span<const st::ModbusBlock> blocks, NetworkInputs& inputs) {
  for (const auto& block : blocks)
    if (block.at_loss) put_block(block, std::vector<std::uint16_t>(block.count, *block.at_loss), inputs);
}

std::string registers_text(std::span<const st::ModbusBlock> blocks) {
  std::string text;
  for (const auto& block : blocks) {
    const std::string letter(1, st::info(block.first.area).letter);
    auto last = st::place_of(block, block.count - 1u).index;
    if (!st::has_bits(block.table) && width(block.first.area) == 8) ++last;
    text += (text.empty() ? "" : ", ") + letter + std::to_string(block.first.index);
    if (last != block.first.index) text += " .. " + letter + std::to_string(last);
  }
  return text;
}

}  // namespace trunnion::plc
