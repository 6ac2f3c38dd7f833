// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gantry_core.hpp"
#include "stream/gantry_synchronization.hpp"

namespace trunnion::gantry {
namespace {

// Axis 1 is the master, axis 2 its slave.
machine::Parameters gantry() {
  machine::Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  p.values[10050] = {1, ""}, p.values[10051] = {2, ""};
  p.values[102100] = {1, ""}, p.values[102101] = {1, ""};
  p.values[102129] = {0.5, ""};
  return p;
}

idl::stream::AxisBatch batch(std::uint64_t first, double x, double y) {
  idl::stream::AxisBatch f;
  f.axes = {0, 1};
  f.first = first, f.count = 1;
  f.setpoints = {x, y};
  return f;
}

TEST(Gantry, TheSlaveFollowsItsMasterWithTheZeroDeviation) {
  GantryCore core;
  core.configure(gantry(), 0);
  idl::stream::AxisBatch out;
  ASSERT_TRUE(core.process(batch(0, 1, 2), {}, out));
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_EQ(out.setpoints, (std::vector<double>{1, 2, 2.5}));
}

TEST(Gantry, AMirroredSlaveMovesOpposite) {
  auto p = gantry();
  p.values[102127] = {1, ""};
  GantryCore core;
  core.configure(p, 0);
  idl::stream::AxisBatch out;
  core.process(batch(0, 1, 2), {}, out);
  EXPECT_EQ(out.setpoints[2], -1.5);
}

TEST(Gantry, AReversedPositiveDirectionIsTheSameAndBothCancel) {
  auto p = gantry();
  p.values[102128] = {1, ""};
  EXPECT_EQ(machine::gantry_pairs(p)[0].sign, -1);
  p.values[102127] = {1, ""};
  EXPECT_EQ(machine::gantry_pairs(p)[0].sign, 1);
}

TEST(Gantry, TheSlaveIsNotCorrectedByTheFeedback) {
  GantryCore core;
  core.configure(gantry(), 0);
  stream::FeedbackWindow feedback;
  idl::stream::Feedback f;
  f.first = 0, f.count = 1, f.axis_count = 3;
  f.actual = {0, 0, 0.6};
  feedback.put(f);
  idl::stream::AxisBatch out;
  for (std::uint64_t n = 0; n < 100; ++n) {
    ASSERT_TRUE(core.process(batch(n, 0, 0), feedback, out)) << "it waits for no feedback";
    EXPECT_EQ(out.setpoints[2], 0.5);
  }
}

TEST(Gantry, TheSmallestOfThreeLimitsIsTheLargestErrorThatIsAligned) {
  auto p = gantry();
  EXPECT_EQ(machine::gantry_pairs(p)[0].alignment_limit, 1) << "10a131 alone";
  p.values[102107] = {0.4, ""};
  EXPECT_EQ(machine::gantry_pairs(p)[0].alignment_limit, 0.4);
  p.values[102106] = {0.3, ""};
  EXPECT_EQ(machine::gantry_pairs(p)[0].alignment_limit, 0.3);
  p.values[102131] = {0.2, ""};
  EXPECT_EQ(machine::gantry_pairs(p)[0].alignment_limit, 0.2);
}

TEST(Gantry, TheFunctionWordsOfTheDriveAreDecimalDigits) {
  auto p = gantry();
  p.values[102942] = {10111, ""}, p.values[102943] = {10, ""}, p.values[102944] = {5000, ""};
  auto s = machine::DriveSynchronization::from(p, 2);
  EXPECT_TRUE(s.on && s.slave && s.torque_follow && s.current_checked && s.inverted);
  EXPECT_TRUE(!s.compensates && s.common_stop);
  EXPECT_EQ(s.gain, 50) << "PB66 counts 0.01 1/s";
  p.values[102942] = {1000, ""}, p.values[102943] = {1, ""};
  s = machine::DriveSynchronization::from(p, 2);
  EXPECT_FALSE(s.on || s.slave || s.torque_follow || s.current_checked || s.inverted);
  EXPECT_TRUE(s.compensates && !s.common_stop);
}

// Compensation has put the slave 0.3 mm from where the master's setpoint says.
idl::stream::AxisBatch compensated(std::uint64_t first) {
  auto in = batch(first, 0, 0);
  in.axes.push_back(2);
  in.setpoints.push_back(0.5 + 0.3);
  return in;
}

TEST(Gantry, ACompensatedSlaveKeepsItsSetpointAndItsOffsetIsInTheState) {
  GantryCore core;
  core.configure(gantry(), 0);
  idl::stream::AxisBatch out;
  ASSERT_TRUE(core.process(compensated(9), {}, out));
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_NEAR(out.setpoints[2], 0.8, 1e-15);
  stream::StateValues state;
  core.save(state);
  ASSERT_EQ(state.size(), 1u) << "the offset, which supervision and alignment need";
  EXPECT_NEAR(stream::compensated_offsets(1, state)[0], 0.3, 1e-15);
  EXPECT_EQ(stream::compensated_offsets(1, {}), (std::vector<double>{0}));
  GantryCore other;
  other.configure(gantry(), 0);
  other.load(state);
  stream::StateValues again;
  other.save(again);
  EXPECT_EQ(again, state);
}

TEST(Gantry, TheSlaveMovesWithTheChannelOfItsMaster) {
  EXPECT_TRUE(machine::axis_moves_with(gantry(), 1, 0));
  EXPECT_TRUE(machine::axis_moves_with(gantry(), 2, 0));
  EXPECT_FALSE(machine::axis_moves_with(gantry(), 3, 0));
  EXPECT_FALSE(machine::axis_moves_with(gantry(), 2, 1));
}

TEST(Gantry, ABatchWithoutTheMasterPassesAsItIs) {
  GantryCore core;
  core.configure(gantry(), 0);
  idl::stream::AxisBatch in = batch(0, 1, 2), out;
  in.axes = {0}, in.setpoints = {1};
  ASSERT_TRUE(core.process(in, {}, out));
  EXPECT_EQ(out.axes, std::vector<std::uint16_t>{0});
  EXPECT_EQ(out.setpoints, std::vector<double>{1});
  in.axes.resize(32), in.setpoints.resize(32);
  for (std::uint16_t i = 0; i < 32; ++i) in.axes[i] = static_cast<std::uint16_t>(31 - i);
  ASSERT_TRUE(core.process(in, {}, out));
  EXPECT_LE(out.axes.size(), 32u) << "more than a batch can have";
}

TEST(Gantry, AMissingMasterIsNamed) {
  auto p = gantry();
  p.values[102101] = {9, ""};
  EXPECT_THROW(machine::gantry_pairs(p), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::gantry
