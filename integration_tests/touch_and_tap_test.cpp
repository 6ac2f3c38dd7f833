// SPDX-License-Identifier: Apache-2.0
// A probe that ends a move, and a spindle that follows the tool into a thread, on a whole machine.
#include <algorithm>
#include <cmath>

#include "cluster_harness.hpp"

namespace trunnion::integration {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Skip input 2 of the machine comes on where X passes 30.5 upwards; back at the latched place the program
/// ends.
Rows touch(const std::string& vendor) {
  Cluster cluster("ac-table", Time::virtual_, vendor);
  cluster.keep_rows = true;
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = idl::parameters::Operation::SET;
  request.who = "test";
  request.values = {{10931, 0, ""}, {10935, 30.5, ""}, {10939, 1, ""}};
  cluster.client().parameter(request);
  const auto revision = cluster.channels[0].revision;
  cluster.client().channel(0, CommandKind::RESET);
  EXPECT_TRUE(cluster.until([&] { return cluster.channels[0].revision > revision; }));
  cluster.start_text("G90 G54 G49\nG0 X20 Y0\nG31 L2 X80 F600\nG1 X#5061 F3000\nM30\n");
  EXPECT_TRUE(cluster.finish()) << cluster.told();
  EXPECT_EQ(cluster.active_alarms(), "");
  EXPECT_TRUE(cluster.until([&] { return cluster.rows.back()[0] < 30.6; })) << cluster.rows.back()[0];
  return cluster.every_row();
}

TEST(TouchAndTap, ATouchEndsTheMoveTheLeadBehindItAndTheProgramGoesBackToTheLatchedPlace) {
  const Rows rows = touch("cyclonedds");
  double most = 0;
  for (const auto& row : rows) most = std::max(most, row[0]);
  // At 10 um in a cycle: 33 cycles until the channel brakes, then the braking; far from X80 in any case.
  EXPECT_GT(most, 30.5 + 0.33);
  EXPECT_LT(most, 30.5 + 0.6);
  // The encoder counts 10 nm and the position is latched within the cycle.
  EXPECT_NEAR(rows.back()[0], 30.5, 1e-4);
  EXPECT_EQ(touch("fastdds"), rows) << "the reaction has its cycle, whatever carries the messages";
}

TEST(TouchAndTap, TheSpindleFollowsTheToolIntoTheThreadAndOutAgain) {
  Cluster cluster("ac-table");
  struct Row {
    double z, turns;
  };
  std::vector<Row> actual;  // Z is column 2 of the feedback, the machine has one spindle
  cluster.on_batch = [&](const idl::stream::Feedback& feedback) {
    for (std::uint32_t i = 0; i < feedback.count; ++i)
      actual.push_back({feedback.actual[i * feedback.axis_count + 2], feedback.spindle_angle[i]});
  };
  // M10: lead 1.5 at 600 1/min, from R2 to -12: 14 mm, 9 1/3 turns.
  cluster.start_text("G90 G54 G49 G94\nG0 Z20\nS600 M3\nG99 G84 X0 Y0 Z-12 R2 F900\nG80 M5\nG0 Z20\nM30\n");
  ASSERT_TRUE(cluster.finish()) << cluster.told();
  EXPECT_EQ(cluster.active_alarms(), "");
  EXPECT_TRUE(cluster.rests()) << cluster.told();
  // G54 has Z -380. The hole is where the tool is below R, and its first row gives the angle of R.
  const double r = -378;
  double turns = 0, error = 0;
  bool in = false;
  double origin = 0;
  for (const Row& row : actual) {
    if (row.z > r - 1e-4) {
      if (!in) origin = row.turns;
      continue;
    }
    in = true;
    turns = std::max(turns, row.turns - origin);
    error = std::max(error, std::abs((r - row.z) - 1.5 * (row.turns - origin)));
  }
  EXPECT_NEAR(turns, 14 / 1.5, 1e-3);
  // The spindle is simulated without lag; what is left is the following error of Z, which its feedforward
  // keeps within some um.
  EXPECT_LT(error, 0.02);
}

}  // namespace
}  // namespace trunnion::integration
