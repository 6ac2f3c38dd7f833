// SPDX-License-Identifier: Apache-2.0
#include "channel_setup/channel_setup.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <utility>
#include <vector>

#include "parameter_store/tool_tables.hpp"
#include "reading.hpp"

namespace trunnion::channel_setup {
namespace {

namespace fs = std::filesystem;

const std::string ac_table = MACHINES_DIRECTORY "/ac-table";

TEST(ChannelSetup, ReadsAxesToolsOffsetsAndTravelOfAMachineFolder) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table));
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

// `check` without a machine, and every machine whose builder says nothing, look for interference alike.
TEST(ChannelSetup, CutterCompensationOfAMachineHasTheDefaultsOfTheLanguage) {
  const language::CutterSettings own,
      of_machine = ChannelSetup(tool_tables::load_machine_tables(ac_table)).cutter_settings();
  EXPECT_TRUE(own.interference_check);
  EXPECT_EQ(of_machine.interference_check, own.interference_check);
  EXPECT_EQ(of_machine.check_blocks, own.check_blocks);
  EXPECT_EQ(of_machine.feed_at_contour, own.feed_at_contour);
}

TEST(ChannelSetup, WearCountsInTheToolLength) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  tables.tools.tools[0].length_wear = -0.25;
  EXPECT_EQ(ChannelSetup(tables).tool_length(1), 99.75);
  const auto tool = ChannelSetup(tables).tool_offset(1);
  ASSERT_TRUE(tool.has_value());
  EXPECT_EQ(tool->length, 100);
  EXPECT_EQ(tool->length_wear, -0.25);
  EXPECT_EQ(tool->radius, tables.tools.tools[0].radius);
}

TEST(ChannelSetup, ASpeedAboveTheHighestOfTheSpindleOfTheChannelIsRefused) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const auto first = ChannelSetup(tables).tapping_spindle().axis.value();
  const auto alarm = [&](const std::string& text) {
    ChannelSetup setup(tables);
    return test::read(setup, text);
  };
  tables.parameters.values.erase(100948 + 1000u * first);
  EXPECT_EQ(alarm("S99999 M3").alarm, 0u) << "no limit is stated";
  tables.parameters.values[100948 + 1000u * first].value = 12000;
  EXPECT_EQ(alarm("S12000 M3").alarm, 0u);
  EXPECT_EQ(alarm("S12000 M3\nG1 X1 F100 S12001").line, 2u);
  EXPECT_EQ(alarm("S12001").text,
            "speed above the highest of the spindle: S12001, at most 12000 1/min (10a948)");
  EXPECT_EQ(alarm("G96 S12001 M3").alarm, 0u) << "m/min";
  EXPECT_EQ(alarm("G92 S20000").alarm, 0u) << "a limit of a program above that of the machine";
  // Another spindle of the machine, which 040913 gives to the channel.
  const std::uint32_t second = first + 10u;
  tables.parameters.values[100000 + 1000 * second].text = "S2";
  tables.parameters.values[100001 + 1000 * second].value = 10;
  tables.parameters.values[100948 + 1000 * second].value = 6000;
  EXPECT_EQ(alarm("S6001").alarm, 0u);
  tables.parameters.values[40913].value = second;
  EXPECT_EQ(alarm("S6001").alarm, 1126u);
}

TEST(ChannelSetup, ASpeedAboveThatOfTheHighestGearIsRefused) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const std::uint32_t of_spindle = 1000u * ChannelSetup(tables).tapping_spindle().axis.value();
  const auto alarm = [&](const std::string& text) {
    ChannelSetup setup(tables);
    return test::read(setup, text);
  };
  tables.parameters.values[100948 + of_spindle].value = 12000;
  tables.parameters.values[100985 + of_spindle].value = 900;   // gear 1
  tables.parameters.values[100987 + of_spindle].value = 3500;  // gear 3; there is no gear 2
  EXPECT_EQ(alarm("S3500").alarm, 0u);
  EXPECT_EQ(alarm("S3501").text,
            "speed above the highest of the spindle: S3501, at most 3500 1/min (10a985)");
  tables.parameters.values[100948 + of_spindle].value = 3000;
  EXPECT_EQ(alarm("S3001").text,
            "speed above the highest of the spindle: S3001, at most 3000 1/min (10a948)");
}

