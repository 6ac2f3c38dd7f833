// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "retained_memory.hpp"
#include "testing_support/damage.hpp"

namespace trunnion::plc {
namespace {

std::string temporary(const char* name) {
  const auto path = testing::TempDir() + "plc_" + std::to_string(getpid()) + "_" + name;
  for (const auto* suffix : {"", ".previous", ".damaged", ".previous.damaged"})
    std::filesystem::remove(path + suffix);
  return path;
}

TEST(RetainedMemory, GivesBackTheNewestWithItsStartOfTheCluster) {
  const auto path = temporary("newest");
  {
    RetainedMemory retained(path);
    EXPECT_EQ(retained.load().state, storage::KeptState::absent);
    Memory memory;
    for (const int value : {1, 2, 3}) {
      memory.registers.b[5] = value;
      retained.save("boot", memory);
    }
  }
  const auto found = RetainedMemory(path).load();
  ASSERT_EQ(found.state, storage::KeptState::good) << found.problem;
  const auto& kept = found.kept;
  EXPECT_EQ(kept->boot, "boot");
  EXPECT_EQ(kept->memory.registers.b[5], 3);
}

// Every damage of either file: the registers of the save before, and a text that names the file. The two
// newest saves have the same registers but for register 0, which counts them.
TEST(RetainedMemory, FallsBackToTheOtherFileWhenOneIsDamaged) {
  for (const auto* suffix : {"", ".previous"})
    for (const auto how : testing_support::all_damages) {
      const auto path = temporary("damaged");
      std::string old;
      {
        RetainedMemory retained(path);
        Memory memory;
        for (int save = 1; save <= 9; ++save) {
          memory.registers.b[0] = save;
          memory.registers.b[7] = 77;
          retained.save("boot", memory);
          if (save == 4) old = testing_support::read_bytes(path + suffix);
        }
      }
      testing_support::damage(path + suffix, how, old, "another file", 1);
      const auto found = RetainedMemory(path).load();
      EXPECT_EQ(found.state, storage::KeptState::previous) << suffix << " " << name_of(how);
      ASSERT_TRUE(found.kept) << suffix << " " << name_of(how);
      EXPECT_GE(found.kept->memory.registers.b[0], 8);
      EXPECT_EQ(found.kept->memory.registers.b[7], 77);
      EXPECT_NE(found.problem.find("plc_"), std::string::npos) << found.problem;
    }
}

TEST(RetainedMemory, WithBothFilesDamagedNothingIsUsed) {
  const auto path = temporary("both");
  RetainedMemory(path).save("boot", Memory{});
  for (const auto* suffix : {"", ".previous"}) testing_support::write_bytes(path + suffix, "");
  const auto found = RetainedMemory(path).load();
  EXPECT_EQ(found.state, storage::KeptState::unusable);
  EXPECT_FALSE(found.kept);
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
      if (const auto found = retained.load(); found.kept) memory = found.kept->memory;
      for (;;) {
        for (auto& b : memory.registers.b) ++b;  // all alike in a whole slot
        retained.save("", memory);
      }
    }
    usleep(500 + random() % 4000);
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    const auto found = RetainedMemory(path).load();
    const auto& kept = found.kept;
    if (!kept) continue;
    for (const auto b : kept->memory.registers.b) ASSERT_EQ(b, kept->memory.registers.b[0]);
    EXPECT_GE(kept->memory.registers.b[0], newest);
    newest = kept->memory.registers.b[0];
  }
  EXPECT_GT(newest, 0);
}

// Processes that are killed as soon as they have begun to write: the next one writes over the file that is
// not whole.
TEST(RetainedMemory, AfterKillsDuringTheFirstWritesNothingIsLost) {
  const auto path = temporary("started");
  std::mt19937 random(11);
  Memory memory;
  memory.registers.b[3] = 33;
  RetainedMemory(path).save("", memory);
  for (int round = 0; round < 150; ++round) {
    const pid_t writer = fork();
    if (writer == 0) {
      RetainedMemory retained(path);
      for (;;) retained.save("", memory);
    }
    usleep(200 + random() % 1500);
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    const auto found = RetainedMemory(path).load();
    ASSERT_EQ(found.state, storage::KeptState::good) << "round " << round << " " << found.problem;
    ASSERT_EQ(found.kept->memory.registers.b[3], 33);
  }
}

}  // namespace
}  // namespace trunnion::plc
