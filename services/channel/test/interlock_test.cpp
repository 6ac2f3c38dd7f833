// SPDX-License-Identifier: Apache-2.0
// What others let a channel do, by itself.
#include "interlock.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

std::string reason_of(const std::optional<Refusal>& refusal) { return refusal ? refusal->reason : ""; }

TEST(Interlock, LetsNothingMoveBeforeTheClusterIsReady) {
  Interlock interlock;
  EXPECT_EQ(reason_of(interlock.motion(false)), "The cluster is not ready: see the services");
  interlock.set_ready(true);
  EXPECT_EQ(reason_of(interlock.motion(false)), "");
}

TEST(Interlock, LetsOnlyWhatTheDriveHasInterruptedGoOn) {
  Interlock interlock;
  interlock.set_ready(true);
  interlock.set_drive_stopped("Setpoints were missing");
  EXPECT_EQ(reason_of(interlock.motion(false)), "Setpoints were missing");
  EXPECT_EQ(reason_of(interlock.motion(true)), "");
  interlock.set_hold("Feed hold of the PLC");
  EXPECT_TRUE(interlock.holds());
  EXPECT_EQ(reason_of(interlock.motion(true)), "Feed hold of the PLC");
  interlock.set_hold("");
  interlock.set_drive_stopped("");
  EXPECT_FALSE(interlock.holds());
  EXPECT_EQ(reason_of(interlock.motion(false)), "");
}

TEST(Interlock, GivesTheReasonOfThePlcWhenItHasOne) {
  Interlock interlock;
  idl::plc::ChannelControl control;
  control.start_inhibit = control.manual_inhibit = true;
  interlock.set_control(control);
  EXPECT_EQ(reason_of(interlock.start()), "No cycle start: the machine's PLC inhibits it");
  EXPECT_EQ(reason_of(interlock.manual_motion()), "No manual motion: the machine's PLC inhibits it");
  control.reason = "close the door";
  control.manual_inhibit = false;
  interlock.set_control(control);
  EXPECT_EQ(reason_of(interlock.start()), "No cycle start: close the door");
  EXPECT_EQ(reason_of(interlock.manual_motion()), "");
}

TEST(Interlock, SaysOnceThatManualMotionIsInhibitedFromNowOn) {
  Interlock interlock;
  idl::plc::ChannelControl control;
  EXPECT_FALSE(interlock.set_control(control));
  control.manual_inhibit = true;
  EXPECT_TRUE(interlock.set_control(control));
  EXPECT_FALSE(interlock.set_control(control));
}

}  // namespace
}  // namespace trunnion::channel
