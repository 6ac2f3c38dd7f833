// SPDX-License-Identifier: Apache-2.0
#include "cluster/cluster_files.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

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

// A directory that ends while another process looks at it must not be taken for an abandoned one: the next
// who reserves the domain would lose its directory.
TEST(FreeDomain, ReservationsOfManyAtOnceLeaveEachOtherAlone) {
  std::atomic<int> lost{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 6; ++t)
    threads.emplace_back([&] {
      for (int i = 0; i < 600; ++i) {
        const RunDirectory run{free_domain(10)};
        const auto mark = run.path() + "/mark";
        std::ofstream(mark) << i;
        std::this_thread::yield();
        if (!std::filesystem::exists(mark)) ++lost;
        run.remove();
      }
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(lost, 0);
}

}  // namespace
}  // namespace trunnion::cluster
