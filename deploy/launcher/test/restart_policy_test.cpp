// SPDX-License-Identifier: Apache-2.0
#include "restart_policy.hpp"

#include <gtest/gtest.h>

namespace trunnion::launcher {
namespace {

// Lives of one second each, ended at `now`.
void live_shortly(RestartPolicy& policy, double now) {
  policy.started(now - 1);
  policy.beat(now - 0.5);
  policy.ended(now);
}

TEST(RestartPolicy, WhatHasLivedLongIsStartedAgainAtOnce) {
  RestartPolicy policy;
  policy.started(100);
  policy.ended(110.1);
  EXPECT_TRUE(policy.due(110.1));
  EXPECT_EQ(policy.short_lives(), 0);
}

TEST(RestartPolicy, ShortLivesAreAnsweredEverLaterAndThenRarely) {
  RestartPolicy policy;
  // 0.1 s, doubled each time; the fifth short life in a row is one too many.
  double now = 100;
  for (const double delay : {0.1, 0.2, 0.4, 0.8}) {
    live_shortly(policy, now);
    EXPECT_FALSE(policy.gave_up());
    EXPECT_FALSE(policy.due(now + delay - 0.01));
    EXPECT_TRUE(policy.due(now + delay + 0.01));
    now += 10;
  }
  live_shortly(policy, now);
  EXPECT_TRUE(policy.gave_up());
  EXPECT_FALSE(policy.due(now + RestartPolicy::rare_delay - 0.01));
  EXPECT_TRUE(policy.due(now + RestartPolicy::rare_delay));
  live_shortly(policy, now + 40);
  EXPECT_TRUE(policy.gave_up()) << "one more try is not a new beginning";
  EXPECT_FALSE(policy.due(now + 40 + RestartPolicy::longest_delay));
}

TEST(RestartPolicy, ALongLifeForgetsTheShortOnes) {
  RestartPolicy policy;
  for (int i = 0; i < RestartPolicy::most_short_lives; ++i) live_shortly(policy, 100 + i);
  policy.started(200);
  policy.beat(200.5);
  policy.ended(211);
  EXPECT_FALSE(policy.gave_up());
  EXPECT_TRUE(policy.due(211));
}

TEST(RestartPolicy, TheOperatorsResetGivesEveryTryBack) {
  RestartPolicy policy;
  live_shortly(policy, 100);
  policy.retry();
  EXPECT_FALSE(policy.due(100.05)) << "a reset does not shorten an ordinary delay";
  for (int i = 0; i < RestartPolicy::most_short_lives; ++i) live_shortly(policy, 101 + i);
  EXPECT_FALSE(policy.due(106));
  policy.retry();
  EXPECT_TRUE(policy.due(106));
  EXPECT_FALSE(policy.gave_up());
  EXPECT_EQ(policy.short_lives(), 0);
}

TEST(RestartPolicy, SilenceIsFirstReportedAndThenEnded) {
  RestartPolicy policy;
  policy.started(100);
  policy.beat(101);
  EXPECT_EQ(policy.pulse(102.5), Pulse::beating);
  EXPECT_EQ(policy.pulse(102.6), Pulse::silent);
  EXPECT_EQ(policy.pulse(105.0), Pulse::silent);
  EXPECT_EQ(policy.pulse(105.1), Pulse::hung);
  policy.beat(105.2);
  EXPECT_EQ(policy.pulse(106), Pulse::beating) << "it came back by itself";
}

TEST(RestartPolicy, AProcessThatLoadsIsGivenMoreTimeForItsFirstBeat) {
  RestartPolicy policy;
  policy.started(100);
  EXPECT_EQ(policy.pulse(107.5), Pulse::beating);
  EXPECT_EQ(policy.pulse(107.6), Pulse::hung);
}

}  // namespace
}  // namespace trunnion::launcher
