// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "gantry_core.hpp"

namespace trunnion::gantry {
namespace {

// Axis 1 is the master, axis 2 its slave; lead 8.
machine::Parameters gantry() {
  machine::Parameters p;
  p.values[40001] = {0, ""}, p.values[40002] = {1, ""};
  p.values[100000] = {0, "X"}, p.values[101000] = {0, "Y1"}, p.values[102000] = {0, "Y2"};
  p.values[10050] = {1, ""}, p.values[10051] = {2, ""};
  p.values[102100] = {1, ""}, p.values[102101] = {1, ""};
  p.values[102129] = {0.5, ""}, p.values[102130] = {0.1, ""}, p.values[102131] = {0.02, ""};
  p.values[900] = {8, ""};
  return p;
}

idl::stream::AxisFrame frame(std::uint64_t first, double x, double y) {
  idl::stream::AxisFrame f;
  f.axes = {0, 1};
  f.first = first, f.count = 1;
  f.setpoints = {x, y};
  return f;
}

TEST(Gantry, TheSlaveFollowsItsMasterWithTheZeroDeviation) {
  GantryCore core;
  core.configure(gantry(), 0);
  idl::stream::AxisFrame out;
  ASSERT_TRUE(core.process(frame(0, 1, 2), {}, out));
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_EQ(out.setpoints, (std::vector<double>{1, 2, 2.5}));
}

TEST(Gantry, AMirroredSlaveMovesOpposite) {
  auto p = gantry();
  p.values[102127] = {1, ""};
  GantryCore core;
  core.configure(p, 0);
  idl::stream::AxisFrame out;
  core.process(frame(0, 1, 2), {}, out);
  EXPECT_EQ(out.setpoints[2], -1.5);
}

// A machine that was switched off at cycle 100: lead 8, so cycles up to 108 would need rows from before.
TEST(Gantry, AfterAStartOnKeptStateNothingWaitsForFeedbackFromBefore) {
  GantryCore core;
  core.configure(gantry(), 0);
  stream::FeedbackWindow feedback;
  idl::stream::AxisFrame out;
  EXPECT_FALSE(core.process(frame(100, 0, 0), feedback, out)) << "nothing of the drive has arrived";
  idl::stream::FeedbackFrame f;
  f.first = 100, f.count = 0, f.axis_count = 3;
  feedback.put(f);
  for (std::uint64_t n = 100; n <= 108; ++n) {
    ASSERT_TRUE(core.process(frame(n, 0, 0), feedback, out)) << n;
    EXPECT_EQ(out.setpoints[2], 0.5) << "not corrected";
  }
  EXPECT_FALSE(core.process(frame(109, 0, 0), feedback, out)) << "cycle 109 needs the feedback of cycle 100";
}

TEST(Gantry, RowsOfADriveThatWasRestartedDoNotCountAnyMore) {
  stream::FeedbackWindow feedback;
  idl::stream::FeedbackFrame f;
  f.first = 90, f.count = 1, f.axis_count = 3;
  f.actual = {0, 0, 0.6};
  feedback.put(f);
  EXPECT_NE(feedback.actual(90), nullptr);
  f = {};
  f.first = 91, f.axis_count = 3;
  f.applied = {{idl::stream::Input::PARAMETER_SET, 0, 1}};
  feedback.put(f);
  EXPECT_EQ(feedback.actual(90), nullptr) << "a stage that starts now has never seen it";
  EXPECT_TRUE(feedback.is_before_history(90));
  EXPECT_FALSE(feedback.is_before_history(91));
}

TEST(Gantry, TheErrorOfCycleNIsCorrectedAtNPlusLeadPlusOneAndWaitsForIt) {
  GantryCore core;
  core.configure(gantry(), 0);
  stream::FeedbackWindow feedback;
  idl::stream::AxisFrame out;
  ASSERT_TRUE(core.process(frame(8, 0, 0), feedback, out)) << "no feedback exists before cycle 0";
  EXPECT_FALSE(core.process(frame(9, 0, 0), feedback, out)) << "cycle 9 needs the feedback of cycle 0";
  idl::stream::FeedbackFrame f;
  f.first = 0, f.count = 1, f.axis_count = 3;
  f.actual = {0, 0, 0.6};  // the slave is 0.1 too far
  feedback.put(f);
  ASSERT_TRUE(core.process(frame(9, 0, 0), feedback, out));
  EXPECT_NEAR(out.setpoints[2], 0.5 - 0.01, 1e-15) << "a tenth of the error";
}

TEST(Gantry, TheCorrectionIsLimited) {
  GantryCore core;
  core.configure(gantry(), 0);
  stream::FeedbackWindow feedback;
  idl::stream::AxisFrame out;
  for (std::uint64_t n = 9; n < 40; ++n) {
    idl::stream::FeedbackFrame f;
    f.first = n - 9, f.count = 1, f.axis_count = 3;
    f.actual = {0, 0, 0.6};
    feedback.put(f);
    ASSERT_TRUE(core.process(frame(n, 0, 0), feedback, out));
  }
  EXPECT_NEAR(out.setpoints[2], 0.48, 1e-15) << "0.02 mm is the largest correction";
}

// Compensation has put the slave 0.3 mm from where the master's setpoint says.
idl::stream::AxisFrame compensated(std::uint64_t first) {
  auto in = frame(first, 0, 0);
  in.axes.push_back(2);
  in.setpoints.push_back(0.5 + 0.3);
  return in;
}

TEST(Gantry, ACompensatedSlaveKeepsItsSetpointAndItsOffsetIsNoError) {
  GantryCore core;
  core.configure(gantry(), 0);
  stream::FeedbackWindow feedback;
  idl::stream::AxisFrame out;
  idl::stream::FeedbackFrame f;
  f.first = 0, f.count = 2, f.axis_count = 3;
  f.actual = {0, 0, 0.8, 0, 0, 0.9};  // where it should be, then 0.1 mm too far
  feedback.put(f);
  ASSERT_TRUE(core.process(compensated(9), feedback, out));
  EXPECT_EQ(out.axes, (std::vector<std::uint16_t>{0, 1, 2}));
  EXPECT_NEAR(out.setpoints[2], 0.8, 1e-15);
  ASSERT_TRUE(core.process(compensated(10), feedback, out));
  EXPECT_NEAR(out.setpoints[2], 0.8 - 0.01, 1e-15) << "a tenth of the error";
  stream::StateValues state;
  core.save(state);
  ASSERT_EQ(state.size(), 2u) << "the correction and the offset, which the supervision needs";
  EXPECT_NEAR(compensated_offsets(1, state)[0], 0.3, 1e-15);
  EXPECT_EQ(compensated_offsets(1, std::vector<double>{0.1}), (std::vector<double>{0}));
}

TEST(Gantry, TheSlaveMovesWithTheChannelOfItsMaster) {
  EXPECT_TRUE(machine::axis_moves_with(gantry(), 1, 0));
  EXPECT_TRUE(machine::axis_moves_with(gantry(), 2, 0));
  EXPECT_FALSE(machine::axis_moves_with(gantry(), 3, 0));
  EXPECT_FALSE(machine::axis_moves_with(gantry(), 2, 1));
}

TEST(Gantry, AMissingMasterIsNamed) {
  auto p = gantry();
  p.values[102101] = {9, ""};
  EXPECT_THROW(machine::gantry_pairs(p), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::gantry
