// SPDX-License-Identifier: Apache-2.0
#include "machine/kinematics.hpp"

#include <gtest/gtest.h>

#include <random>

#include "machine/alarm_constants.hpp"
#include "machine/chain_section.hpp"
#include "machine/machine.hpp"
#include "machine/yaml.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::machine {
namespace {

using geometry::Angles;
using geometry::Vec3;

Parameters with(std::map<std::uint32_t, double> values) {
  Parameters p;
  for (const auto& [number, value] : values) p.values[number] = {value, ""};
  return p;
}

// Section 3 of the five-axis specification: A(-1,0,0), C(0,0,-1).
Parameters ac_table() {
  return with({{40425, 35}, {40426, -1}, {40431, -1}, {40433, 0.1028}, {40435, -200}, {40437, -516}});
}

std::string error_of(const Parameters& p, const AlarmDefinition** raised = nullptr) {
  try {
    make_chain(p, 0);
  } catch (const KinematicsError& e) {
    if (raised != nullptr) *raised = &e.alarm();
    return e.what();
  }
  return "";
}

// ISO 841: the axes are named after the motion of the tool seen from the workpiece, so +A of a table turns
// the workpiece about -X and leaves the tool turned about +X: from +Z towards -Y. +C turns the workpiece
// about -Z: a tool that leans to -Y leans, seen from the workpiece, to -Y turned about +Z, which is +X.
TEST(Sign, a_positive_table_angle_turns_the_tool_about_the_positive_axis_of_the_workpiece) {
  const auto chain = make_chain(ac_table(), 0);
  const double h = 0.5, w = std::sqrt(0.75);
  EXPECT_LT((chain.tool_direction_in_workpiece({30, 0, 0}) - Vec3(0, -h, w)).norm(), 1e-15);
  EXPECT_LT((chain.tool_direction_in_workpiece({30, 0, 90}) - Vec3(h, 0, w)).norm(), 1e-15);
  // The workpiece itself: A axis through Y 0.1028 Z -516, a point 100 before it goes up by 50 under +A30.
  EXPECT_LT((chain.machine_from_tip(Vec3(0, 0.1028 - 100, -516), {30, 0, 0}, 0) -
             Vec3(0, 0.1028 - 100 * w, -516 + 100 * h))
                .norm(),
            1e-12);
}

// CB head: +B turns the tool itself about +Y, the spindle leans to +X.
TEST(Sign, a_positive_head_angle_turns_the_tool_about_the_positive_axis) {
  const auto chain = make_chain(with({{40410, 54}, {40413, 1}, {40415, 1}, {40422, 200}}), 0);
  const double h = 0.5, w = std::sqrt(0.75);
  EXPECT_LT((chain.tool_direction_in_workpiece({0, 30, 0}) - Vec3(h, 0, w)).norm(), 1e-15);
  EXPECT_LT((chain.tool_direction_in_workpiece({0, 30, 90}) - Vec3(0, h, w)).norm(), 1e-15);
}

TEST(Kinematics, faulty_parameters_have_an_alarm_each_and_a_line_that_names_them) {
  const AlarmDefinition* raised = nullptr;
  auto p = ac_table();
  p.values[40426] = {0, ""};
  EXPECT_EQ(error_of(p, &raised), "channel 0, parameters 040426 .. 040428: the direction of an axis is zero");
  EXPECT_EQ(raised, &alarm::kinematics_zero_direction);
  p = ac_table();
  p.values[40426] = {0, ""};
  p.values[40428] = {1, ""};
  EXPECT_EQ(error_of(p, &raised), "channel 0, parameters 040400 .. 040437: the rotary axes are parallel");
  EXPECT_EQ(raised, &alarm::kinematics_parallel_axes);
  p = ac_table();
  p.values[40435] = {std::numeric_limits<double>::quiet_NaN(), ""};
  EXPECT_EQ(error_of(p, &raised), "channel 0, parameters 040400 .. 040437: a value is not finite");
  EXPECT_EQ(raised, &alarm::kinematics_not_finite);
  p = ac_table();
  p.values[40425] = {39, ""};
  EXPECT_EQ(error_of(p, &raised),
            "parameter 040425 (table_type): digit 9 is not 3 (A), 4 (B), 5 (C), 6 (U), 7 (V) or 8 (W)");
  EXPECT_EQ(raised, &alarm::kinematics_invalid);
  p = ac_table();
  p.values[40425] = {33, ""};
  EXPECT_EQ(error_of(p), "channel 0, parameters 040400 .. 040437: two rotary axes have the same letter");
}

TEST(Kinematics, a_direction_that_is_not_one_long_is_a_warning) {
  auto p = ac_table();
  EXPECT_TRUE(kinematics_warnings(p, 0).empty());
  p.values[40430] = {-1, ""};
  EXPECT_EQ(
      kinematics_warnings(p, 0),
      std::vector<std::string>{"parameters 040429 .. 040431 (table_direction_2): the direction is 1.41421 "
                               "long and is normalized"});
}

TEST(Kinematics, travels_are_those_of_the_axes_the_channel_has) {
  const auto p = with({{40004, 3}, {40006, 7}, {103006, 110}, {103007, -100}, {107006, 5}, {107007, -5}});
  const auto travels = rotary_travels(p, 0);
  EXPECT_EQ(travels[0].positive, 110);
  EXPECT_EQ(travels[0].negative, -100);
  EXPECT_EQ(travels[2].positive, 5);
  EXPECT_TRUE(travels[1].endless());
}

const std::string chains = R"(- elements:
    - {name: TABLE_OFFSET, offset: [-200, -190, -516]}
    - {name: CORR_C_OFFSET, correction: [-0.3605, 0.0103, 0.0118]}
    - {name: C_AXIS, rotary: C, direction: [2.0e-4, 1.0e-5, -1]}
    - {name: A_OFFSET, offset: [0, 0.1028, 0]}
    - {name: A_AXIS, rotary: A, direction: [-1, 0, 9.3e-5]}
    - {name: Y_AXIS, linear: Y}
    - {name: X_AXIS, linear: X}
    - {name: Z_AXIS, linear: Z, direction: [0, 1.0e-4, 1]}
    - {name: B_AXIS, rotary: B, direction: [0, 1, 0]}
    - {name: SP1_OFFSET, offset: [0.1, 0, -180]}
    - {name: CORR_SP1_OFFSET, correction: [0.001, 0.002, -0.003]}
)";

