// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <random>

#include "retained_memory.hpp"
#include "testing_support/damage.hpp"
#include "testing_support/killed_process.hpp"

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

// A file of version 0.3 and before: 64 bytes of the start, registers X Y R F G B of 512 each (5632 bytes),
// what follows them up to the forces, then the variables of Structured Text without the progress of the main
// task.
TEST(RetainedMemory, TakesRetainedRegistersAndVariablesOfAnOlderVersion) {
  const auto path = temporary("older");
  Memory memory;
  memory.scans = 4711;
  memory.program.layout = 5, memory.program.cells = 3;
  memory.program.values[2] = 33;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&memory);
  std::vector<std::uint8_t> old(64, 0);
  old[0] = 'b';
  std::vector<std::uint8_t> registers(5632, 0);
  registers[0] = 255;                          // X0
  registers[3 * 512 + 2 * 1024 + 4 * 7] = 77;  // B7
  old.insert(old.end(), registers.begin(), registers.end());
  old.insert(old.end(), 256 * 16 + 256 * 8 + 512, 7);  // timers, counters and edges of instruction lists
  old.insert(old.end(), bytes + offsetof(Memory, handshakes), bytes + offsetof(Memory, forces));
  const auto* program = reinterpret_cast<const std::uint8_t*>(&memory.program);
  old.insert(old.end(), program, program + offsetof(ProgramVariables, main));
  const auto* values = reinterpret_cast<const std::uint8_t*>(memory.program.values.data());
  old.insert(old.end(), values, values + 3 * 8);
  storage::RetainedPair(path, "plc", old.size()).open(old);

  RetainedMemory retained(path, 3);
  const auto found = retained.load();
  ASSERT_TRUE(found.kept) << found.problem;
  EXPECT_EQ(found.kept->boot, "") << "its outputs do not continue";
  EXPECT_EQ(found.kept->memory.registers.b[7], 77);
  EXPECT_EQ(found.kept->memory.registers.x[0], 0);
  EXPECT_EQ(found.kept->memory.scans, 4711u);
  EXPECT_EQ(found.kept->memory.program.layout, 5u);
  EXPECT_EQ(found.kept->memory.program.values[2], 33u);
  EXPECT_EQ(found.kept->memory.forces.count, 0u);
  retained.save("boot", found.kept->memory);
  EXPECT_EQ(RetainedMemory(path, 3).load().kept->memory.program.values[2], 33u);
}

// Behind the registers that version kept timers, counters and edges of instruction lists, which are variables
// now.
TEST(RetainedMemory, TakesTheMemoryOfAVersionWithTimersOfInstructionLists) {
  auto path = temporary("lists");
  Memory memory;
  memory.scans = 4711;
  memory.registers.y[3] = 5;
  memory.program.layout = 5, memory.program.cells = 3;
  memory.program.values[2] = 33;
  RetainedMemory(path, 3).save("boot", memory);
  auto content = storage::RetainedPair::of_files(path, "plc").load().content;
  constexpr auto before = offsetof(RetainedMemory::Content, memory);
  ASSERT_GT(content.size(), before + offsetof(Memory, handshakes));
  ASSERT_EQ(content[before - 8], RetainedMemory::Content::own_layout);
  content[before - 8] = 2;
  content.insert(content.begin() + before + offsetof(Memory, handshakes), 256 * 16 + 256 * 8 + 512, 7);
  path = temporary("lists");
  storage::RetainedPair(path, "plc", content.size()).open(content);

  RetainedMemory retained(path, 3);
  const auto found = retained.load();
  ASSERT_TRUE(found.kept) << found.problem;
  EXPECT_EQ(found.kept->boot, "boot");
  EXPECT_EQ(found.kept->memory.scans, 4711u);
  EXPECT_EQ(found.kept->memory.registers.y[3], 5);
  EXPECT_EQ(found.kept->memory.program.values[2], 33u);
  retained.save("boot", found.kept->memory);
  EXPECT_EQ(RetainedMemory(path, 3).load().kept->memory.program.values[2], 33u);
}

// Programs with more variables: whenever it is killed, one of the two memories is there.
TEST(RetainedMemory, AKillWhileTheSizeChangesLosesNothing) {
  std::mt19937 random(5);
  int resized = 0;
  for (int round = 0; round < 30; ++round) {
    const auto path = temporary("resized");
    Memory memory;
    memory.program.cells = 10;
    memory.registers.b[1] = 5;
    {
      RetainedMemory before(path, 10);
      before.save("boot", memory);
    }
    testing_support::kill_while(random, 4, [&](auto done) {
      RetainedMemory retained(path, 10);
      retained.save("boot", memory);
      for (std::uint32_t cells = 2000;; cells = cells == 10 ? 2000 : 10) {
        memory.program.cells = cells;
        retained.resize(cells, "boot", memory);
        done();
      }
    });
    const auto found = RetainedMemory(path, 10).load();
    ASSERT_TRUE(found.kept) << "round " << round << " " << found.problem;
    EXPECT_EQ(found.kept->memory.registers.b[1], 5);
    resized += found.kept->memory.program.cells == 2000 ? 1 : 0;
  }
  EXPECT_GT(resized, 0);
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
    testing_support::kill_while(random, 20, [&](auto done) {
      RetainedMemory retained(path);
      Memory memory;
      if (const auto found = retained.load(); found.kept) memory = found.kept->memory;
      for (;;) {
        for (auto& b : memory.registers.b) ++b;  // all alike in a whole slot
        retained.save("", memory);
        done();
      }
    });
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
    testing_support::kill_while(random, 2, [&](auto done) {
      RetainedMemory retained(path);
      for (;; done()) retained.save("", memory);
    });
    const auto found = RetainedMemory(path).load();
    ASSERT_EQ(found.state, storage::KeptState::good) << "round " << round << " " << found.problem;
    ASSERT_EQ(found.kept->memory.registers.b[3], 33);
  }
}

}  // namespace
}  // namespace trunnion::plc
