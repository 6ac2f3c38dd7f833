// SPDX-License-Identifier: Apache-2.0
#include "service/comparison_clock.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace trunnion::service {
namespace {

struct Watch {
  ComparisonClock clock;
  std::string differs;
  int looks = 0;
  void at(double now, bool news = false) {
    clock.poll(news, now, [this] {
      ++looks;
      return differs;
    });
  }
};

TEST(ComparisonClock, InStepAfterAComparisonWithoutDifferenceAndThenOnlyNewsIsCompared) {
  Watch watch;
  EXPECT_FALSE(watch.clock.health().in_step);
  watch.at(10);
  EXPECT_TRUE(watch.clock.health().in_step);
  EXPECT_EQ(watch.clock.health().difference, "");
  for (int k = 0; k < 100; ++k) watch.at(10 + 0.05 * k);
  EXPECT_EQ(watch.looks, 1);
  watch.at(20, true);
  EXPECT_EQ(watch.looks, 2);
  EXPECT_TRUE(watch.clock.health().in_step);
}

TEST(ComparisonClock, ADifferenceCountsOnceItHasLastedASecond) {
  Watch watch;
  watch.differs = "the tool table";
  for (int k = 0; k < 19; ++k) {  // 0.9 s
    watch.at(10 + 0.05 * k);
    EXPECT_FALSE(watch.clock.health().in_step);
    EXPECT_EQ(watch.clock.health().difference, "");
  }
  for (int k = 19; k < 24; ++k) watch.at(10 + 0.05 * k);
  EXPECT_EQ(watch.clock.health().difference, "the tool table");
  EXPECT_FALSE(watch.clock.health().in_step);
  watch.differs = "";
  watch.at(20, true);
  EXPECT_EQ(watch.clock.health().difference, "the tool table") << "it stays found";
}

TEST(ComparisonClock, WhatWasOnlyNotThereYetIsNoDifference) {
  Watch watch;
  watch.at(10);
  watch.differs = "the revision: 7 and 6";  // published, and the file is not there yet
  watch.at(11, true);
  EXPECT_FALSE(watch.clock.health().in_step);
  watch.at(11.2);
  watch.differs = "";
  watch.at(11.4);
  EXPECT_TRUE(watch.clock.health().in_step);
  watch.differs = "the revision: 8 and 7";
  watch.at(12.5, true);  // the second begins anew
  EXPECT_EQ(watch.clock.health().difference, "");
}

TEST(ComparisonClock, AFileThatCannotBeReadIsADifference) {
  ComparisonClock clock;
  const auto fails = []() -> std::string { throw std::runtime_error("tools.yaml:3:1: error"); };
  for (int k = 0; k < 12; ++k) clock.poll(false, 10 + 0.1 * k, fails);
  EXPECT_EQ(clock.health().difference, "tools.yaml:3:1: error");
}

}  // namespace
}  // namespace trunnion::service