TEST(Chains, the_section_of_machine_yaml_and_its_parameters_give_the_same_numbers) {
  const auto node = parse_yaml(chains, "m");
  Parameters p;
  p.values = read_chain_parameters(node, "m");
  EXPECT_EQ(p.at(40425), 35);
  EXPECT_EQ(p.at(40410), 4);
  EXPECT_EQ(p.at(40435), -200);
  EXPECT_EQ(p.at(40960), -0.3605);
  EXPECT_EQ(p.at(40422), 180);
  EXPECT_EQ(p.at(40971), 0.003) << "a head's vectors point from the tool to the base";
  const auto from_parameters = make_chain(p, 0);
  // Once more as text, as the parameters service keeps them.
  Parameters kept;
  kept.values = read_parameter_text(write_parameter_text(p.values), "kept");
  const auto from_text = make_chain(kept, 0);
  const auto direct = std::get<geometry::Chain>(geometry::Chain::make(
      std::get<geometry::ChainParameters>(geometry::parameters_of(read_chains(node, "m").at(0)))));
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> value(-300, 300);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 w(value(random), value(random), value(random));
    const Angles a{value(random), value(random), value(random)};
    ASSERT_EQ(direct.machine_from_tip(w, a, 88), from_parameters.machine_from_tip(w, a, 88));
    ASSERT_EQ(direct.machine_from_tip(w, a, 88), from_text.machine_from_tip(w, a, 88));
    ASSERT_EQ(direct.tool_direction_in_workpiece(a), from_text.tool_direction_in_workpiece(a));
  }
}

// Z hangs in the B head, and the table's C carries X: Y alone stands next to the base.
TEST(Chains, carried_linear_axes_are_parameters_and_give_the_same_bits) {
  const auto node = parse_yaml(R"(- elements:
    - {name: X_AXIS, linear: X}
    - {name: C_OFFSET, offset: [10, 20, 0]}
    - {name: C_AXIS, rotary: C, direction: [0, 0, -1]}
    - {name: BASE, base: true}
    - {name: Y_AXIS, linear: Y}
    - {name: B_AXIS, rotary: B, direction: [0, 1, 0]}
    - {name: Z_AXIS, linear: Z}
    - {name: SP1_OFFSET, offset: [0.1, 0, -180]}
)",
                               "m");
  Parameters p;
  p.values = read_chain_parameters(node, "m");
  EXPECT_EQ(p.at(40905), -1);
  EXPECT_EQ(p.at(40906), 0);
  EXPECT_EQ(p.at(40907), 1);
  const auto from_parameters = make_chain(p, 0);
  const auto direct = std::get<geometry::Chain>(geometry::Chain::make(
      std::get<geometry::ChainParameters>(geometry::parameters_of(read_chains(node, "m").at(0)))));
  for (double angle = -60; angle <= 60; angle += 7.5) {
    const Angles a{0, angle, angle / 2};
    ASSERT_EQ(direct.machine_from_tip(Vec3(1, 2, 3), a, 88),
              from_parameters.machine_from_tip(Vec3(1, 2, 3), a, 88));
  }
  for (const auto& [number, value] : p.values) EXPECT_TRUE(is_chain_parameter(number)) << number;
  for (const std::uint32_t number : {40100, 40403, 40904, 40908, 40950, 40989, 40990, 100006})
    EXPECT_FALSE(is_chain_parameter(number)) << number;
  p.values[40907] = {2, ""};
  const AlarmDefinition* raised = nullptr;
  EXPECT_EQ(error_of(p, &raised),
            "channel 0, parameters 040905 .. 040907: a linear axis is carried by more rotary axes than its "
            "side has");
  EXPECT_EQ(raised, &alarm::kinematics_invalid);
}

