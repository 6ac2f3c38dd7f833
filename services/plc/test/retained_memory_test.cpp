// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "retained_memory.hpp"

namespace trunnion::plc {
namespace {

std::string temporary(const char* name) {
  const auto path = testing::TempDir() + "plc_" + std::to_string(getpid()) + "_" + name;
  std::filesystem::remove(path);
  return path;
}

TEST(RetainedMemory, GivesBackTheNewestWithItsStartOfTheCluster) {
  const auto path = temporary("newest");
  {
    RetainedMemory retained(path);
    EXPECT_FALSE(retained.load().has_value());
    Memory memory;
    for (const int value : {1, 2, 3}) {
      memory.registers.b[5] = value;
      retained.save("boot", memory);
    }
  }
  const auto kept = RetainedMemory(path).load();
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->boot, "boot");
  EXPECT_EQ(kept->memory.registers.b[5], 3);
}

TEST(RetainedMemory, FallsBackToTheSlotBeforeWhenTheNewestIsDamaged) {
  const auto path = temporary("damaged");
  {
    RetainedMemory retained(path);
    Memory memory;
    memory.registers.b[0] = 1;
    retained.save("", memory);  // into the second slot: both are at sequence 0
    memory.registers.b[0] = 2;
    retained.save("", memory);  // into the first
  }
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(200);
  file.put('\x55');
  file.close();
  const auto kept = RetainedMemory(path).load();
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->memory.registers.b[0], 1);
}

TEST(RetainedMemory, AfterAKillAtAnyMomentASlotIsWhole) {
  const auto path = temporary("killed");
  std::mt19937 random(7);
  std::int32_t newest = 0;
  for (int round = 0; round < 25; ++round) {
    const pid_t writer = fork();
    if (writer == 0) {
      RetainedMemory retained(path);
      Memory memory;
      if (const auto kept = retained.load()) memory = kept->memory;
      for (;;) {
        for (auto& b : memory.registers.b) ++b;  // all alike in a whole slot
        retained.save("", memory);
      }
    }
    usleep(500 + random() % 4000);
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    const auto kept = RetainedMemory(path).load();
    if (!kept) continue;
    for (const auto b : kept->memory.registers.b) ASSERT_EQ(b, kept->memory.registers.b[0]);
    EXPECT_GE(kept->memory.registers.b[0], newest);
    newest = kept->memory.registers.b[0];
  }
  EXPECT_GT(newest, 0);
}

}  // namespace
}  // namespace trunnion::plc
