// SPDX-License-Identifier: Apache-2.0
#include "identification/circle_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "ac_machine.hpp"
#include "truth/truth_file.hpp"

namespace trunnion::identification {
namespace {

// From the centre X10 Y20 to X60, where the position loop is 2 um behind.
servo_analysis::ChannelMotion from_the_centre() {
  servo_analysis::ChannelMotion motion;
  motion.count = 2;
  motion.resting[1] = 20, motion.resting[2] = -100;
  motion.traces[0].setpoint = motion.traces[0].load = {10, 60};
  motion.traces[0].feedback = {10, 59.998};
  return motion;
}

const circular_tests::ProgrammedCircle about_the_centre{{10, 20}, 50};

CirclePoints true_points_with(const std::string& errors) {
  const auto parameters = DrawnMachine::parameters_of("ac-table");
  const auto machine = machine::outline_of(parameters, 0);
  truth::PoseReport report(
      truth::make_geometry(truth::parse_truth(errors, "truth.yaml", machine).geometry, machine, "truth.yaml"),
      machine::make_chain(parameters, 0), machine);
  report.tool_length = 100;
  return true_points(from_the_centre(), {0, 1}, about_the_centre, report);
}

TEST(CirclePoints, AreTheCommandsAndThePositionLoops) {
  const auto commanded = commanded_points(from_the_centre(), {0, 1});
  ASSERT_EQ(commanded.size(), 2u);
  EXPECT_EQ(commanded[1].first, 60);
  EXPECT_EQ(commanded[1].second, 20);
  EXPECT_EQ(encoder_points(from_the_centre(), {0, 1})[1].first, 59.998);
  EXPECT_EQ(commanded_points(from_the_centre(), {1, 2})[0].second, -100);
}

// The ball is where the tip truly is at the centre: a constant error is none. 20 um/m over 50 mm are 1 um.
TEST(CirclePoints, OfTheTrueTipHaveWhatDiffersFromTheCentre) {
  for (const auto* errors : {"", "axes:\n  X: {EXX: [{polynomial_um: [10]}]}\n"}) {
    const auto points = true_points_with(errors);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0].first, 10, 1e-9) << errors;
    EXPECT_NEAR(points[1].first, 60, 1e-9) << errors;
    EXPECT_NEAR(points[1].second, 20, 1e-9) << errors;
  }
  const auto points = true_points_with("axes:\n  X: {EXX: [{polynomial_um: [0, 20]}]}\n");
  EXPECT_NEAR(std::abs(points[1].first - 60), 1e-3, 1e-6);
}

}  // namespace
}  // namespace trunnion::identification
