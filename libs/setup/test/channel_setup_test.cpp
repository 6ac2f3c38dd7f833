#include "setup/channel_setup.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace trunnion::setup {
namespace {

namespace fs = std::filesystem;

const std::string ac_table = MACHINES_DIRECTORY "/ac-table";

TEST(ChannelSetup, ReadsAxesToolsOffsetsAndTravelOfAMachineFolder) {
  const ChannelSetup setup(load_machine_tables(ac_table));
  EXPECT_EQ(setup.channel_axes().letters, "XYZAC");
  EXPECT_EQ(setup.axes(), 0b101111);  // bit 0 = X .. bit 5 = C, no B
  // tools.yaml: tool 1 is 100 mm long; there is no tool 9. work_offsets.yaml: G54 lies at Z -380.
  EXPECT_EQ(setup.tool_length(1), 100.0);
  EXPECT_EQ(setup.tool_length(9), std::nullopt);
  EXPECT_EQ(setup.work_offset(0)[language::Z], -380);
  EXPECT_EQ(setup.work_offset(1)[language::Z], 0);
  EXPECT_EQ(setup.travel(language::X).negative, -400);
  EXPECT_EQ(setup.travel(language::X).positive, 400);
}

TEST(ChannelSetup, WearCountsInTheToolLength) {
  auto tables = load_machine_tables(ac_table);
  tables.tools.tools[0].length_wear = -0.25;
  EXPECT_EQ(ChannelSetup(tables).tool_length(1), 99.75);
  const auto tool = ChannelSetup(tables).tool_offset(1);
  ASSERT_TRUE(tool.has_value());
  EXPECT_EQ(tool->length, 100);
  EXPECT_EQ(tool->length_wear, -0.25);
  EXPECT_EQ(tool->radius, tables.tools.tools[0].radius);
}

TEST(ChannelSetup, MCodesOfUserCyclesAreParameters) {
  auto tables = load_machine_tables(ac_table);
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(3), 0);
  tables.parameters.values[10173] = {130, ""};  // 010173: M code of G1010
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(3), 130);
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(4), 0);
}

TEST(ChannelSetup, ATableThatTurnsCarriesTheTipAlong) {
  const ChannelSetup setup(load_machine_tables(ac_table));
  // C turns about -Z through X0 Y0: at C90 the workpiece point X10 Y0 lies at X0 Y-10, and the spindle face
  // 100 mm above the tip.
  const auto machine = setup.machine_from_tip({10, 0, -400, 0, 0, 90}, 100);
  EXPECT_NEAR(machine[0], 0, 1e-12);
  EXPECT_NEAR(machine[1], -10, 1e-12);
  EXPECT_NEAR(machine[2], -300, 1e-12);
  const auto tip = setup.tip_from_machine(machine, 100);
  EXPECT_NEAR(tip[0], 10, 1e-12);
  EXPECT_NEAR(tip[1], 0, 1e-12);
}

TEST(ChannelSetup, ToolRadiiAndAdditionalOffsetsAreThoseOfTheTables) {
  auto tables = load_machine_tables(ac_table);
  tables.tools.tools[0].radius = 4;
  tables.tools.tools[0].radius_wear = -0.1;
  tables.offsets.offsets.push_back({0, 53, {1, 2, 3}});
  const ChannelSetup setup(tables);
  const auto tool = setup.tool_offset(1);
  ASSERT_TRUE(tool.has_value());
  EXPECT_EQ(tool->length, 100);
  EXPECT_EQ(tool->radius, 4);
  EXPECT_EQ(tool->radius_wear, -0.1);
  EXPECT_EQ(setup.work_offset(53)[language::Y], 2);  // G54.1 P48
}

TEST(ChannelSetup, OrientsTheToolWithinTheTravelOfTheRotaryAxes) {
  const ChannelSetup setup(load_machine_tables(ac_table));
  // 30 degrees from Z towards -Y of the workpiece: the tip of a shorter tool lies in that direction.
  const auto turned = setup.orient({0, -0.5, std::sqrt(0.75)}, {}, language::RotaryChoice::shortest);
  ASSERT_TRUE(turned.has_value());
  const auto tip = setup.tip_from_machine(*turned, 1);
  const auto gauge = setup.tip_from_machine(*turned, 0);
  EXPECT_NEAR(gauge[0] - tip[0], 0, 1e-9);
  EXPECT_NEAR(gauge[1] - tip[1], -0.5, 1e-9);
  EXPECT_NEAR(gauge[2] - tip[2], std::sqrt(0.75), 1e-9);
  // From below no table can be cut.
  EXPECT_EQ(setup.orient({0, 0, -1}, {}, language::RotaryChoice::shortest), std::nullopt);
}

TEST(ChannelSetup, AMoveOutOfTravelIsToldWithLineAxisAndLimits) {
  const ChannelSetup setup(load_machine_tables(ac_table));
  language::Command move;
  move.kind = language::CommandKind::line;
  move.line = 7;
  move.target = {500};
  EXPECT_EQ(setup.travel_error({}, move), "7: X would go to 500.0000, its travel is -400.0000 .. 400.0000");
  move.target = {400};
  EXPECT_EQ(setup.travel_error({}, move), "");
}

TEST(MachineTables, AChannelTheMachineDoesNotHaveIsRefused) {
  EXPECT_THROW(load_machine_tables(ac_table, 1), std::runtime_error);
  EXPECT_EQ(load_machine_tables(MACHINES_DIRECTORY "/two-channel", 1).channel, 1);
}

TEST(MachineTables, AWrongTableIsRefusedWithItsPlace) {
  const fs::path copy = fs::temp_directory_path() / ("setup_test_" + std::to_string(getpid()));
  fs::copy(ac_table, copy, fs::copy_options::recursive);
  std::ofstream(copy / tools_file) << "- {number: 1, length: long}\n";
  std::string message;
  try {
    load_machine_tables(copy.string());
  } catch (const std::runtime_error& e) {
    message = e.what();
  }
  fs::remove_all(copy);
  EXPECT_NE(message.find("tools.yaml:1:23: error: 'length'"), std::string::npos) << message;
}

}  // namespace
}  // namespace trunnion::setup
