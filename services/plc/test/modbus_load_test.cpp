// SPDX-License-Identifier: Apache-2.0
// modbus.yaml among the sources of new programs.
#include <gmock/gmock.h>

#include "program_load.hpp"
#include "running_core.hpp"

namespace trunnion::plc {
namespace {

using testing::HasSubstr;

const std::string pump =
    "devices:\n  pump:\n    host: 127.0.0.1\n    inputs:\n"
    "      - {table: coils, address: 0, count: 1, at: X32}\n";

ProgramLoad loaded(Running& plc, const std::string& modbus, const st::ModbusFile& running) {
  ProgramLoad load;
  load.begin();
  EXPECT_EQ(load.write("fast.st", empty_fast), "");
  EXPECT_EQ(load.write("main.st", counting), "");
  if (!modbus.empty()) {
    EXPECT_EQ(load.write("modbus.yaml", modbus), "");
  }
  EXPECT_EQ(load.start_compiling(), "");
  load.translated(translated(load.files(), true, {plc.variables, running}));
  return load;
}

TEST(ModbusLoad, AnErrorOfTheFileHasItsPlaceAndNothingTakesOver) {
  Running plc(counting);
  const auto load = loaded(plc, pump + "      - {table: coils, address: 1, count: 1, at: G5}\n", {});
  EXPECT_EQ(load.phase(), ProgramLoad::Phase::WITH_ERRORS);
  const auto messages = load.status(0).messages;
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_THAT(messages[0], testing::StartsWith("modbus.yaml:6:"));
  EXPECT_THAT(messages[0], HasSubstr(": error: "));
  EXPECT_EQ(load.may_take_over(true), "the programs have errors");
}

TEST(ModbusLoad, SaysBeforeWhichConnectionsBeginAndEnd) {
  Running plc(counting);
  const auto running = st::read_modbus(pump, "modbus.yaml");
  const auto messages = [&](const std::string& modbus, const st::ModbusFile& before) {
    const auto load = loaded(plc, modbus, before);
    EXPECT_EQ(load.phase(), ProgramLoad::Phase::COMPILED);
    const auto all = load.status(0).messages;
    return std::vector<std::string>(all.begin(), all.end());
  };
  EXPECT_TRUE(messages(pump, running).empty());
  EXPECT_EQ(messages(pump, {}), (std::vector<std::string>{"Modbus: the device 'pump' is new"}));
  EXPECT_EQ(messages("", running),
            (std::vector<std::string>{
                "Modbus: the device 'pump' is no longer asked; its inputs keep their last values"}));
  auto other = pump;
  other.replace(other.find("count: 1"), 8, "count: 2");
  EXPECT_EQ(
      messages(other + "server:\n  outputs:\n    - {table: discrete_inputs, address: 0, count: 1, at: Y0}\n",
               running),
      (std::vector<std::string>{"Modbus: the device 'pump' changes: it is connected again",
                                "Modbus: the server is new"}));
}

}  // namespace
}  // namespace trunnion::plc
