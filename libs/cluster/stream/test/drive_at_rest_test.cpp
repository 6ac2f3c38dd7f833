// SPDX-License-Identifier: Apache-2.0
#include "stream/drive_at_rest.hpp"

#include <gtest/gtest.h>

namespace trunnion::stream {
namespace {

using idl::stream::SpindleCondition;

// Two spindles at rest. Without a master the drive says -1.
idl::stream::Feedback two_spindles() {
  idl::stream::Feedback feedback;
  feedback.spindle_speed = {0, 0};
  feedback.spindles.resize(2);
  for (auto& spindle : feedback.spindles) spindle.master = -1;
  return feedback;
}

TEST(DriveAtRest, ASpindleThatTurnsIsNamedWithItsSpeed) {
  auto feedback = two_spindles();
  EXPECT_EQ(spindle_at_work(feedback), "");
  feedback.spindle_speed = {5, -5};  // as SPINDLE_STOPPED has it
  EXPECT_EQ(spindle_at_work(feedback), "");
  feedback.spindle_speed = {0, -1200.4};
  EXPECT_EQ(spindle_at_work(feedback), "spindle 2 turns at 1200 1/min; stop it (M5) first");
  feedback.spindle_speed = {6, -1200.4};
  EXPECT_EQ(spindle_at_work(feedback), "spindle 1 turns at 6 1/min; stop it (M5) first");
  EXPECT_EQ(spindle_at_work({}), "") << "a machine without a spindle";
}

TEST(DriveAtRest, SynchronizedSpindlesAreAtWorkAlsoAtStandstill) {
  for (const auto condition :
       {SpindleCondition::SPINDLE_SYNCHRONIZING, SpindleCondition::SPINDLE_SYNCHRONIZED}) {
    auto feedback = two_spindles();
    feedback.spindles[1].condition = condition;
    feedback.spindles[1].master = 0;
    EXPECT_EQ(spindle_at_work(feedback),
              "spindle 2 follows spindle 1, at 0 1/min; stop both and end the synchronization first");
    feedback.spindle_speed = {500, 500};
    EXPECT_EQ(spindle_at_work(feedback),
              "spindle 2 follows spindle 1, at 500 1/min; stop both and end the synchronization first")
        << "and not the master alone";
  }
}

TEST(DriveAtRest, ATapIsAtWorkInItsStrokeAndWhereItWasLeft) {
  auto feedback = two_spindles();
  feedback.spindles[0].condition = SpindleCondition::SPINDLE_FOLLOWS_PATH;
  EXPECT_EQ(spindle_at_work(feedback),
            "spindle 1 follows the path of a tap, at 0 1/min; let the tap come out of its hole first");
  idl::channel::ChannelState state;
  EXPECT_EQ(tap_in_hole(state), "");
  state.detail = "the feed override is 0 %";
  EXPECT_EQ(tap_in_hole(state), "");
  state.detail =
      "a tap is in its hole: right-hand thread, lead 1.25 mm, 6.500 mm deep; G84.9 or G39+ removes it";
  EXPECT_EQ(tap_in_hole(state), state.detail);
}

}  // namespace
}  // namespace trunnion::stream
