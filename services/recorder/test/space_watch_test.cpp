// SPDX-License-Identifier: Apache-2.0
#include "space_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace trunnion::recorder {
namespace {

using Kind = SpaceWatch::Kind;

constexpr std::uint64_t megabyte = 1'000'000;

// A disk, and a recording on it that writes `rate` bytes in every second.
class Disk {
 public:
  explicit Disk(std::uint64_t free, std::uint64_t needed = 200 * megabyte) : watch(needed), free_(free) {}

  SpaceWatch::Finding second(std::uint64_t rate) {
    now += 1;
    written_ += rate;
    free_ -= std::min(free_, rate);
    return watch.look("day.mcap", free_, written_, now);
  }
  /// The findings of so many seconds that are any.
  std::vector<SpaceWatch::Finding> seconds(int count, std::uint64_t rate) {
    std::vector<SpaceWatch::Finding> findings;
    for (int i = 0; i < count; ++i)
      if (auto finding = second(rate); finding.kind != Kind::unchanged) findings.push_back(finding);
    return findings;
  }
  void other_program(std::int64_t bytes) {
    free_ = static_cast<std::uint64_t>(static_cast<std::int64_t>(free_) - bytes);
  }

  SpaceWatch watch;
  double now = 100;

 private:
  std::uint64_t free_, written_ = 0;
};

TEST(SpaceWatch, LooksOnceASecondAndNeverWithoutALimit) {
  SpaceWatch watch(200 * megabyte);
  EXPECT_TRUE(watch.due(10));
  watch.look("day.mcap", 1000 * megabyte, 0, 10);
  EXPECT_FALSE(watch.due(10.9));
  EXPECT_TRUE(watch.due(11));
  EXPECT_FALSE(SpaceWatch(0).due(10));
}

TEST(SpaceWatch, FindsNothingWhileThereIsSpace) {
  Disk disk(1000 * megabyte);
  EXPECT_TRUE(disk.seconds(400, 2 * megabyte).empty()) << "200 MB are left";
}

// 1 MB/s from 300 MB: below 200 MB with second 101, 199 MB free; 179 MB to the reserve of 20 MB.
TEST(SpaceWatch, WarnsOnceBelowTheLimitWithTheTimeAtTheMeasuredRate) {
  Disk disk(300 * megabyte);
  const auto findings = disk.seconds(110, megabyte);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].kind, Kind::low);
  EXPECT_EQ(findings[0].text, "199.0 MB are free: the recording ends in 3 min at 1.0 MB/s; disk of day.mcap");
}

// It states 179 s, and then 89, 44, 21, 10, 4, 1 and 0 s: each the first below half of the one before.
TEST(SpaceWatch, WarnsAgainWheneverTheTimeHasHalvedAndEndsAtTheReserve) {
  Disk disk(300 * megabyte);
  const auto findings = disk.seconds(281, megabyte);
  ASSERT_EQ(findings.size(), 9u);
  EXPECT_EQ(findings[1].text, "109.0 MB are free: the recording ends in 89 s at 1.0 MB/s; disk of day.mcap");
  EXPECT_EQ(findings[2].text, "64.0 MB are free: the recording ends in 44 s at 1.0 MB/s; disk of day.mcap");
  EXPECT_EQ(findings[8].kind, Kind::full);
  EXPECT_EQ(findings[8].text,
            "day.mcap: the disk is full: 19.0 MB are free, the last 20.0 MB are kept for the machine");
}

TEST(SpaceWatch, CountsWhatOtherProgramsWriteToTheDisk) {
  Disk disk(300 * megabyte);
  disk.seconds(10, megabyte);
  disk.other_program(100 * megabyte);  // 190 MB, and 189 MB after this second: 111 MB in 10 s, 169 MB to go
  EXPECT_EQ(disk.second(megabyte).text,
            "189.0 MB are free: the recording ends in 15 s at 11.0 MB/s; disk of day.mcap");
}

TEST(SpaceWatch, TakesTheWarningBackWhenThereIsSpaceAgain) {
  Disk disk(201 * megabyte);
  EXPECT_EQ(disk.seconds(5, megabyte).size(), 1u);
  disk.other_program(-20 * megabyte);  // 216 MB: less than a tenth above the limit
  EXPECT_TRUE(disk.seconds(1, 0).empty());
  disk.other_program(-10 * megabyte);
  EXPECT_EQ(disk.second(0).kind, Kind::enough);
  EXPECT_TRUE(disk.seconds(1, 0).empty());
  disk.other_program(100 * megabyte);
  EXPECT_EQ(disk.second(0).kind, Kind::low);
}

TEST(SpaceWatch, StatesNoTimeWhenNothingIsWritten) {
  Disk disk(150 * megabyte);
  const auto findings = disk.seconds(100, 0);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].text, "150.0 MB are free; disk of day.mcap");
}

TEST(SpaceWatch, EndsAtOnceOnAFullDisk) {
  Disk disk(0);
  EXPECT_EQ(disk.second(0).kind, Kind::full);
  EXPECT_TRUE(disk.seconds(10, 0).empty()) << "once";
}

}  // namespace
}  // namespace trunnion::recorder
