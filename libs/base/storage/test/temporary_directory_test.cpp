// SPDX-License-Identifier: Apache-2.0
#include "storage/temporary_directory.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace trunnion::storage {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryDirectory, IsAnotherOneEachTimeForItsUserAloneAndEndsWithWhatIsInIt) {
  fs::path first;
  {
    const TemporaryDirectory a("trunnion-tested"), b("trunnion-tested");
    first = a.path();
    EXPECT_NE(a.path(), b.path());
    EXPECT_EQ(fs::status(first).permissions(), fs::perms::owner_all);
    fs::create_directory(first / "inner");
    std::ofstream(first / "inner" / "file") << "text";
    ASSERT_TRUE(fs::exists(first / "inner" / "file"));
  }
  EXPECT_FALSE(fs::exists(first));
}

}  // namespace
}  // namespace trunnion::storage
