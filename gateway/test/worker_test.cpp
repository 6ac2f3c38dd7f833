// SPDX-License-Identifier: Apache-2.0
#include "core/worker.hpp"

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace trunnion::gateway {
namespace {

/// A job that has begun and ends when it is told to.
struct Busy {
  explicit Busy(Worker& worker) {
    worker.post([this] {
      begun.set_value();
      end.get_future().wait();
    });
    begun.get_future().wait();
  }
  std::promise<void> begun, end;
};

TEST(Worker, RequestsBeyondThoseThatMayWaitAreRefusedAndNothingElse) {
  std::vector<int> done;
  Worker worker("test", 2);
  Busy busy(worker);
  EXPECT_TRUE(worker.offer([&] { done.push_back(1); }));
  EXPECT_TRUE(worker.offer([&] { done.push_back(2); }));
  EXPECT_FALSE(worker.offer([&] { done.push_back(3); }));
  std::promise<void> all;
  worker.post([&] { done.push_back(4); });
  worker.post([&] { all.set_value(); });
  busy.end.set_value();
  all.get_future().wait();
  EXPECT_EQ(done, (std::vector<int>{1, 2, 4})) << "in their order";
  EXPECT_TRUE(worker.offer([] {})) << "the others are done";
}

}  // namespace
}  // namespace trunnion::gateway