// The C axis stands at X-200.3605, so C180 takes the point X0 Y0 to X-400.721; with a correction of X0.5 it
// stands at X-199.5 and takes it to X-399.
TEST(Chains, a_correction_is_found_by_its_name_and_changes_what_it_corrects) {
  Parameters p;
  p.values = read_chain_parameters(parse_yaml(chains, "m"), "m");
  const auto elements = correction_elements(p, 0);
  ASSERT_EQ(elements.size(), 2u);
  EXPECT_EQ(elements[0].name, "CORR_C_OFFSET");
  EXPECT_EQ(elements[0].number, 40960u);
  EXPECT_EQ(elements[0].sign, 1);
  EXPECT_EQ(elements[1].name, "CORR_SP1_OFFSET");
  EXPECT_EQ(elements[1].number, 40969u);
  EXPECT_EQ(elements[1].sign, -1);
  const auto at_c180 = [&] { return make_chain(p, 0).machine_from_tip(Vec3::Zero(), {0, 0, 180}, 0).x(); };
  // C leans by 2e-4, which takes the point 190 and 516 mm away from its foot by some tenths.
  const double before = at_c180();
  EXPECT_NEAR(before, 2 * -200.3605, 0.3);
  p.values[elements[0].number] = {0.5, ""};
  EXPECT_NEAR(at_c180() - before, 2 * 0.8605, 1e-6);
}

// Along an open chain the correction moves the tip as the offset beside it would, in a closed one it moves
// the axis alone.
TEST(Chains, a_correction_counts_as_an_offset_in_open_and_closed_chains) {
  const auto chain = [](const std::string& closed, const std::string& offset, const std::string& correction) {
    Parameters p;
    p.values = read_chain_parameters(
        parse_yaml("- closed: " + closed + "\n  elements:\n    - {name: O, offset: " + offset +
                       "}\n    - {name: K, correction: " + correction +
                       "}\n    - {name: C, rotary: C, direction: [0, 0, -1]}\n    - {name: X, linear: X}\n"
                       "    - {name: Y, linear: Y}\n    - {name: Z, linear: Z}\n",
                   "m"),
        "m");
    return make_chain(p, 0);
  };
  for (const char* closed : {"true", "false"}) {
    const auto apart = chain(closed, "[10, 20, 30]", "[0.5, 0.25, -0.125]");
    const auto together = chain(closed, "[10.5, 20.25, 29.875]", "[0, 0, 0]");
    for (const double c : {0.0, 37.0, 180.0})
      EXPECT_LT((apart.tip_from_machine(Vec3(1, 2, 3), {0, 0, c}, 50) -
                 together.tip_from_machine(Vec3(1, 2, 3), {0, 0, c}, 50))
                    .norm(),
                1e-12);
  }
}

std::string chains_error(const std::string& text) {
  return testing_support::refusal_of([&] { read_chain_parameters(parse_yaml(text, "m"), "m"); });
}

TEST(Chains, errors_name_line_and_column) {
  EXPECT_EQ(chains_error("- elements:\n    - {name: X, linear: Q}\n"),
            "m:2:25: error: 'Q' is none of the axes XYZ");
  EXPECT_EQ(chains_error("- elements:\n    - {name: C, rotary: C}\n"),
            "m:2:7: error: a rotary axis without a direction");
  EXPECT_EQ(chains_error("- elements:\n    - {name: O, offset: [1, 2]}\n"),
            "m:2:25: error: expected [x, y, z]");
  EXPECT_EQ(chains_error("- elements:\n    - {name: O, offset: [1, .nan, 2]}\n"),
            "m:2:25: error: a value is not finite");
  EXPECT_EQ(chains_error("- elements:\n    - {name: O, offset: [1, a, 2]}\n"),
            "m:2:29: error: expected a number");
  EXPECT_EQ(chains_error("- elements:\n    - {name: O}\n"),
            "m:2:7: error: an element is one of offset, correction, rotary, linear and base");
  EXPECT_EQ(chains_error("- elements:\n    - {name: BASE, base: 1}\n"),
            "m:2:26: error: 'base' can only be true");
  EXPECT_EQ(chains_error("- elements:\n    - {name: X, linear: X}\n"),
            "m:1:3: error: each of X, Y and Z must be there once");
  EXPECT_EQ(chains_error("- elements:\n    - {name: X, linear: X}\n    - {name: X, linear: Y}\n"),
            "m:3:7: error: 'X' is there twice");
  EXPECT_EQ(chains_error("- channel: 12\n  elements: []\n"), "m:1:12: error: channel must be 0 .. 9");
  EXPECT_EQ(chains_error(chains + chains), "m:13:3: error: channel 0 has two chains");
  EXPECT_EQ(
      chains_error("- elements:\n    - {name: C, rotary: C, direction: [0, 0, 7]}\n    - {name: X, linear: "
                   "X}\n    - {name: Y, linear: Y}\n    - {name: Z, linear: Z}\n"),
      "m:1:3: error: parameter 040431 (table_direction_2): 7 is outside -1 .. 1");
}

}  // namespace
}  // namespace trunnion::machine
