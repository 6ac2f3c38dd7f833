// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/spindle_sync_samples.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trunnion::machine_tests {
namespace spindle_sync_samples_test {
namespace {

using idl::stream::Feedback;
using testing::HasSubstr;

// Cycles of 1 ms of two spindles at rest, the second at -1 rev.
Feedback rows(std::uint64_t first, std::uint32_t count, std::uint64_t tick) {
  Feedback feedback;
  feedback.first = first, feedback.count = count, feedback.tick = tick;
  feedback.spindle_speed = {0, 0};
  feedback.spindles.resize(2);
  for (auto& spindle : feedback.spindles) spindle.homed = true, spindle.master = -1;
  for (std::uint32_t i = 0; i < count; ++i) {
    feedback.spindle_angle.push_back(static_cast<double>(first + i));
    feedback.spindle_angle.push_back(-1);
  }
  feedback.spindles[0].angle = 50, feedback.spindles[1].angle = -50;
  return feedback;
}

// Tick 100 is the time of the last row, 0.1 s; the row before is that of 0.099 s.
TEST(SpindleSyncSamples, HaveEveryCycleAndTheAnglesBetweenTwoDwells) {
  SpindleSyncSamples samples(0.001);
  auto coupled = rows(40, 2, 100);
  coupled.spindles[1].master = 0;
  coupled.spindles[0].reference = 1500;
  coupled.spindles[1].synchronization_error = 0.01, coupled.spindles[1].correction = 3;
  samples.add(coupled);
  samples.add(rows(42, 0, 100));
  samples.add(rows(42, 0, 120));
  samples.add(rows(42, 1, 130));
  EXPECT_FALSE(samples.lost());
  const auto record = samples.record(0, 1);
  EXPECT_EQ(record.interval, 0.001);
  ASSERT_EQ(record.angles.size(), 4u) << "the second report is of the same tick";
  EXPECT_NEAR(record.angles[0].time, 0.099, 1e-12);
  EXPECT_EQ(record.angles[0].master, 40);
  EXPECT_EQ(record.angles[1].master, 41);
  EXPECT_EQ(record.angles[1].slave, -1);
  EXPECT_TRUE(record.angles[1].cycle);
  EXPECT_FALSE(record.angles[2].cycle);
  EXPECT_NEAR(record.angles[2].time, 0.12, 1e-12);
  EXPECT_EQ(record.angles[2].master, 50);
  EXPECT_EQ(record.angles[2].slave, -50);
  EXPECT_EQ(record.angles[3].master, 42);
  ASSERT_EQ(record.reports.size(), 4u);
  EXPECT_EQ(record.reports[0].at, 1u);
  EXPECT_TRUE(record.reports[0].follows);
  EXPECT_EQ(record.reports[0].reference, 1500);
  EXPECT_EQ(record.reports[0].error, 0.01);
  EXPECT_EQ(record.reports[0].correction, 3);
  EXPECT_EQ(record.reports[1].at, 1u);
  EXPECT_FALSE(record.reports[1].follows);
  EXPECT_FALSE(samples.record(1, 0).reports[0].follows);
}

TEST(SpindleSyncSamples, AreLostWhereACycleIsMissing) {
  SpindleSyncSamples samples(0.001);
  samples.add(rows(40, 2, 100));
  samples.add(rows(43, 1, 103));
  EXPECT_TRUE(samples.lost());
}

TEST(SpindleSyncSamples, TheTestNeedsTwoSpindlesAtRestThatAreHomedAndNotCoupled) {
  const std::vector<machine::AxisInfo> spindles = {{5, "S1", machine::axis_type_spindle},
                                                   {6, "S2", machine::axis_type_spindle}};
  const auto obstacle = [&](const Feedback& feedback) {
    return spindle_sync_obstacle(spindles, feedback, {});
  };
  auto feedback = rows(40, 0, 100);
  EXPECT_EQ(obstacle(feedback), "");
  EXPECT_THAT(spindle_sync_obstacle({spindles[0]}, feedback, {}), HasSubstr("has 1 of the two spindles"));
  EXPECT_THAT(obstacle({}), HasSubstr("does not report"));
  feedback.mode = idl::stream::DriveMode::OFF;
  EXPECT_THAT(obstacle(feedback), HasSubstr("the drives are off"));
  feedback = rows(40, 0, 100);
  feedback.channels.resize(2);
  feedback.channels[1].channel = 1;
  EXPECT_EQ(obstacle(feedback), "");
  feedback.channels[1].active = true;
  EXPECT_THAT(obstacle(feedback), HasSubstr("channel 1 executes a program"));
  feedback = rows(40, 0, 100);
  feedback.spindle_speed[0] = -299.6;
  EXPECT_EQ(obstacle(feedback), "spindle S1 turns with -300 1/min: stop it first");
  feedback = rows(40, 0, 100);
  feedback.spindles[1].homed = false;
  EXPECT_THAT(obstacle(feedback), HasSubstr("spindle S2 has not passed its index mark"));
  idl::plc::Outputs outputs;
  outputs.spindle_couplings.resize(1);
  outputs.spindle_couplings[0].slave = 1, outputs.spindle_couplings[0].master = 0;
  EXPECT_EQ(spindle_sync_obstacle(spindles, feedback, outputs),
            "spindle S2 follows spindle S1 already: end that first");
}

// 1 + 2 + 0.1 s, and twice 1 s.
TEST(SpindleSyncSamples, TheProgramOrdersWhatThePlcIsToDoAndEndsIt) {
  EXPECT_EQ(spindle_sync_program({}, 2000, 0, 1, 2), "S2000\nM3\nM80\nG4 P3100\nM5\nM84\nM30\n");
  SpindleSyncOrders orders;
  orders.on = "M81 R90", orders.off = "M85", orders.start = "M4", orders.stop = "M105";
  EXPECT_EQ(spindle_sync_program(orders, 500, 1500.5, 1, 2),
            "S500\nM4\nM81 R90\nG4 P3100\nS1500.5\nG4 P2000\nM105\nM85\nM30\n");
  EXPECT_EQ(spindle_stop_program({}), "M5\nM84\nM30\n");
}

}  // namespace
}  // namespace spindle_sync_samples_test
}  // namespace trunnion::machine_tests
