// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/spindle_sync_speeds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace trunnion::machine_tests {
namespace spindle_sync_speeds_test {
namespace {

using testing::ElementsAre;

// As the lathe: S1 has two gears, S2 none, and none of them more than 4000 1/min.
struct Lathe {
  Lathe() {
    set(103948, 4000), set(104948, 4000);
    set(103981, 800), set(103985, 1000), set(103986, 4000);
  }
  void set(std::uint32_t number, double value) { parameters.values[number] = {value, ""}; }
  SpindleSyncSpeeds in_gear(std::uint8_t gear) const {
    idl::stream::Feedback feedback;
    feedback.spindles.resize(2);
    feedback.spindles[0].gear = gear;
    return {
        parameters, {{3, "S1", machine::axis_type_spindle}, {4, "S2", machine::axis_type_spindle}}, feedback};
  }
  machine::Parameters parameters;
};

TEST(SpindleSyncSpeeds, AreChosenWithinTheGearThatIsEngaged) {
  const Lathe lathe;
  EXPECT_THAT(lathe.in_gear(1).choice(), ElementsAre(500, 1000)) << "2000 would need the other gear";
  EXPECT_THAT(lathe.in_gear(2).choice(), ElementsAre(1000, 2000));
  EXPECT_THAT(lathe.in_gear(0).choice(), ElementsAre(1000, 2000)) << "a spindle without gears";
  EXPECT_EQ(lathe.in_gear(1).text(),
            "0 .. 1000 1/min (S1 in gear 1: 0 .. 1000 1/min; S2 without gears: 0 .. 4000 1/min)");
  EXPECT_EQ(lathe.in_gear(2).lowest(), 800);
  EXPECT_EQ(lathe.in_gear(2).highest(), 4000);
}

TEST(SpindleSyncSpeeds, ComeAsNearTo1000And2000AsTheRangeLets) {
  const auto choice = [](double lowest, double highest) {
    Lathe lathe;
    lathe.set(103980, lowest), lathe.set(103985, highest);
    lathe.set(103948, 0), lathe.set(104948, 0);
    return lathe.in_gear(1).choice();
  };
  EXPECT_THAT(choice(0, 1500), ElementsAre(750, 1500));
  EXPECT_THAT(choice(900, 1000), ElementsAre(900, 1000));
  EXPECT_THAT(choice(1500, 6000), ElementsAre(1500, 2000));
  EXPECT_THAT(choice(2500, 6000), ElementsAre(2500, 5000));
  EXPECT_THAT(choice(2500, 3000), ElementsAre(2500, 3000));
  EXPECT_THAT(choice(300, 300), ElementsAre(300)) << "there is no other";
}

TEST(SpindleSyncSpeeds, OneOutsideIsRefusedWithGearRangeAndTheGearThatHasIt) {
  const Lathe lathe;
  for (const double speed : {1.0, 500.0, 1000.0}) EXPECT_EQ(lathe.in_gear(1).refusal(speed), "") << speed;
  EXPECT_EQ(
      lathe.in_gear(1).refusal(2000),
      "2000 1/min cannot be tested: spindle S1 is in gear 1, which has 0 .. 1000 1/min (103985); engage "
      "gear 2 (M42, 800 .. 4000 1/min) at rest first; now the spindles have 0 .. 1000 1/min");
  EXPECT_EQ(
      lathe.in_gear(2).refusal(500),
      "500 1/min cannot be tested: spindle S1 is in gear 2, which has 800 .. 4000 1/min (103981); engage "
      "gear 1 (M41, 0 .. 1000 1/min) at rest first; now the spindles have 800 .. 4000 1/min");
  EXPECT_EQ(
      lathe.in_gear(2).refusal(5000),
      "5000 1/min cannot be tested: spindle S1 is in gear 2, which has 800 .. 4000 1/min (103986); now the "
      "spindles have 800 .. 4000 1/min");
}

TEST(SpindleSyncSpeeds, TheOtherSpindleBoundsThemToo) {
  Lathe lathe;
  lathe.set(104948, 900);
  EXPECT_THAT(lathe.in_gear(2).choice(), ElementsAre(800, 900));
  EXPECT_EQ(
      lathe.in_gear(2).refusal(1000),
      "1000 1/min cannot be tested: spindle S2 has 0 .. 900 1/min (104948); now the spindles have 800 .. "
      "900 1/min");
  lathe.set(104948, 700);
  try {
    lathe.in_gear(2).choice();
    FAIL() << "no speed is in both";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(
        error.what(),
        "no speed is in the range of all spindles (S1 in gear 2: 800 .. 4000 1/min; S2 without gears: "
        "0 .. 700 1/min): engage other gears at rest first");
  }
  lathe.set(103948, 0), lathe.set(104948, 0);
  EXPECT_TRUE(std::isinf(lathe.in_gear(0).highest()));
  EXPECT_EQ(lathe.in_gear(0).text(),
            "0 1/min and more (S1 without gears: 0 1/min and more; S2 without gears: 0 1/min and more)");
}

}  // namespace
}  // namespace spindle_sync_speeds_test
}  // namespace trunnion::machine_tests
