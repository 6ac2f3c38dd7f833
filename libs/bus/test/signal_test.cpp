// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <chrono>
#include <thread>

#include "bus/endpoint.hpp"

namespace {
thread_local long locks_of_this_thread = 0;
}  // namespace

// Takes the place of the C library's in this program, so that locks can be counted.
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  using Lock = int (*)(pthread_mutex_t*);
  static const auto lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  ++locks_of_this_thread;
  return lock(mutex);
}

namespace trunnion::bus {
namespace {

TEST(Signal, NotifyingTakesNoLockWhetherTheThreadWaitsOrNot) {
  Signal signal;
  const long before = locks_of_this_thread;
  signal.notify();
  signal.notify();
  EXPECT_EQ(locks_of_this_thread, before);
  EXPECT_TRUE(signal.wait(10));
  std::thread waiting([&] { EXPECT_TRUE(signal.wait(10)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const long then = locks_of_this_thread;
  signal.notify();
  EXPECT_EQ(locks_of_this_thread, then);
  waiting.join();
}

TEST(Signal, NotificationsBeforeAWaitEndItOnce) {
  Signal signal;
  signal.notify();
  signal.notify();
  EXPECT_TRUE(signal.wait(10));
  EXPECT_FALSE(signal.wait(0.001));
  EXPECT_FALSE(signal.wait(0));
  signal.notify();
  EXPECT_TRUE(signal.wait(0)) << "a wait of no length still says whether there was a notification";
}

TEST(Signal, NoNotificationIsLostBetweenTwoThreads) {
  Signal ping, pong;
  constexpr int rounds = 20000;
  std::thread other([&] {
    for (int i = 0; i < rounds && ping.wait(30); ++i) pong.notify();
  });
  int done = 0;
  for (; done < rounds; ++done) {
    ping.notify();
    if (!pong.wait(30)) break;
  }
  other.join();
  EXPECT_EQ(done, rounds);
}

}  // namespace
}  // namespace trunnion::bus
