// SPDX-License-Identifier: Apache-2.0
// Simulated devices: what they do in time, and every wrong line of devices.yaml.
#include "plc/devices/device_file.hpp"

#include <gtest/gtest.h>

#include "plc/compile.hpp"
#include "plc/library/register_names.hpp"
#include "plc/tools/source_run.hpp"

namespace trunnion::st {
namespace {

// TESTs in Structured Text on the program of a devices.yaml.
void expect_passed(const std::string& yaml, const std::string& tests) {
  const auto devices = read_devices(yaml, "devices.yaml", interface_registers());
  const auto compiled =
      compile({{"devices.yaml", devices.program}, {"test.st", tests}}, interface_registers());
  ASSERT_TRUE(compiled.good()) << testing::PrintToString(compiled.lines()) << devices.program;
  const auto results = run_tests(compiled);
  EXPECT_FALSE(results.empty());
  for (const auto& one : results) EXPECT_TRUE(one.passed) << one.name << ": " << one.message;
}

TEST(SimulatedDevices, AnActuatorTakesItsTravelAndReversesFromWhereItIs) {
  expect_passed(
      "door:\n  actuator: {extend: Y17.0, retract: Y17.1, travel_s: 2, extended: X17.0, retracted: X17.1, "
      "blocked: R50.0}\n",
      R"(
TEST 'there and back'
simulation();
ASSERT_TRUE(%X17.1);
%Y17.0 := TRUE;
simulation();
ADVANCE(T#1999ms);
simulation();
ASSERT_FALSE(%X17.0);
ASSERT_FALSE(%X17.1);
ADVANCE(T#1ms);
simulation();
ASSERT_TRUE(%X17.0);
%Y17.0 := FALSE;
simulation();
ADVANCE(T#10s);
simulation();
ASSERT_TRUE(%X17.0); // it stays without a command
END_TEST
TEST 'reversed after 0.5 s, it is back 0.5 s later'
%Y17.0 := TRUE;
simulation();
ADVANCE(T#500ms);
%Y17.0 := FALSE;
%Y17.1 := TRUE;
simulation();
ADVANCE(T#499ms);
simulation();
ASSERT_FALSE(%X17.1);
ADVANCE(T#1ms);
simulation();
ASSERT_TRUE(%X17.1);
END_TEST
TEST 'a jam stops it, and it goes on from there'
%Y17.0 := TRUE;
simulation();
ADVANCE(T#1500ms);
%R50.0 := TRUE;
simulation();
ADVANCE(T#10s);
simulation();
ASSERT_FALSE(%X17.0);
%R50.0 := FALSE;
simulation();
ADVANCE(T#500ms);
simulation();
ASSERT_TRUE(%X17.0);
END_TEST
)");
}

TEST(SimulatedDevices, ASpringReturnsTheActuatorWithoutACommand) {
  expect_passed(
      "clamp:\n  actuator: {extend: coolant_3, travel_s: 0.5, spring_return: true, retracted: X20.4}\n", R"(
TEST 'spring'
coolant_3 := TRUE;
simulation();
ADVANCE(T#500ms);
simulation();
ASSERT_FALSE(%X20.4);
coolant_3 := FALSE;
simulation();
ADVANCE(T#500ms);
simulation();
ASSERT_TRUE(%X20.4);
END_TEST
)");
}

TEST(SimulatedDevices, ASwitchFollowsAfterItsTimes) {
  expect_passed("pump:\n  switch: {command: Y18.2, on: X18.2, on_s: 0.3, off_s: 0.1, fault: R51.7}\n", R"(
TEST 'pump'
%Y18.2 := TRUE;
simulation();
ADVANCE(T#299ms);
simulation();
ASSERT_FALSE(%X18.2);
ADVANCE(T#1ms);
simulation();
ASSERT_TRUE(%X18.2);
%Y18.2 := FALSE;
simulation();
ADVANCE(T#99ms);
simulation();
ASSERT_TRUE(%X18.2);
ADVANCE(T#1ms);
simulation();
ASSERT_FALSE(%X18.2);
%R51.7 := TRUE;
%Y18.2 := TRUE;
simulation();
ADVANCE(T#10s);
simulation();
ASSERT_FALSE(%X18.2);
END_TEST
)");
}

TEST(SimulatedDevices, AMagazineGoesPlaceByPlaceAndRound) {
  expect_passed(
      "disc:\n  magazine: {forward: Y19.0, backward: Y19.1, places: 3, step_s: 0.2, place: X21, at_place: "
      "X19.7}\n",
      R"(
TEST 'round'
simulation();
ASSERT_EQ(%X21, 1);
ASSERT_TRUE(%X19.7);
%Y19.1 := TRUE;
simulation();
ASSERT_FALSE(%X19.7);
%Y19.1 := FALSE; // a step that has begun ends
ADVANCE(T#200ms);
simulation();
ASSERT_EQ(%X21, 3);
ASSERT_TRUE(%X19.7);
%Y19.0 := TRUE;
simulation();
ADVANCE(T#200ms);
simulation();
ASSERT_EQ(%X21, 1);
ADVANCE(T#200ms);
simulation();
ASSERT_EQ(%X21, 2);
END_TEST
)");
}

TEST(SimulatedDevices, ARotarySwitchHasTheValueOfItsPositionAndAHandwheelCountsBothWays) {
  expect_passed(
      "feed: {rotary_switch: {position: X30, values: [100, 0, 50], value: X31}}\n"
      "wheel: {handwheel: {turned: X32, counter: X33}}\nstart: {key: {input: X35.0, lamp: Y5.0}}\n",
      R"(
TEST 'the value follows the position'
simulation();
ASSERT_EQ(%X31, 100);
%X30 := 2;
simulation();
ASSERT_EQ(%X31, 50);
%X30 := 3;
simulation();
ASSERT_EQ(%X31, 50); // it has no such position
END_TEST
TEST 'three back, then 300 forwards'
%X32 := 253;
simulation();
ASSERT_EQ(%X34, 255); // 65533
ASSERT_EQ(%X33, 253);
%X32 := 97; // 100 more
simulation();
%X32 := 197;
simulation();
%X32 := 41; // 100 more again
simulation();
ASSERT_EQ(%X34, 1); // 297
ASSERT_EQ(%X33, 41);
END_TEST
)");
}

TEST(SimulatedDevices, PositionSwitchesAreNoPartOfTheProgram) {
  const auto devices =
      read_devices("limit:\n  position_switch: {axis: X, from: -500, to: -495.5, on: X22.3}\n",
                   "devices.yaml", interface_registers());
  EXPECT_EQ(devices.program, "");
  ASSERT_EQ(devices.switches.size(), 1u);
  EXPECT_EQ(devices.switches[0].axis, "X");
  EXPECT_EQ(devices.switches[0].high, -495.5);
  EXPECT_EQ(devices.switches[0].input.index, 22);
  EXPECT_EQ(devices.switches[0].input.bit, 3);
}

TEST(SimulatedDevices, AWrongLineIsNamedWithItsPlace) {
  struct Case {
    const char* yaml;
    const char* says;
  };
  const Case cases[] = {
      {"[]\n", "devices.yaml:1:1"},
      {"2door:\n  switch: {command: Y1.0, on: X16.0}\n", "devices.yaml:1:1: error: '2door' is no name"},
      {"a__b:\n  switch: {command: Y1.0, on: X16.0}\n", "devices.yaml:1:1"},
      {"door:\n  gate: {}\n", "devices.yaml:2:3: error: unknown key 'gate'"},
      {"door: {}\n", "devices.yaml:1:7: error: a type is missing"},
      {"a:\n  switch: {command: Y1.0}\n", "'on' is missing"},
      {"a:\n  switch: {command: Y1.0, on: X16.0, speed: 3}\n",
       "devices.yaml:2:38: error: unknown key 'speed'"},
      {"a:\n  switch: {command: Y1.9, on: X16.0}\n", "'Y1.9' is no bit"},
      {"a:\n  switch: {command: Y1, on: X16.0}\n", "'Y1' is no bit"},
      {"a:\n  switch: {command: nothing, on: X16.0}\n", "'nothing' is no bit"},
      {"a:\n  switch: {command: Y1.0, on: Y16.0}\n", "'Y16.0' is no input bit"},
      {"a:\n  switch: {command: Y1.0, on: X512.0}\n", "no input bit"},
      {"a:\n  switch: {command: Y1.0, on: X16.0, on_s: 0}\n", "0 is not within 0.001 .. 3600"},
      {"a:\n  switch: {command: Y1.0, on: X16.0, on_s: soon}\n", "'soon' is not a number"},
      {"a:\n  magazine: {forward: Y1.0, places: 2.5, step_s: 1, place: X20}\n", "expected a whole number"},
      {"a:\n  magazine: {forward: Y1.0, places: 256, step_s: 1, place: X20}\n", "256 is not within 2 .. 255"},
      {"a:\n  magazine: {forward: Y1.0, places: 8, step_s: 1, place: X20.1}\n", "no input byte"},
      {"a:\n  switch: {command: Y1.0, on: X16.0}\nb:\n  switch: {command: Y1.1, on: X16.0}\n",
       "devices.yaml:4:31: error: X16.0 is written by another device"},
      {"a:\n  magazine: {forward: Y1.0, places: 8, step_s: 1, place: X20}\nb:\n  switch: {command: Y1.1, on: "
       "X20.7}\n",
       "X20.7 is written by another device"},
      {"a:\n  position_switch: {axis: X, from: 3, on: X16.0}\n", "'axis', 'from', 'to' and 'on'"},
      {"a:\n  position_switch: {axis: X, from: 3, to: 2, on: X16.0}\n", "'from' is above 'to'"},
      {"a: {switch: {command: Y1.0, on: X1.0}, actuator: {}}\n", "one device, one type"},
      {"a: {key: {lamp: Y1.0}}\n", "devices.yaml:1:10: error: 'input' is missing"},
      {"a: {key: {input: Y1.0}}\n", "devices.yaml:1:18: error: 'Y1.0' is no input bit"},
      {"a: {rotary_switch: {position: X1, values: [1, 2.5], value: X2}}\n", "1:47: error: expected a whole"},
      {"a: {rotary_switch: {position: X1, values: [256], value: X2}}\n", "256 is not within 0 .. 255"},
      {"a: {rotary_switch: {position: X1, value: X2}}\n", "'position', 'values' and 'value'"},
      {"a: {handwheel: {turned: X1, counter: X511}}\n", "1:38: error: the counter has two bytes"},
      {"a: {handwheel: {turned: X1, counter: X0}}\n", "1:38: error: X1 is written by another device"},
  };
  for (const auto& c : cases) {
    try {
      read_devices(c.yaml, "devices.yaml", interface_registers());
      ADD_FAILURE() << "accepted: " << c.yaml;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(c.says), std::string::npos) << c.yaml << e.what();
      EXPECT_TRUE(std::string(e.what()).starts_with("devices.yaml:")) << e.what();
    }
  }
}

}  // namespace
}  // namespace trunnion::st
