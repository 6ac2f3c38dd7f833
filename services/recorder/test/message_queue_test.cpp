// SPDX-License-Identifier: Apache-2.0
#include "message_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace trunnion::recorder {
namespace {

Message message(std::uint32_t sequence, std::size_t size) {
  return {0, sequence, 0, std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(sequence))};
}

TEST(MessageQueue, KeepsTheOrderOverThreadsAndLosesNothingWithinItsBound) {
  MessageQueue queue(64 << 20);
  constexpr std::uint32_t count = 20000;
  std::thread writer([&] {
    Message m;
    for (std::uint32_t i = 1; i <= count; ++i) {
      m.sequence = i;
      m.cdr.assign(50, static_cast<std::uint8_t>(i));
      ASSERT_TRUE(queue.push(m));
    }
    queue.close();
  });
  std::vector<Message> messages;
  std::uint32_t next = 1;
  while (queue.pop_all(messages, 1))
    for (const auto& m : messages) {
      ASSERT_EQ(m.sequence, next);
      ASSERT_EQ(m.cdr, std::vector<std::uint8_t>(50, static_cast<std::uint8_t>(next)));
      ++next;
    }
  writer.join();
  EXPECT_EQ(next, count + 1);
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(MessageQueue, DropsAndCountsInsteadOfWaiting) {
  MessageQueue queue(1000);
  std::uint32_t accepted = 0;
  for (std::uint32_t i = 0; i < 10; ++i) {
    auto m = message(i, 300);
    accepted += queue.push(m);
  }
  // 300 bytes and what a message costs beside them: three do not fit into 1000 twice over.
  EXPECT_GE(accepted, 2u);
  EXPECT_LE(accepted, 3u);
  EXPECT_EQ(queue.dropped(), 10u - accepted);
  EXPECT_LE(queue.most_used(), 1000u);
}

TEST(MessageQueue, WhatIsBeingWrittenStillCountsAgainstTheBound) {
  MessageQueue queue(1000);
  auto m = message(1, 500);
  ASSERT_TRUE(queue.push(m));
  std::vector<Message> taken;
  ASSERT_TRUE(queue.pop_all(taken, 0));
  auto second = message(2, 500);
  EXPECT_FALSE(queue.push(second));
  EXPECT_EQ(second.cdr.size(), 500u) << "a message that is refused stays whole";
  EXPECT_TRUE(queue.pop_all(taken, 0));
  EXPECT_TRUE(taken.empty());
  EXPECT_TRUE(queue.push(second));
}

TEST(MessageQueue, IsCrowdedUntilWhatFilledHalfOfItIsWritten) {
  MessageQueue queue(1000);
  auto m = message(1, 500);
  queue.push(m);
  EXPECT_TRUE(queue.crowded());
  std::vector<Message> taken;
  queue.pop_all(taken, 0);
  EXPECT_TRUE(queue.crowded()) << "it is being written";
  queue.pop_all(taken, 0);
  EXPECT_FALSE(queue.crowded());
}

TEST(MessageQueue, GivesBuffersBack) {
  MessageQueue queue(1 << 20);
  auto m = message(1, 5000);
  const auto* data = m.cdr.data();
  queue.push(m);
  std::vector<Message> taken;
  queue.pop_all(taken, 0);
  queue.pop_all(taken, 0);
  auto next = message(2, 10);
  queue.push(next);
  EXPECT_EQ(next.cdr.data(), data);
}

}  // namespace
}  // namespace trunnion::recorder
