// SPDX-License-Identifier: Apache-2.0
#include "reading_progress.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trunnion::recorder {
namespace {

idl::stream::Feedback feedback(std::uint64_t first, std::uint32_t count) {
  idl::stream::Feedback batch;
  batch.first = first, batch.count = count;
  return batch;
}

TEST(ReadingProgress, ReportsThreeQuartersOfWhatTheWritersMemoryHolds) {
  ReadingProgress progress(7);
  EXPECT_FALSE(progress.take()) << "nothing was read";
  // 16 cycles in 16384 bytes are 1024 bytes each: three quarters of 4 MiB hold 3072 cycles.
  progress.read(feedback(1000, 16), 16384);
  const auto report = progress.take();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->recorder, 7u);
  EXPECT_EQ(report->until, 1016u + 3072u);
  EXPECT_FALSE(progress.take()) << "it was published";
}

TEST(ReadingProgress, ABatchWithoutCyclesChangesNothing) {
  ReadingProgress progress(7);
  progress.read(feedback(1000, 16), 16384);
  progress.read(feedback(1016, 0), 300);
  EXPECT_EQ(progress.take()->until, 1016u + 3072u);
}

TEST(ReadingProgress, StaysBetweenTheLeastAMotionNeedsAndTheMostTheWritersKeepForDds) {
  ReadingProgress many_axes(1), one_axis(2);
  many_axes.read(feedback(0, 16), 16 * 100'000);
  EXPECT_EQ(many_axes.take()->until, 16u + 1024u);
  one_axis.read(feedback(0, 16), 16 * 8);
  EXPECT_EQ(one_axis.take()->until, 16u + 12288u);
}

TEST(ReadingProgress, AtItsEndNobodyWaits) {
  ReadingProgress progress(7);
  progress.read(feedback(1000, 16), 16384);
  EXPECT_EQ(progress.ended().recorder, 7u);
  EXPECT_EQ(progress.ended().until, std::numeric_limits<std::uint64_t>::max());
}

}  // namespace
}  // namespace trunnion::recorder
