// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <sstream>

#include "calibration/measuring_program.hpp"
#include "geometry/angle.hpp"
#include "geometry/test/machines.hpp"
#include "true_machine.hpp"

namespace trunnion::calibration::measuring_program_test {
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

struct Case {
  Positioning positioning;
  std::size_t touches;
  Vec3 shaft;
};

class MeasuringProgram : public testing::TestWithParam<Case> {};

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
                         testing::Values(Case{Positioning::paraxial, 10, {0, 0, -1}},
                                         Case{Positioning::circular, 10, {0, 0, -1}},
                                         Case{Positioning::circular, 8, {0, -1, -1}},
                                         Case{Positioning::paraxial, 8, {1, 0, -1}}));

// The sphere may be 4 mm beside its place: nothing but a touch comes nearer than 5 mm, and a touch ends 2 mm
// behind the expected surface.
TEST(MeasuringProgramText, KeepsOutOfTheConfidenceRange) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  auto in = default_inputs(machine.measured);
  in.sphere = Vec3(-120, -130, -420);
  in.probe_length = 150;
  in.confidence_range = 4;
  const auto plan = std::get<MeasurementPlan>(plan_measurement(in, machine.measured));
  const auto& pose = plan.poses.front();
  const Vec3 centre =
      geometry::make(machine.measured.model).machine_from_tip(in.sphere, pose.angles, in.probe_length);
  const auto above = approach_position(in, pose, centre);
  const auto text = measuring_program(in, machine.measured, pose, centre, {above}, {7});
  EXPECT_THAT(text, testing::HasSubstr(" D7.000000 "));
  const double radius = (in.sphere_diameter + in.ball_diameter) / 2;
  const auto moves = moves_of(text);
  ASSERT_GT(moves.size(), pose.directions.size());
  for (const auto& ball : moves) EXPECT_GE((ball - centre).norm(), radius + 5 - 1e-5);
}

// Each part in one minute divided by its F (G93).
TEST(MeasuringProgramText, TurnsWithTheFeedOfTheRotaryAxesAlsoWhereItMoves) {
  const TrueMachine machine(geometry::ac_table(), geometry::ac_table());
  auto in = default_inputs(machine.measured);
  in.rotary_feed = 360, in.positioning_feed = 2000;
  // 100 mm with 90 degrees, 400 mm with 9 degrees, 30 degrees alone, 200 mm alone, and a last digit, whose
  // time would be too short for a word.
  const Way way{{0, 0, -50, 0, 0, 0},      {100, 0, -50, 0, 0, 90},    {100, 400, -50, 9, 0, 90},
                {100, 400, -50, 9, 0, 60}, {100, 400, -250, 9, 0, 60}, {100, 400, -250 + 1e-12, 9, 0, 60}};
  std::istringstream lines(positioning_program(in, machine.measured, way, {7}));
  std::vector<double> feeds;
  bool inverse_time = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "G93" || line == "G94") inverse_time = line == "G93";
    double feed = 0;
    if (line.rfind("G53 G1", 0) != 0) continue;
    ASSERT_EQ(std::sscanf(line.c_str() + line.find('F'), "F%lf", &feed), 1) << line;
    EXPECT_TRUE(inverse_time) << line;
    feeds.push_back(feed);
  }
  EXPECT_FALSE(inverse_time) << "the program ends in G94";
  ASSERT_EQ(feeds.size(), 5u);
  const double expected[] = {360 / 90.0, 2000 / 400.0, 360 / 30.0, 2000 / 200.0, 1e6};
  for (std::size_t i = 0; i < feeds.size(); ++i) EXPECT_NEAR(feeds[i], expected[i], 1e-6) << i;
}

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
    AxisPosition start{0, 0, 0, 0, 0, from}, end{1, 0, 0, 0, 0, to};
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
}  // namespace trunnion::calibration::measuring_program_test
