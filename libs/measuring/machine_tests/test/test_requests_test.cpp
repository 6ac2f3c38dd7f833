// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/test_requests.hpp"

#include <gtest/gtest.h>

#include "machine/gantry_pairs.hpp"
#include "machine/machine.hpp"
#include "machine/parameter_constants.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::machine_tests {
namespace {

TEST(TestRequests, GiveEveryAxisOfAGantryNoFeedforward) {
  machine::Parameters p;
  p.values = machine::machine_parameters(
      machine::load_machine(std::string(TRUNNION_SOURCE) + "/configs/machines/gantry-cb-head"));
  const auto pairs = machine::gantry_pairs(p);
  ASSERT_FALSE(pairs.empty());
  const auto master = pairs.front().master, slave = pairs.front().slave;
  p.values[parameter::velocity_feedforward.number(slave)] = {0.75, ""};
  const auto request = without_feedforward(p, samples_of({master}, 2));
  EXPECT_TRUE(request.in_motion);
  EXPECT_EQ(request.decimation, 2);
  EXPECT_EQ(request.axes, (std::vector<std::uint16_t>{master, slave}));
  ASSERT_EQ(request.trial.size(), 4u);
  for (const auto& value : request.trial) EXPECT_EQ(value.value, 0);
  EXPECT_EQ(request.trial[2].parameter, parameter::velocity_feedforward.number(slave));
  EXPECT_EQ(request.trial[2].fallback, 0.75);
}

// 60 1/s and 2 mm: 60 mm/s lag by 1 mm, the half of it; twice the speed is borne at half the feed.
TEST(TestRequests, LowerTheFeedUntilNoAxisLagsTooMuch) {
  machine::Parameters p;
  for (const std::uint16_t axis : {0, 1}) {
    p.values[parameter::position_gain.number(axis)] = {60, ""};
    p.values[parameter::following_error_limit.number(axis)] = {2, ""};
  }
  EXPECT_EQ(feed_without_feedforward(p, {0, 1}, {10, 50}, 3000), 3000);
  EXPECT_NEAR(feed_without_feedforward(p, {0, 1}, {10, 120}, 3000), 1500, 1e-9);
}

TEST(TestRequests, KeepTheHighestFeedOfTheAxis) {
  servo_analysis::TestedAxis axis;
  axis.letter = 'X', axis.highest_feed = 5000;
  EXPECT_EQ(feed_of(axis, std::nullopt, 1000), 1000);
  EXPECT_EQ(feed_of(axis, 2000, 1000), 2000);
  EXPECT_EQ(testing_support::refusal_of([&] { feed_of(axis, 6000, 1000); }),
            "feed 6000: axis X moves with up to 5000 mm/min");
}

}  // namespace
}  // namespace trunnion::machine_tests
