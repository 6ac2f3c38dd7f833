// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <sstream>

#include "calibration/measuring_program.hpp"
#include "geometry/angle.hpp"
#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration {
namespace {

// The straight moves of a program: X, Y and Z of each G53 G1 line.
std::vector<Vec3> moves_of(const std::string& program) {
  std::vector<Vec3> moves;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);) {
    Vec3 at;
    if (std::sscanf(line.c_str(), "G53 G1 X%lf Y%lf Z%lf", &at[0], &at[1], &at[2]) == 3) moves.push_back(at);
  }
  return moves;
}

struct ProgramCase {
  Positioning positioning;
  std::size_t touches;
  Vec3 shaft;
};

class MeasuringProgram : public testing::TestWithParam<ProgramCase> {};

TEST_P(MeasuringProgram, NeverComesNearerToSphereOrShaftThanTheMeasuringPath) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  auto in = default_inputs(machine.measured);
  in.sphere = Vec3(-120, -130, -420);
  in.probe_length = 150;
  in.positioning = GetParam().positioning;
  in.touches = GetParam().touches;
  in.shaft = GetParam().shaft;
  in.measuring_path = 3;
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto chain = geometry::make(machine.measured.model);
  std::size_t arcs = 0;
  for (const auto& pose : plan.poses) {
    const Vec3 centre = chain.machine_from_tip(in.sphere, pose.angles, in.probe_length);
    const Vec3 shaft = (chain.jacobian(in.sphere, pose.angles, in.probe_length).tip * *in.shaft).normalized();
    const auto above = approach_position(in, pose, centre);
    const auto text = measuring_program(in, machine.measured, pose, centre, {above, above}, {7});
    EXPECT_THAT(text, testing::HasSubstr("#52999=7\n"));
    const auto moves = moves_of(text);
    arcs += moves.size() > 4 * pose.directions.size();
    for (std::size_t i = 1; i < moves.size(); ++i)
      for (int k = 0; k <= 50; ++k) {
        const Vec3 ball = moves[i - 1] + k / 50.0 * (moves[i] - moves[i - 1]) - centre;
        // Radii 12.5 and 3 with 3 of measuring path; a chord of 10 degrees is cos 5 degrees nearer.
        ASSERT_GE(ball.norm(), 18.5 * std::cos(geometry::radians_per_degree * 5) - 1e-5) << text;
        const double beside = ball.dot(shaft) > 0 ? ball.cross(shaft).norm() : ball.norm();
        ASSERT_GE(beside, (6 + in.shaft_diameter) / 2) << text;
      }
  }
  // Where the shaft is below, the way around the equator is free at the pose of the start at least.
  EXPECT_EQ(arcs > 0, GetParam().positioning == Positioning::circular);
}

INSTANTIATE_TEST_SUITE_P(Ways, MeasuringProgram,
                         testing::Values(ProgramCase{Positioning::paraxial, 10, {0, 0, -1}},
                                         ProgramCase{Positioning::circular, 10, {0, 0, -1}},
                                         ProgramCase{Positioning::circular, 8, {0, -1, -1}},
                                         ProgramCase{Positioning::paraxial, 8, {1, 0, -1}}));

TEST(MeasuringProgramText, GoesUpBeforeItTurnsAndDownLast) {
  const AxisPosition from{1, 2, -100, 10, 0, 20}, to{5, 2, -150, 0, 0, 90};
  const Way expected{
      from, {1, 2, 0, 10, 0, 20}, {1, 2, 0, 0, 0, 90}, {5, 2, 0, 0, 0, 90}, {5, 2, -150, 0, 0, 90}};
  EXPECT_EQ(retract_way(from, to, 0), expected);
  EXPECT_EQ(retract_way(to, to, -200), Way{to}) << "it is there";
}

// As the channel executes the C words of the program: canonical::rotary_target of each.
std::vector<double> turns_of(const std::string& program, canonical::RotaryWay way, double c) {
  std::vector<double> positions;
  std::istringstream lines(program);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(" C"); at != std::string::npos)
      positions.push_back(c = canonical::rotary_target(way, std::stod(line.substr(at + 2)), c));
  return positions;
}

// A way was planned in one sense among bodies: a table that counts modulo 360 goes it in that sense, whatever
// its turn, and is never sent the other way round or once more around.
TEST(MeasuringProgramText, AnAxisThatCountsModulo360TurnsAsPlanned) {
  using canonical::RotaryWay;
  const auto turns = [](RotaryWay way, double from, double to) {
    TrueMachine machine(geometry::ac_table(), geometry::ac_table());
    machine.measured.outline.axes[5] = {true, -1e12, 1e12, way};
    AxisPosition start{0, 0, 0, 0, 0, from}, end{0, 0, 0, 0, 0, to};
    const auto text =
        positioning_program(default_inputs(machine.measured), machine.measured, {start, end}, {7});
    return turns_of(text, way, from);
  };
  using Turns = std::vector<double>;
  EXPECT_EQ(turns(RotaryWay::linear, 0, 300), (Turns{300}));
  EXPECT_EQ(turns(RotaryWay::shortest, 0, 300), (Turns{150, 300}));
  EXPECT_EQ(turns(RotaryWay::shortest, 725, 365), (Turns{605, 485, 365}));
  EXPECT_EQ(turns(RotaryWay::by_sign, 0, 300), (Turns{150, 300}));
  EXPECT_EQ(turns(RotaryWay::by_sign, 20, -370), (Turns{-110, -240, -370}));
  EXPECT_EQ(turns(RotaryWay::by_sign, 30.0000004, 30.0000004), (Turns{30}))
      << "no turn for a rest of a digit";
}

TEST(MeasuringProgramText, ApproachesByTheNearestTurn) {
  TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  const AxisPosition from{0, 0, 0, 350, 0, 350}, to{1, 2, 3, 0, 0, 0};
  EXPECT_EQ(nearest_turns(machine.measured.outline, from, to), to);
  machine.measured.outline.axes[5].way = canonical::RotaryWay::by_sign;
  EXPECT_EQ(nearest_turns(machine.measured.outline, from, to), (AxisPosition{1, 2, 3, 0, 0, 360}));
}

TEST(MeasuringProgramText, ReadsTouchesFromTheVariablesAndNamesAMissingOne) {
  MacroVariables variables{{52150, 1}, {52151, 2}, {52152, 3}, {52153, 1.5}, {52154, 2}, {52999, 4}};
  EXPECT_TRUE(completed(variables, 4));
  EXPECT_FALSE(completed(variables, 5));
  try {
    measured_positions(variables, 2);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "macro variable #52155 is vacant: touch 2 is missing");
  }
  variables[52155] = 3;
  const auto positions = measured_positions(variables, 2);
  EXPECT_EQ(positions[1], Vec3(1.5, 2, 3));
  EXPECT_DOUBLE_EQ(range_along(positions, Vec3(0.6, 0.8, 0)), 0.3);
}

}  // namespace
}  // namespace trunnion::calibration
