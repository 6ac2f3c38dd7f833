// SPDX-License-Identifier: Apache-2.0
#include "service/alarm_board.hpp"

#include <gtest/gtest.h>

#include "machine/alarm_constants.hpp"
#include "testing_support/eventually.hpp"

namespace trunnion::service {
namespace {

using idl::service::Alarm;
using testing_support::eventually;

class AlarmBoardTest : public testing::Test {
 protected:
  AlarmBoardTest() {
    EXPECT_TRUE(eventually([&] { return reader_.matched() == 1; }));
  }
  /// What has been published of an alarm last; waits until `as_expected` holds of it.
  template <class Condition>
  bool published(const machine::AlarmDefinition& alarm, std::uint32_t part, Condition as_expected) {
    return eventually([&] {
      Alarm in;
      while (reader_.take(in)) newest_[{in.number, in.part}] = in;
      const auto found = newest_.find({alarm.number, part});
      return found != newest_.end() && as_expected(found->second);
    });
  }
  bool active(const machine::AlarmDefinition& alarm, std::uint32_t part) {
    return published(alarm, part, [](const Alarm& a) { return a.active; });
  }
  bool inactive(const machine::AlarmDefinition& alarm, std::uint32_t part) {
    return published(alarm, part, [](const Alarm& a) { return !a.active; });
  }
  const Alarm& newest(const machine::AlarmDefinition& alarm, std::uint32_t part) {
    return newest_[{alarm.number, part}];
  }

  bus::Bus bus_{bus::Vendor::cyclonedds, {65}};
  bus::Reader<Alarm> reader_ = bus_.reader(topics::alarm);
  AlarmBoard board_{bus_, 7, "drive"};
  std::map<std::pair<std::uint32_t, std::uint32_t>, Alarm> newest_;
};

TEST_F(AlarmBoardTest, AnAlarmIsPublishedWithWhatTheListSaysOfItAndWhoRaisedIt) {
  board_.raise(alarm::following_error, 3, "Axis 3 is 1.2 mm behind", 4711);
  ASSERT_TRUE(active(alarm::following_error, 3));
  const auto& a = newest(alarm::following_error, 3);
  EXPECT_EQ(a.instance, 7u);
  EXPECT_EQ(a.source, "drive");
  EXPECT_EQ(a.number, 111u);
  EXPECT_EQ(a.severity, idl::service::Severity::ERROR);
  EXPECT_EQ(a.reaction, idl::service::Reaction::AXIS_STOP);
  EXPECT_EQ(a.text, "Axis 3 is 1.2 mm behind");
  EXPECT_EQ(a.cycle, 4711u);
  EXPECT_TRUE(board_.active(alarm::following_error, 3));
  EXPECT_FALSE(board_.active(alarm::following_error, 2));
}

TEST_F(AlarmBoardTest, TheSameTextAgainIsNoNewsAnotherTextIs) {
  board_.raise(alarm::over_travel, 0, "at 500 mm");
  board_.raise(alarm::over_travel, 0, "at 500 mm");
  board_.raise(alarm::over_travel, 0, "at 501 mm");
  ASSERT_TRUE(published(alarm::over_travel, 0, [](const Alarm& a) { return a.text == "at 501 mm"; }));
  EXPECT_EQ(newest(alarm::over_travel, 0).occurrences, 2u);
}

TEST_F(AlarmBoardTest, AResetKeepsWhatStillHoldsAndClearsWhatNoLongerDoes) {
  board_.raise(alarm::over_travel, 0, "over");
  board_.raise(alarm::following_error, 1, "behind");
  board_.release(alarm::following_error, 1);
  EXPECT_TRUE(active(alarm::following_error, 1)) << "released is not cleared";
  board_.reset();
  EXPECT_TRUE(inactive(alarm::following_error, 1));
  EXPECT_TRUE(board_.active(alarm::over_travel, 0));
  EXPECT_TRUE(board_.any());
  board_.release(alarm::over_travel, 0);
  board_.reset();
  EXPECT_TRUE(inactive(alarm::over_travel, 0));
  EXPECT_FALSE(board_.any());
}

TEST_F(AlarmBoardTest, AResetOfSomeLeavesTheOthers) {
  for (const std::uint32_t axis : {1u, 2u}) {
    board_.raise(alarm::following_error, axis, "behind");
    board_.release(alarm::following_error, axis);
  }
  board_.raise(alarm::revision_unknown, 1, "unknown");
  board_.release(alarm::revision_unknown, 1);
  board_.reset([](machine::Subject subject, std::uint32_t part) {
    return subject == machine::Subject::axis && part == 1;
  });
  EXPECT_TRUE(inactive(alarm::following_error, 1));
  EXPECT_TRUE(board_.active(alarm::following_error, 2));
  EXPECT_TRUE(board_.active(alarm::revision_unknown, 1)) << "the same number, but of a channel";
}

TEST_F(AlarmBoardTest, ClearingNeedsNoReset) {
  board_.raise(alarm::redundancy_lost, 4, "one replica");
  ASSERT_TRUE(active(alarm::redundancy_lost, 4));
  board_.clear(alarm::redundancy_lost, 4);
  EXPECT_TRUE(inactive(alarm::redundancy_lost, 4));
  board_.clear(alarm::redundancy_lost, 5);  // never raised
  EXPECT_FALSE(board_.any());
}

TEST_F(AlarmBoardTest, AnEventIsNewsEachTimeAndGoesWithTheNextReset) {
  board_.report(alarm::feed_not_positive, 0, "prog:3:1: text");
  board_.report(alarm::feed_not_positive, 0, "prog:3:1: text");
  const auto twice = [](const Alarm& in) { return in.active && in.occurrences == 2; };
  ASSERT_TRUE(published(alarm::feed_not_positive, 0, twice));
  const auto& a = newest(alarm::feed_not_positive, 0);
  EXPECT_EQ(a.number, 1112u);
  EXPECT_EQ(a.severity, idl::service::Severity::ERROR);
  EXPECT_EQ(a.reaction, idl::service::Reaction::SHOW);
  EXPECT_EQ(a.text, "prog:3:1: text");
  board_.reset();
  EXPECT_FALSE(board_.any());
}

TEST_F(AlarmBoardTest, AMutedBoardPublishesNothingUntilItIsUnmuted) {
  board_.mute();
  board_.raise(alarm::over_travel, 0, "gone before anybody knew");
  board_.clear(alarm::over_travel, 0);
  board_.raise(alarm::following_error, 1, "behind");
  board_.unmute();
  EXPECT_TRUE(active(alarm::following_error, 1));
  EXPECT_EQ(newest_.size(), 1u);
}

TEST_F(AlarmBoardTest, ALongTextEndsWithAMarkWhereTheMessageHoldsNoMore) {
  board_.raise(alarm::storage_failed, 0, std::string(1000, 'x'));
  ASSERT_TRUE(active(alarm::storage_failed, 0));
  EXPECT_EQ(newest(alarm::storage_failed, 0).text, std::string(252, 'x') + " ...");
}

}  // namespace
}  // namespace trunnion::service
