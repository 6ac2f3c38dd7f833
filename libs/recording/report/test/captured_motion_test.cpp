// SPDX-License-Identifier: Apache-2.0
#include "report/captured_motion.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "synthetic_run.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::report {
namespace {

// 50 mm with 50 mm/s are a second, a thousand cycles; the encoder of X shows 10 um more.
TEST(CapturedMotion, HasCommandAndFeedbackOfEveryAxis) {
  test::RunOptions run;
  run.file = testing::TempDir() + "/captured_motion_" + std::to_string(getpid()) + ".mcap";
  run.program = "G54 G90 G61\nG0 X10 Y5 Z10\nG1 X60 F3000\nM30\n";
  run.encoder_error = [](std::uint64_t, std::array<double, 5>& axes) { axes[0] += 0.01; };
  const auto cycles = test::record_run(run);
  machine::Parameters parameters;
  const auto motion = motion_of_recording(run.file, 0, parameters);
  const auto refused = testing_support::refusal_of([&] { motion_of_recording(run.file, 1, parameters); });
  std::filesystem::remove(run.file);
  EXPECT_EQ(refused, run.file + ": no motion of channel 1: record the topics path_batch and feedback");
  EXPECT_FALSE(parameters.values.empty());
  EXPECT_NEAR(motion.interval, 0.001, 1e-12);
  ASSERT_GT(motion.count, 900u);
  EXPECT_LE(motion.count, cycles);
  const auto& x = motion.traces[0];
  ASSERT_EQ(x.size(), motion.count);
  EXPECT_NEAR(x.setpoint.back(), 60, 1e-9);
  for (std::size_t i = 0; i < motion.count; ++i) {
    ASSERT_NEAR(x.feedback[i] - x.setpoint[i], 0.01, 1e-9) << i;
    ASSERT_EQ(motion.load(0, i), x.feedback[i]) << i;
  }
  EXPECT_NEAR(motion.feedback(1, motion.count - 1), 5, 1e-9);
  for (const std::size_t axis : {1, 2, 3, 5}) EXPECT_EQ(motion.traces[axis].size(), motion.count) << axis;
  EXPECT_EQ(motion.traces[4].size(), 0u) << "there is no B";
}

}  // namespace
}  // namespace trunnion::report