// Gear 1 up to 1000 1/min, gear 2 up to 4000; the spindle up to 3000.
TEST(ChannelSetup, TheHighestSpeedOfASpindleIsThatOfItsGearToo) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const std::uint32_t of_spindle = 1000u * ChannelSetup(tables).tapping_spindle().axis.value();
  tables.parameters.values[100948 + of_spindle].value = 3000;
  tables.parameters.values[100985 + of_spindle].value = 1000;
  tables.parameters.values[100986 + of_spindle].value = 4000;
  const ChannelSetup setup(tables);
  const auto& spindle = setup.tapping_spindle();
  EXPECT_EQ(spindle.highest_speed_in(0), 3000);
  EXPECT_EQ(spindle.highest_speed_in(1), 1000);
  EXPECT_EQ(spindle.highest_speed_in(2), 3000);
  EXPECT_EQ(spindle.highest_speed_in(3), 3000) << "there is no such gear";
  EXPECT_EQ(spindle.highest_speed_in(6), 3000);
}

// 9000 deg/s2 up to 1500 1/min: at 3000 half of it, and beyond the power speed of 4000, at 8000, half of what
// that power would give.
TEST(ChannelSetup, TheAccelerationOfASpindleFallsWithItsSpeedWhereTheParametersSaySo) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const std::uint32_t of_spindle = 1000u * ChannelSetup(tables).tapping_spindle().axis.value();
  const auto at = [&](double speed) {
    return ChannelSetup(tables).tapping_spindle().acceleration_up_to(speed);
  };
  tables.parameters.values[100036 + of_spindle].value = 9000;
  EXPECT_EQ(at(3000), 9000) << "10a971 is 0";
  tables.parameters.values[100971 + of_spindle].value = 1;
  EXPECT_EQ(at(3000), 9000) << "alarm 182: there is no base speed";
  tables.parameters.values[100972 + of_spindle].value = 1500;
  tables.parameters.values[100973 + of_spindle].value = 4000;
  EXPECT_EQ(at(1500), 9000);
  EXPECT_DOUBLE_EQ(at(3000), 4500);
  EXPECT_DOUBLE_EQ(at(8000), 9000 * 1500.0 / 8000 / 2);
}

// 010920 .. 010923.
TEST(ChannelSetup, TheParametersNameTheCodesWithAnAngle) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  EXPECT_EQ(ChannelSetup(tables).angle_m_codes(), (language::AngleMCodes{19, -1, -1, -1}));
  tables.parameters.values[10921].value = 80;
  tables.parameters.values[10923].value = 81;
  EXPECT_EQ(ChannelSetup(tables).angle_m_codes(), (language::AngleMCodes{19, 80, -1, 81}));
  EXPECT_EQ(test::setup_of("lathe").angle_m_codes(), (language::AngleMCodes{19, 80, 81, -1}));
}

// HNC-8: 040007 (U) = -2 makes U the spindle that G84 J4 taps with. Further letters are the spindles behind
// 040913.
TEST(ChannelSetup, LettersWithAxisNumberMinusTwoAreTheTappingSpindles) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const ChannelSetup plain(tables);
  const auto spindle = plain.tapping_spindle().axis;
  ASSERT_TRUE(spindle);
  EXPECT_EQ(plain.spindle_axes(), 0);
  EXPECT_FALSE(plain.tapping_spindle(4).axis);
  tables.parameters.values[40007].value = -2;
  tables.parameters.values[40008].value = -3;
  tables.parameters.values[40009].value = -2;
  const ChannelSetup setup(tables);
  EXPECT_EQ(setup.channel_axes().letters, "XYZAC");
  EXPECT_EQ(setup.spindle_axes(), 1u << language::U | 1u << language::W);
  EXPECT_EQ(setup.tapping_spindle().axis, spindle);
  EXPECT_EQ(setup.tapping_spindle(4).axis, spindle);
  EXPECT_EQ(setup.tapping_spindle(4).ramp.acceleration, setup.tapping_spindle().ramp.acceleration);
  EXPECT_FALSE(setup.tapping_spindle(5).axis);
  EXPECT_FALSE(setup.tapping_spindle(6).axis);  // the machine has one spindle only
}

