// SPDX-License-Identifier: Apache-2.0
// A process that is killed at a random instant of what it repeats.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <new>
#include <random>

namespace trunnion::testing_support {

/// Calls repeat(done) in a child process, which calls done() after each repetition and never returns, and
/// kills it at a random instant behind up to `most` repetitions: by their count, not by the time, so that a
/// slow disk changes nothing in what is tested.
template <class Repeat>
void kill_while(std::mt19937& random, unsigned most, Repeat repeat) {
  using Count = std::atomic<unsigned>;
  void* const shared =
      mmap(nullptr, sizeof(Count), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(shared, MAP_FAILED);
  auto& count = *new (shared) Count(0);
  const auto began = std::chrono::steady_clock::now();
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    repeat([&count] { ++count; });
    _exit(1);
  }
  const auto elapsed = [&] {
    return static_cast<unsigned>(
        std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - began)
            .count());
  };
  const unsigned wanted = static_cast<unsigned>(random()) % (most + 1);
  constexpr unsigned longest = 60'000'000;  // us
  while (count < wanted && elapsed() < longest) usleep(20);
  EXPECT_GE(count, wanted) << "the child does not repeat anything";
  const unsigned one = count > 0 ? elapsed() / count : 500;
  usleep(static_cast<unsigned>(random()) % (one + 1));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  munmap(shared, sizeof(Count));
}

}  // namespace trunnion::testing_support
