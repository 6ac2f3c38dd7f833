#include "src/lasting_difference.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using bus::Json;
constexpr double period = 0.1;  // s between two looks
// The difference has lasted at look number patience / period, counted from 0, which is more than
// looks_in_a_row.
constexpr int enough = 15;

TEST(LastingDifference, WhatBothShowAlikeOrOneALittleLaterIsNone) {
  LastingDifference looking;
  for (int i = 0; i < 60; ++i) {
    // The running one is a look behind whenever the value changes, every fifth look.
    const Json own = {{"line", i / 5}};
    looking.look({{"line", (i + 4) / 5 - 1}}, own, own, period * i);
    EXPECT_EQ(looking.difference(), "") << i;
  }
  EXPECT_TRUE(looking.settled(period * 60));
}

TEST(LastingDifference, AValueThatStaysAnotherIsOneAfterItsPatienceWithBothValues) {
  LastingDifference looking;
  const Json running = {{"axes", {{"0", 1.5}}}}, own = {{"axes", {{"0", 1.502}}}};
  for (int i = 0; i < enough; ++i) looking.look(running, own, own, period * i);
  EXPECT_EQ(looking.difference(), "");
  EXPECT_FALSE(looking.settled(period * enough));
  looking.look(running, own, own, LastingDifference::patience);
  EXPECT_EQ(looking.difference(), "axes/0: 1.5 and 1.502");
}

TEST(LastingDifference, FewLooksAreNotEnoughHoweverLongTheyTake) {
  LastingDifference looking;
  for (int i = 0; i < LastingDifference::looks_in_a_row - 1; ++i)
    looking.look({{"x", 1}}, {{"x", 2}}, {{"x", 2}}, 1.0 * i);
  EXPECT_EQ(looking.difference(), "");
  EXPECT_FALSE(looking.settled(100));
}

TEST(LastingDifference, PositionsInMotionAreNotComparedUntilTheirOwnRest) {
  LastingDifference looking;
  int i = 0;
  for (; i < 60; ++i) looking.look({{"x", i}}, {{"x", i + 7}}, {{"x", i + 8}}, period * i);
  EXPECT_EQ(looking.difference(), "");
  // The running one goes on and its successor stands.
  for (; i < 60 + 2 * enough; ++i) looking.look({{"x", i}}, {{"x", -1}}, {{"x", -1}}, period * i);
  EXPECT_EQ(looking.difference().substr(0, 3), "x: ");
}

TEST(LastingDifference, AValueThatGoesToAndFroIsNoneHoweverSeldomTheTwoMeet) {
  LastingDifference looking;
  for (int i = 0; i < 200; ++i) {
    const Json own = {{"ahead", 60 + i % 3}};
    looking.look({{"ahead", 60 + (i + 1) % 3}}, own, own, period * i);
    EXPECT_EQ(looking.difference(), "") << i;
  }
}

TEST(LastingDifference, AFieldThatOnlyOneHasIsOne) {
  for (const bool mine : {true, false}) {
    LastingDifference looking;
    const Json with = {{"mode", "AUTO"}, {"line", 3}}, without = {{"mode", "AUTO"}};
    const Json& own = mine ? with : without;
    for (int i = 0; i <= enough; ++i) looking.look(mine ? without : with, own, own, period * i);
    EXPECT_EQ(looking.difference(), mine ? "line: nothing and 3" : "line: 3 and nothing");
  }
}

TEST(LastingDifference, WhatComesAndGoesWithinItsPatienceIsNone) {
  LastingDifference looking;
  for (int i = 0; i < 60; ++i)
    looking.look(i % enough < enough - 1 ? Json{{"alarm", 1}} : Json::object(), Json::object(),
                 Json::object(), period * i);
  EXPECT_EQ(looking.difference(), "");
}

}  // namespace
}  // namespace trunnion::gateway