// 180 degrees are straight on: an interior angle of 100 is a turn by 80.
TEST(ChannelSetup, TheSmoothCornerAngleIsAnInteriorAngle) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  EXPECT_EQ(ChannelSetup(tables).limits().smooth_corner_angle, 120);
  EXPECT_EQ(ChannelSetup(tables).limits().modes[0].smooth_corner_angle, 80);
  EXPECT_EQ(ChannelSetup(tables).limits().modes[1].smooth_corner_angle, 120);
  tables.parameters.values[40903].value = 100;
  EXPECT_EQ(ChannelSetup(tables).limits().smooth_corner_angle, 80);
}

// X of the machine: 30000 mm/min rapid, 20000 feed, 4000 mm/s2. A tenth belongs to the volumetric
// compensation.
TEST(ChannelSetup, TheVolumetricCompensationHasItsShareOfTheLimits) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const auto off = ChannelSetup(tables).limits().axes[0];
  EXPECT_DOUBLE_EQ(off.rapid_velocity, 500);
  tables.parameters.values[40954] = {0.1, ""};
  EXPECT_EQ(ChannelSetup(tables).limits().axes[0].rapid_velocity, off.rapid_velocity) << "it is off";
  tables.parameters.values[40951] = {1, ""};
  const auto on = ChannelSetup(tables).limits().axes[0];
  EXPECT_DOUBLE_EQ(on.rapid_velocity, 450);
  EXPECT_DOUBLE_EQ(on.velocity, 300);
  EXPECT_DOUBLE_EQ(on.acceleration, 3600);
  EXPECT_DOUBLE_EQ(on.jerk, 0.9 * off.jerk);
}

TEST(ChannelSetup, CompensationParametersThatMakeNoSenseAreRefused) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  tables.parameters.values[300020] = {1, ""};
  tables.parameters.values[300022] = {2, ""};
  tables.parameters.values[300026] = {709999, ""};
  try {
    ChannelSetup setup(tables);
    FAIL() << "taken";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "parameter 300026 (pitch_table) is 709999: 2 values end after 709999");
  }
}

TEST(ChannelSetup, MCodesOfUserCyclesAreParameters) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(3), 0);
  tables.parameters.values[10173] = {130, ""};  // 010173: M code of G1010
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(3), 130);
  EXPECT_EQ(ChannelSetup(tables).cycle_m_code(4), 0);
}

TEST(ChannelSetup, ToolOffsetsCarryLengthRadiusAndWear) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  tables.tools.tools[0].radius_wear = 0.02;
  const auto tool = ChannelSetup(tables).tool_offset(1);
  ASSERT_TRUE(tool);
  EXPECT_EQ(tool->length, 100);
  EXPECT_EQ(tool->radius, 10);
  EXPECT_EQ(tool->radius_wear, 0.02);
  EXPECT_FALSE(ChannelSetup(tables).tool_offset(9));
}

