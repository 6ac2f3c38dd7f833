// SPDX-License-Identifier: Apache-2.0
#include "core/lasting_difference.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using bus::Json;
constexpr double period = 0.1;  // s between two samples
// The difference has lasted at sample number duration / period, counted from 0, which is more than
// samples_in_a_row.
constexpr int enough = 15;

TEST(LastingDifference, WhatBothShowAlikeOrOneALittleLaterIsNone) {
  LastingDifference compared;
  for (int i = 0; i < 60; ++i) {
    // The running one is a sample behind whenever the value changes, every fifth sample.
    const Json own = {{"line", i / 5}};
    compared.sample({{"line", (i + 4) / 5 - 1}}, own, own, period * i);
    EXPECT_EQ(compared.difference(), "") << i;
  }
  EXPECT_TRUE(compared.settled(period * 60));
}

TEST(LastingDifference, AValueThatStaysAnotherIsOneAfterItsDurationWithBothValues) {
  LastingDifference compared;
  const Json running = {{"axes", {{"0", 1.5}}}}, own = {{"axes", {{"0", 1.502}}}};
  for (int i = 0; i < enough; ++i) compared.sample(running, own, own, period * i);
  EXPECT_EQ(compared.difference(), "");
  EXPECT_FALSE(compared.settled(period * enough));
  compared.sample(running, own, own, LastingDifference::duration);
  EXPECT_EQ(compared.difference(), "axes/0: 1.5 and 1.502");
}

TEST(LastingDifference, FewSamplesAreNotEnoughHoweverLongTheyTake) {
  LastingDifference compared;
  for (int i = 0; i < LastingDifference::samples_in_a_row - 1; ++i)
    compared.sample({{"x", 1}}, {{"x", 2}}, {{"x", 2}}, 1.0 * i);
  EXPECT_EQ(compared.difference(), "");
  EXPECT_FALSE(compared.settled(100));
}

TEST(LastingDifference, PositionsInMotionAreNotComparedUntilTheirOwnRest) {
  LastingDifference compared;
  int i = 0;
  for (; i < 60; ++i) compared.sample({{"x", i}}, {{"x", i + 7}}, {{"x", i + 8}}, period * i);
  EXPECT_EQ(compared.difference(), "");
  // The running one continues and its successor is at rest.
  for (; i < 60 + 2 * enough; ++i) compared.sample({{"x", i}}, {{"x", -1}}, {{"x", -1}}, period * i);
  EXPECT_EQ(compared.difference().substr(0, 3), "x: ");
}

TEST(LastingDifference, AValueThatGoesToAndFroIsNoneHoweverSeldomTheTwoMeet) {
  LastingDifference compared;
  for (int i = 0; i < 200; ++i) {
    const Json own = {{"ahead", 60 + i % 3}};
    compared.sample({{"ahead", 60 + (i + 1) % 3}}, own, own, period * i);
    EXPECT_EQ(compared.difference(), "") << i;
  }
}

TEST(LastingDifference, AFieldThatOnlyOneHasIsOne) {
  for (const bool mine : {true, false}) {
    LastingDifference compared;
    const Json with = {{"mode", "AUTO"}, {"line", 3}}, without = {{"mode", "AUTO"}};
    const Json& own = mine ? with : without;
    for (int i = 0; i <= enough; ++i) compared.sample(mine ? without : with, own, own, period * i);
    EXPECT_EQ(compared.difference(), mine ? "line: nothing and 3" : "line: 3 and nothing");
  }
}

TEST(LastingDifference, WhatComesAndGoesWithinItsDurationIsNone) {
  LastingDifference compared;
  for (int i = 0; i < 60; ++i)
    compared.sample(i % enough < enough - 1 ? Json{{"alarm", 1}} : Json::object(), Json::object(),
                    Json::object(), period * i);
  EXPECT_EQ(compared.difference(), "");
}

}  // namespace
}  // namespace trunnion::gateway
