#include "src/lasting_difference.hpp"

#include <gtest/gtest.h>

namespace trunnion::gateway {
namespace {

using bus::Json;

TEST(LastingDifference, WhatBothShowAlikeOrOneALittleLaterIsNone) {
  LastingDifference looking;
  for (int i = 0; i < 40; ++i) {
    // Own is one look behind whenever the value changes, every fifth look.
    looking.look({{"line", i / 5}}, {{"line", (i - 1) / 5}}, 0.1 * i);
    EXPECT_EQ(looking.difference(), "") << i;
  }
  EXPECT_TRUE(looking.settled(4.0));
}

TEST(LastingDifference, AValueThatStaysAnotherIsOneAfterItsPatienceWithBothValues) {
  LastingDifference looking;
  for (int i = 0; i <= 9; ++i) looking.look({{"axes", {{"0", 1.5}}}}, {{"axes", {{"0", 1.502}}}}, 0.1 * i);
  EXPECT_EQ(looking.difference(), "");
  EXPECT_FALSE(looking.settled(0.9));
  looking.look({{"axes", {{"0", 1.5}}}}, {{"axes", {{"0", 1.502}}}}, LastingDifference::patience);
  EXPECT_EQ(looking.difference(), "axes/0: 1.5 and 1.502");
}

TEST(LastingDifference, PositionsInMotionAreNotComparedUntilOneOfThemRests) {
  LastingDifference looking;
  int i = 0;
  for (; i < 30; ++i) looking.look({{"x", i}}, {{"x", i + 7}}, 0.1 * i);
  EXPECT_EQ(looking.difference(), "");
  // The running one goes on and its successor stands.
  for (; i < 45; ++i) looking.look({{"x", i}}, {{"x", -1}}, 0.1 * i);
  EXPECT_EQ(looking.difference().substr(0, 3), "x: ");
}

TEST(LastingDifference, AFieldThatOnlyOneHasIsOne) {
  for (const bool mine : {true, false}) {
    LastingDifference looking;
    const Json with = {{"mode", "AUTO"}, {"line", 3}}, without = {{"mode", "AUTO"}};
    for (int i = 0; i <= 10; ++i) looking.look(mine ? without : with, mine ? with : without, 0.1 * i);
    EXPECT_EQ(looking.difference(), mine ? "line: nothing and 3" : "line: 3 and nothing");
  }
}

TEST(LastingDifference, WhatComesAndGoesWithinItsPatienceIsNone) {
  LastingDifference looking;
  for (int i = 0; i < 30; ++i)
    looking.look(i % 8 < 7 ? Json{{"alarm", 1}} : Json::object(), Json::object(), 0.1 * i);
  EXPECT_EQ(looking.difference(), "");
}

}  // namespace
}  // namespace trunnion::gateway