TEST(ChannelSetup, FurtherWorkOffsetsFollowTheFirstSix) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  idl::parameters::WorkOffset offset;
  offset.index = 6;  // G54.1 P1
  offset.values = {1, 2, 3, 0, 0, 0, 0, 0, 0};
  tables.offsets.offsets.push_back(offset);
  EXPECT_EQ(ChannelSetup(tables).work_offset(6)[language::Y], 2);
  EXPECT_EQ(tool_tables::work_offset_code(0), "G54");
  EXPECT_EQ(tool_tables::work_offset_code(53), "G54.1P48");
  EXPECT_EQ(tool_tables::work_offset_code(54), "EXT");
  offset.index = 54;
  offset.values = {10, 20, 30, 0, 0, 0, 0, 0, 0};
  tables.offsets.offsets.push_back(offset);
  EXPECT_EQ(ChannelSetup(tables).external_offset()[language::Y], 20);
  EXPECT_EQ(ChannelSetup(tables).workpiece_zero(6)[language::Y], 22);
  EXPECT_EQ(ChannelSetup(tables).work_offset(6)[language::Y], 2);
}

TEST(ChannelSetup, ATiltedToolDirectionGivesTheRotaryAnglesOfTheMachine) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table));
  // A turns about -X: a table at A30 lifts the workpiece's +Y towards the spindle, so the tool points along
  // (0, sin 30, cos 30) or its opposite with C turned by 180 degrees.
  const double s = std::sin(std::numbers::pi / 6), c = std::cos(std::numbers::pi / 6);
  const auto angles = setup.orient({0, s, c}, {}, language::RotaryChoice::shortest);
  ASSERT_TRUE(angles);
  const auto tip = setup.tip_from_machine({(*angles)[0], (*angles)[1], 0, (*angles)[3], 0, (*angles)[5]}, 0);
  const auto above = setup.tip_from_machine({0, 0, 1, (*angles)[3], 0, (*angles)[5]}, 0);
  EXPECT_NEAR(above[0] - tip[0], 0, 1e-12);
  EXPECT_NEAR(above[1] - tip[1], s, 1e-12);
  EXPECT_NEAR(above[2] - tip[2], c, 1e-12);
  EXPECT_NEAR(std::abs((*angles)[3]), 30, 1e-9);
  EXPECT_FALSE(setup.orient({0, 0, -1}, {}, language::RotaryChoice::shortest)) << "A does not turn over";
}

TEST(ChannelSetup, PlanesNobodyHasEnteredDoNotExist) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  // Plane 2: origin 1 2 3, X towards 2 2 3, Y towards 1 3 3; 04c500 + 9 .. 04c500 + 17.
  const double points[] = {1, 2, 3, 2, 2, 3, 1, 3, 3};
  for (std::uint32_t i = 0; i < 9; ++i) tables.parameters.values[40509 + i] = {points[i], ""};
  const ChannelSetup setup(tables);
  EXPECT_FALSE(setup.plane_points(1));
  EXPECT_FALSE(setup.plane_points(21));
  ASSERT_TRUE(setup.plane_points(2));
  EXPECT_EQ((*setup.plane_points(2))[2], (language::Vector3{1, 3, 3}));
}

TEST(ChannelSetup, ATableThatTurnsCarriesTheTipAlong) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table));
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

TEST(ChannelSetup, AMoveOutOfTravelIsToldWithLineAxisAndLimits) {
  const ChannelSetup setup(tool_tables::load_machine_tables(ac_table));
  language::Command move;
  move.kind = language::CommandKind::line;
  move.line = 7;
  move.target = {500};
  EXPECT_EQ(setup.travel_error({}, move), "7: X would go to 500.0000, its travel is -400.0000 .. 400.0000");
  move.target = {400};
  EXPECT_EQ(setup.travel_error({}, move), "");
}

TEST(ChannelSetup, ProgramsAreInTheDialectOfTheChannel) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const auto alarm = [&] {
    ChannelSetup setup(tables);
    return test::read(setup, "G4 F1\nM2").alarm;
  };
  EXPECT_EQ(alarm(), 1540u) << "G4 of ISO has no F";
  tables.parameters.values[40959] = {1, ""};
  EXPECT_EQ(alarm(), 0u);
}

