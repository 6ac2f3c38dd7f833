// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "plc/devices/hal_pins.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::st {
namespace {

TEST(HalPinsFile, NamesOnePinForEachElement) {
  const auto file = read_hal_pins(
      "port: 1502\nperiod_ms: 5\ntimeout_ms: 200\noutputs:\n"
      "  - {table: discrete_inputs, address: 3, pins: [flood, mist]}\n"
      "  - {table: input_registers, address: 0, pins: [speed]}\n"
      "inputs:\n  - {table: coils, address: 0, pins: [door.closed]}\n",
      "io.yaml");
  EXPECT_EQ(file.host, "127.0.0.1");
  EXPECT_EQ(file.port, 1502);
  EXPECT_EQ(file.period, 0.005);
  EXPECT_EQ(file.timeout, 0.2);
  ASSERT_EQ(file.outputs.size(), 2u);
  EXPECT_EQ(file.outputs[0].table, ModbusTable::discrete_inputs);
  EXPECT_EQ(file.outputs[0].address, 3);
  EXPECT_EQ(file.outputs[0].pins, (std::vector<std::string>{"flood", "mist"}));
  EXPECT_EQ(file.inputs.at(0).pins, std::vector<std::string>{"door.closed"});
}

TEST(HalPinsFile, AMistakeHasItsPlaceAndWhatIsExpected) {
  const auto refusal = [](const std::string& text) {
    return testing_support::refusal_of([&] { read_hal_pins(text, "io.yaml"); });
  };
  const std::string in = "inputs:\n  - {table: coils, address: 0, pins: ", out = "outputs:\n  - {table: ";
  EXPECT_EQ(refusal("port: 1502"), "io.yaml:1:1: error: 'outputs' or 'inputs' with pins are missing");
  EXPECT_EQ(refusal(in + "[a, b, a]}"), "io.yaml:2:45: error: the pin 'a' is there twice");
  EXPECT_EQ(refusal(in + "[Door]}"),
            "io.yaml:2:39: error: the name of a pin has 1 .. 32 characters: a .. z, 0 .. 9, '-' and '.'");
  EXPECT_EQ(refusal(in + "[]}"), "io.yaml:2:5: error: a block has 'table', 'address' and 'pins'");
  EXPECT_EQ(refusal(out + "coils, address: 0, pins: [a]}"),
            "io.yaml:2:13: error: 'coils' is none of discrete_inputs, input_registers");
  EXPECT_EQ(refusal(out + "discrete_inputs, address: 65535, pins: [a, b]}"),
            "io.yaml:2:5: error: the block ends behind the address 65535");
  EXPECT_NE(refusal("ports: 3\n" + in + "[a]}").find("io.yaml:1:1: error: "), std::string::npos);
  EXPECT_NE(refusal("period_ms: 0\n" + in + "[a]}").find("io.yaml:1:12: error: "), std::string::npos);
}

}  // namespace
}  // namespace trunnion::st
