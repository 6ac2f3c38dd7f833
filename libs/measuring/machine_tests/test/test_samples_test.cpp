// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/test_samples.hpp"

#include <gtest/gtest.h>

namespace trunnion::machine_tests {
namespace {

using idl::servo::TestPhase;
using idl::servo::TestSamples;

// `count` samples of two axes from number `first` on; every value of the second axis is 100 more.
TestSamples two_axes(std::uint64_t first, std::size_t count) {
  TestSamples samples;
  samples.phase = TestPhase::RUNNING;
  samples.first = first;
  samples.interval = 0.0005;
  samples.axes = {0, 1};
  for (std::size_t i = 0; i < count; ++i)
    for (const double axis : {0.0, 100.0})
      for (int column = 0; column < 8; ++column)
        samples.values.push_back(axis + 10 * static_cast<double>(first + i) + column);
  return samples;
}

TEST(TestSamples, BecomeTheTracesOfTheAxes) {
  SessionResult result;
  std::uint64_t expected = 0;
  EXPECT_FALSE(add_samples(result, expected, two_axes(0, 2)));
  auto last = two_axes(2, 1);
  last.phase = TestPhase::COMPLETED;
  EXPECT_TRUE(add_samples(result, expected, last));
  EXPECT_EQ(expected, 3u);
  EXPECT_FALSE(result.lost);
  ASSERT_EQ(result.traces.size(), 2u);
  EXPECT_EQ(result.traces[0].setpoint, (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(result.traces[1].load, (std::vector<double>{107, 117, 127}));
  EXPECT_EQ(result.traces[1].interval, 0.0005);
}

TEST(TestSamples, AreLostWhereANumberIsMissing) {
  SessionResult result;
  std::uint64_t expected = 0;
  add_samples(result, expected, two_axes(0, 2));
  add_samples(result, expected, two_axes(5, 1));
  EXPECT_TRUE(result.lost);
  EXPECT_EQ(expected, 6u);
}

// The drive goes on with the fallback values.
TEST(TestSamples, KeepThatAVibrationHasEndedTheTrial) {
  SessionResult result;
  std::uint64_t expected = 0;
  auto vibrating = two_axes(0, 1);
  vibrating.phase = TestPhase::ENDED_BY_VIBRATION;
  vibrating.vibration = 0.03;
  EXPECT_FALSE(add_samples(result, expected, vibrating));
  auto end = two_axes(1, 1);
  end.phase = TestPhase::ENDED_BY_CLIENT;
  end.vibration = 0.01;
  EXPECT_TRUE(add_samples(result, expected, end));
  EXPECT_EQ(result.phase, TestPhase::ENDED_BY_VIBRATION);
  EXPECT_EQ(result.vibration, 0.03);
}

}  // namespace
}  // namespace trunnion::machine_tests
