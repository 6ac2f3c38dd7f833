// SPDX-License-Identifier: Apache-2.0
// Jog, reference and handwheel by themselves: targets, limits and refusals.
#include "manual_motion.hpp"

#include <gtest/gtest.h>

#include "channel_fixture.hpp"
#include "text/quantity.hpp"

namespace trunnion::channel {
namespace {

/// X Y Z of 400 mm to either side.
struct Manual : ::testing::Test {
  Manual() {
    machine.configure(*testing::three_axes());
    manual.configure();
  }
  AxisMove jog(double feed, double increment, const AxisValues& from = {}) {
    return std::get<AxisMove>(manual.jog(0, feed, increment, from));
  }
  channel_setup::ChannelSetup machine{0};
  ManualMotion manual{machine};
};

TEST_F(Manual, AJogGoesByItsIncrementOrToTheEndOfTravelInItsDirection) {
  EXPECT_EQ(jog(1000, 5).target, 5);
  EXPECT_EQ(jog(-1000, 5).target, -5);
  EXPECT_EQ(jog(1000, 0).target, 400);
  EXPECT_EQ(jog(-1000, 0).target, -400);
  EXPECT_EQ(jog(-1000, 0).feed, 1000) << "the direction is in the target";
  EXPECT_EQ(jog(-1000, 0).axis, language::X);
}

TEST_F(Manual, AJogAtTheEndOfTravelIsRefusedAndAwayFromItIsNot) {
  const AxisValues end{400};
  const auto refused = manual.jog(0, 1000, 1, end);
  ASSERT_TRUE(std::holds_alternative<Refusal>(refused));
  EXPECT_EQ(std::get<Refusal>(refused).reason, "Axis X is at its travel limit");
  EXPECT_EQ(jog(-1000, 1, end).target, 399);
}

TEST_F(Manual, TheMoveEndsAtTheTravelAndAnAxisOutsideItMayOnlyComeBack) {
  EXPECT_EQ(manual.command({0, 500, 1000}, {}).target[0], 400);
  EXPECT_EQ(manual.command({0, -500, 1000}, {}).target[0], -400);
  const AxisValues outside{410, 7};
  EXPECT_EQ(manual.command({0, 420, 1000}, outside).target[0], 410);
  EXPECT_EQ(manual.command({0, 405, 1000}, outside).target[0], 405);
  EXPECT_EQ(manual.command({0, 405, 1000}, outside).target[1], 7) << "the other axes stay";
  EXPECT_EQ(manual.command({0, 405, 1000}, outside).modal.feed, 1000);
}

TEST_F(Manual, ErrorsOfTheRequestAreNamedWithTheValueAndTheLimit) {
  EXPECT_FALSE(manual.jog_error(0, 1000));
  EXPECT_EQ(manual.jog_error(3, 1000)->reason, "The channel has no axis number 3");
  const double fastest = machine.jog_feed(0);
  EXPECT_FALSE(manual.jog_error(0, fastest));
  EXPECT_EQ(manual.jog_error(0, fastest + 1000.5)->reason,
            "Jog speed " + text::quantity(fastest + 1000.5, "mm/min") + " is above the " +
                text::quantity(fastest, "mm/min") + " of axis X");
  EXPECT_FALSE(manual.axis_error(2));
  EXPECT_EQ(manual.axis_error(3)->reason, "The channel has no axis number 3");
}

TEST_F(Manual, AReferenceReturnGoesToTheReferencePositionAtItsFeed) {
  const auto move = std::get<AxisMove>(manual.reference(1));
  EXPECT_EQ(move.axis, language::Y);
  EXPECT_EQ(move.target, machine.reference_position()[language::Y]);
  EXPECT_EQ(move.feed, machine.reference_feed(language::Y));
  EXPECT_TRUE(std::holds_alternative<Refusal>(manual.reference(3)));
}

TEST_F(Manual, TheWheelMovesWithinTheTravelFromWhereTheAxisIs) {
  const AxisValues from{395};
  EXPECT_EQ(manual.turn(0, 3, from), 3);
  EXPECT_EQ(manual.turn(0, 3, from), 2) << "395 + 3 + 2 is the end of travel";
  EXPECT_EQ(manual.turn(0, 3, from), 0);
  EXPECT_FALSE(manual.wheel_at_rest());
  for (int i = 0; i < 20000 && !manual.wheel_at_rest(); ++i) manual.step_wheel();
  EXPECT_EQ(manual.wheel()[0], 5);
  manual.end_wheel();
  EXPECT_EQ(manual.wheel()[0], 0);
}

TEST_F(Manual, AnOffsetKeepsThePlannedPathInItsTravelAndTakesItsShareOfTheLimits) {
  EXPECT_FALSE(manual.offset_target());
  EXPECT_EQ(manual.path_limits().axes[0].velocity, machine.limits().axes[0].velocity);
  manual.switch_offset(true);
  const double left = 1 - machine.handwheel_share();
  EXPECT_EQ(manual.path_limits().axes[0].velocity, machine.limits().axes[0].velocity * left);
  EXPECT_EQ(manual.path_limits().axes[0].jerk, machine.limits().axes[0].jerk * left);
  channel_setup::AxisBox path = channel_setup::AxisBox::of({});
  path.high[0] = 398;
  EXPECT_EQ(manual.turn_offset(0, 5, path), 2) << "398 + 2 is the end of travel";
  EXPECT_EQ((*manual.offset_target())[0], 2);
  EXPECT_FALSE(manual.offset_at_rest());
  for (int i = 0; i < 20000 && !manual.offset_at_rest(); ++i) manual.step_offset();
  EXPECT_EQ(manual.offset()[0], 2);
  manual.configure();
  EXPECT_EQ(manual.offset()[0], 2) << "new limits leave the offset where it is";
  // A jog and the wheel reckon with it.
  EXPECT_EQ(jog(1000, 0).target, 398);
  EXPECT_EQ(manual.turn(0, 500, {}), 398);
}

TEST_F(Manual, StopEndsWhatCountsHaveLeft) {
  manual.turn(0, 300, {});
  for (int i = 0; i < 300; ++i) manual.step_wheel();
  manual.stop();
  for (int i = 0; i < 20000 && !manual.wheel_at_rest(); ++i) manual.step_wheel();
  EXPECT_GT(manual.wheel()[0], 0);
  EXPECT_LT(manual.wheel()[0], 100);
}

}  // namespace
}  // namespace trunnion::channel
