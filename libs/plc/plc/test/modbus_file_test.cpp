// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <stdexcept>

#include "plc/devices/modbus_file.hpp"

namespace trunnion::st::modbus_file_test {
namespace {

std::string refusal(const std::string& yaml) {
  try {
    read_modbus(yaml, "modbus.yaml");
    return "";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}
std::string refused_block(const std::string& list, const std::string& block) {
  return refusal("devices:\n  d:\n    host: h\n    " + list + ":\n      - {" + block + "}\n");
}

TEST(ModbusFile, HasDevicesAndAServer) {
  const auto file = read_modbus(
      "devices:\n  unit:\n    host: 10.0.0.2\n    period_ms: 20\n    inputs:\n"
      "      - {table: input_registers, address: 7, count: 2, at: X40, at_loss: 9}\n"
      "    outputs:\n      - {table: coils, address: 0, count: 3, at: Y32.6}\n"
      "server:\n  outputs:\n    - {table: input_registers, address: 0, count: 4, at: D5}\n",
      "modbus.yaml");
  ASSERT_EQ(file.devices.size(), 1u);
  const auto& device = file.devices[0];
  EXPECT_EQ(device.name + device.host, "unit10.0.0.2");
  EXPECT_EQ(device.port, 502);
  EXPECT_EQ(device.period, 0.02);
  EXPECT_EQ(device.inputs.at(0).at_loss, 9);
  // A word takes two registers of 8 bits; bits continue in the next register.
  EXPECT_EQ(place_of(device.inputs[0], 1).index, 42);
  EXPECT_EQ(place_of(device.outputs.at(0), 1).bit, 7);
  EXPECT_EQ(place_of(device.outputs[0], 2).index, 33);
  EXPECT_EQ(place_of(device.outputs[0], 2).bit, 0);
  // Two words make a register of 32 bits.
  const auto& served = file.server.value().outputs.at(0);
  EXPECT_EQ(place_of(served, 2).index, 6);
  EXPECT_EQ(place_of(served, 3).bit, 16);
  EXPECT_EQ(file.server->host, "127.0.0.1");
}

TEST(ModbusFile, WhatIsWrongIsRefusedWithItsPlace) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("devices: {d: {port: 502}}"), HasSubstr("modbus.yaml:1:14: error: 'host' is missing"));
  EXPECT_THAT(refusal("devices: {d: {host: h, port: 0}}"), HasSubstr("modbus.yaml:1:30: error: "));
  EXPECT_THAT(refusal("nothing: 1"), HasSubstr("modbus.yaml:1:1: error: "));
  EXPECT_THAT(refused_block("inputs", "table: coils, address: 0, count: 8"),
              HasSubstr("'table', 'address', 'count' and 'at'"));
  EXPECT_THAT(refused_block("inputs", "table: coils, address: 0, count: 8, at: Y3"),
              HasSubstr("inputs are registers of area X"));
  EXPECT_THAT(refused_block("inputs", "table: input_registers, address: 0, count: 126, at: X0"),
              HasSubstr("at most 125"));
  EXPECT_THAT(refused_block("inputs", "table: coils, address: 65535, count: 2, at: X0"),
              HasSubstr("behind the address 65535"));
  EXPECT_THAT(refused_block("inputs", "table: input_registers, address: 0, count: 1, at: X511"),
              HasSubstr("leaves the area X"));
  EXPECT_THAT(refused_block("inputs", "table: coils, address: 0, count: 2, at: X511.7"),
              HasSubstr("leaves the area X"));
  EXPECT_THAT(refused_block("inputs", "table: coils, address: 0, count: 2, at: X5, at_loss: 2"),
              HasSubstr("error: "));
  EXPECT_THAT(refused_block("outputs", "table: discrete_inputs, address: 0, count: 2, at: Y5"),
              HasSubstr("outputs are written to"));
  EXPECT_THAT(refused_block("outputs", "table: holding_registers, address: 0, count: 2, at: Y5.1"),
              HasSubstr("not at a bit"));
  EXPECT_THAT(refused_block("inputs",
                            "table: coils, address: 0, count: 9, at: X5}\n      - {table: coils, address: "
                            "50, count: 1, at: X6"),
              HasSubstr("modbus.yaml:6:51: error: X6 is written by another block already"));
  EXPECT_THAT(refusal("server: {inputs: [{table: discrete_inputs, address: 0, count: 1, at: X0}]}"),
              HasSubstr("others can write coils and holding_registers only"));
  EXPECT_THAT(refusal("server: {outputs: [{table: input_registers, address: 0, count: 2, at: W0}, "
                      "{table: input_registers, address: 1, count: 2, at: W8}]}"),
              HasSubstr("the Modbus address 1 is there twice"));
}

}  // namespace
}  // namespace trunnion::st::modbus_file_test
