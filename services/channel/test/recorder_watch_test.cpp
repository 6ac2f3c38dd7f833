// SPDX-License-Identifier: Apache-2.0
#include "recorder_watch.hpp"

#include <gtest/gtest.h>

namespace trunnion::channel {
namespace {

TEST(RecorderWatch, WithoutARecorderNothingIsWaitedFor) {
  RecorderWatch watch;
  EXPECT_EQ(watch.limit(1'000'000, 0), RecorderWatch::everywhere);
}

TEST(RecorderWatch, TheSlowestRecorderSetsTheLimit) {
  RecorderWatch watch;
  watch.update({1, 5000});
  watch.update({2, 3000});
  EXPECT_EQ(watch.limit(100, 0), 3000u);
  watch.update({2, 9000});
  EXPECT_EQ(watch.limit(100, 0), 5000u);
}

TEST(RecorderWatch, ARecorderThatHasEndedIsNotWaitedFor) {
  RecorderWatch watch;
  watch.update({1, 5000});
  watch.update({1, RecorderWatch::everywhere});
  EXPECT_EQ(watch.limit(6000, 0), RecorderWatch::everywhere);
}

TEST(RecorderWatch, ARecorderThatHoldsTheChannelUpAndReportsNothingIsGivenUpAndTakenBackByAReport) {
  RecorderWatch watch;
  watch.update({1, 5000});
  EXPECT_EQ(watch.limit(4000, 0), 5000u);
  EXPECT_EQ(watch.limit(4000, 100), 5000u) << "it holds nothing up, and may be silent while the axes rest";
  EXPECT_EQ(watch.limit(5001, 101), 5000u);
  EXPECT_EQ(watch.limit(5001, 100.9 + RecorderWatch::report_timeout), 5000u);
  EXPECT_EQ(watch.limit(5001, 101.1 + RecorderWatch::report_timeout), RecorderWatch::everywhere);
  watch.update({1, 7000});
  EXPECT_EQ(watch.limit(5001, 103), 7000u);
}

TEST(RecorderWatch, AReportEndsTheWait) {
  RecorderWatch watch;
  watch.update({1, 5000});
  EXPECT_EQ(watch.limit(5001, 0), 5000u);
  watch.update({1, 5010});
  EXPECT_EQ(watch.limit(5020, 0.6), 5010u);
  EXPECT_EQ(watch.limit(5020, 1.2), 5010u) << "the timeout counts from the report";
}

}  // namespace
}  // namespace trunnion::channel
