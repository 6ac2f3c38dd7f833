// SPDX-License-Identifier: Apache-2.0
#include "recording/disk_space.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace trunnion::recording {
namespace {

TEST(DiskSpace, IsWrittenWithTheUnitThatFits) {
  EXPECT_EQ(size_text(0), "0 kB");
  EXPECT_EQ(size_text(850'000), "850 kB");
  EXPECT_EQ(size_text(999'600), "1.0 MB");
  EXPECT_EQ(size_text(12'500'000), "12.5 MB");
  EXPECT_EQ(size_text(999'960'000), "1.0 GB");
  EXPECT_EQ(size_text(65'000'000'000), "65.0 GB");
}

TEST(DiskSpace, RefusesOnlyBelowTheLimitAndNamesBothSizes) {
  EXPECT_EQ(space_refusal("day.mcap", 200'000'000, 200'000'000), "");
  EXPECT_EQ(space_refusal("day.mcap", 0, 0), "") << "no limit";
  EXPECT_EQ(
      space_refusal("day.mcap", 3'100'000, 200'000'000),
      "day.mcap: 3.1 MB are free on its disk, a recording needs 200.0 MB: delete files there, or record to "
      "another disk");
}

TEST(DiskSpace, IsThatOfTheFilesDirectory) {
  const std::string file = testing::TempDir() + "/not_there.mcap";
  const auto known = std::filesystem::space(testing::TempDir()).capacity;
  ASSERT_TRUE(free_space(file));
  EXPECT_LE(*free_space(file), known);
  EXPECT_TRUE(free_space("not_there.mcap")) << "in the working directory";
  EXPECT_FALSE(free_space("/dev/null")) << "a device does not fill up";
  EXPECT_FALSE(free_space(testing::TempDir() + "/no/such/directory.mcap"));
}

}  // namespace
}  // namespace trunnion::recording
