// SPDX-License-Identifier: Apache-2.0
#include "cluster/cluster_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace trunnion::cluster {
namespace {

namespace fs = std::filesystem;

TEST(FreeDomain, IsNotTheOneOfAVerificationThatLastsLong) {
  const RunDirectory taken{free_domain()};
  fs::create_directories(taken.verification());
  // What nobody uses is cleared away a minute after its last change.
  fs::last_write_time(taken.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
  // Both searches begin at the same domain, because it follows from the number of the process.
  const RunDirectory other{free_domain()};
  EXPECT_NE(other.domain, taken.domain);
  EXPECT_TRUE(fs::exists(taken.verification()));
  other.remove();
  taken.remove();
}

}  // namespace
}  // namespace trunnion::cluster