TEST(ChannelSetup, NamesOfProgramsMayChooseTheirDialect) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  tables.parameters.values[40800] = {0, ".num num"};
  const ChannelSetup setup(tables);
  EXPECT_EQ(setup.dialect_by_name("SHAFT.num"), language::ProgramDialect::num);
  EXPECT_EQ(setup.dialect_by_name("shaft.nc"), std::nullopt);
  EXPECT_EQ(setup.dialect_by_name("O99601.tmp.nc"), language::ProgramDialect::iso)
      << "the control has written it itself";
  tables.parameters.values[40800] = {0, ".num fanuc"};
  try {
    ChannelSetup{tables};
    ADD_FAILURE() << "a dialect that is none";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(),
                 "parameter 040800 (program_dialects): '.num' needs one dialect: iso, num, linuxcnc, haas");
  }
}

TEST(ChannelSetup, ADialectThatIsAskedForGoesBeforeThatOfTheMachine) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  tables.parameters.values[40800] = {0, ".nc iso"};
  ChannelSetup setup(tables);
  setup.set_program_dialect(language::ProgramDialect::num);
  EXPECT_EQ(setup.program_dialect(), language::ProgramDialect::num);
  EXPECT_EQ(setup.dialect_by_name("part.nc"), std::nullopt);
}

TEST(ChannelSetup, MacrosOfTheControlAreIsoInEveryChannel) {
  for (const char* name : {"O9801", "O9810", "O9960"})
    EXPECT_EQ(control_macro(name)->dialect(), language::ProgramDialect::iso) << name;
  EXPECT_EQ(control_macro("O9999"), nullptr);
}

TEST(ChannelSetup, ExternalParametersOfNumAreThoseOfTheSpindles) {
  auto tables = tool_tables::load_machine_tables(ac_table);
  const auto first = 100000 + 1000u * ChannelSetup(tables).tapping_spindle().axis.value();
  tables.parameters.values[first + 974] = {2, ""};
  tables.parameters.values[first + 975] = {300, ""};
  tables.parameters.values[first + 972] = {1500, ""};
  const ChannelSetup setup(tables);
  // 2 degrees of 360 are 2 / 360 * 65536 = 364.089 parts of a revolution.
  EXPECT_NEAR(setup.external_parameter(90310).value(), 364.0889, 1e-4);
  EXPECT_EQ(setup.external_parameter(90320), 300);
  EXPECT_EQ(setup.external_parameter(90330), setup.tapping_spindle().ramp.acceleration);
  EXPECT_EQ(setup.external_parameter(90370), 1500);
  EXPECT_EQ(setup.external_parameter(90323), std::nullopt) << "the machine has no fourth spindle";
  EXPECT_EQ(setup.external_parameter(91124), std::nullopt) << "its state is not known when the text is read";
  EXPECT_EQ(setup.external_parameter(98024), 500) << "10a976, the default";
  EXPECT_EQ(setup.external_parameter(90360), 0);

  using Changes = std::vector<std::pair<std::uint32_t, double>>;
  const auto changes = [&](std::uint32_t number, double value) {
    const auto all = setup.external_changes(number, value);
    Changes list;
    for (std::size_t i = 0; i < all.count; ++i) list.emplace_back(all.list[i].number, all.list[i].value);
    return list;
  };
  EXPECT_EQ(changes(90320, 400), (Changes{{first + 975, 400}}));
  // 65536 parts are a revolution.
  EXPECT_NEAR(changes(90310, 32768).at(0).second, 180, 1e-9);
  EXPECT_EQ(changes(90360, 1000), (Changes{{first + 977, 1}, {first + 971, 1}}));
  EXPECT_EQ(changes(90360, 1), (Changes{{first + 977, 0}, {first + 971, 1}}));
  EXPECT_EQ(changes(90360, 0), (Changes{{first + 977, 0}, {first + 971, 0}}));
  EXPECT_TRUE(changes(90323, 1).empty());
}

}  // namespace
}  // namespace trunnion::channel_setup
