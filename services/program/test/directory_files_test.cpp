// SPDX-License-Identifier: Apache-2.0
// Programs on a real disk: large ones in little memory, killed writers.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "directory_files.hpp"
#include "program_store.hpp"
#include "testing_support/killed_process.hpp"

namespace trunnion::program {
namespace {

class DirectoryFilesTest : public testing::Test {
 protected:
  DirectoryFilesTest() {
    directory_ = testing::TempDir() + "programs_" + std::to_string(getpid());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_ + "/programs");
  }
  ~DirectoryFilesTest() override { std::filesystem::remove_all(directory_); }
  std::string directory_;
};

long largest_resident_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

TEST_F(DirectoryFilesTest, AProgramOf100MegabytesIsReadInChunksInLittleMemory) {
  // 5 million lines of 20 bytes.
  constexpr std::uint64_t lines = 5000000, size = lines * 20;
  {
    std::ofstream out(directory_ + "/programs/big.nc", std::ios::binary);
    std::string block;
    for (int i = 0; i < 1000; ++i) block += "G1 X10.001 Y-2.0001\n";
    for (std::uint64_t i = 0; i < lines / 1000; ++i) out << block;
  }
  const auto before = largest_resident_kilobytes();
  DirectoryFiles programs(directory_ + "/programs"), state(directory_);
  ProgramStore store(programs, state);
  ASSERT_EQ(store.list().programs.size(), 1u);
  EXPECT_EQ(store.list().programs[0].size, size);
  EXPECT_EQ(store.list().programs[0].lines, lines);
  idl::program::ProgramRequest request;
  request.operation = idl::program::Operation::READ;
  request.name = "big.nc";
  request.length = longest_chunk;
  TextScan text;
  while (text.size() < size) {
    request.offset = text.size();
    const auto reply = store.apply(request, 0);
    ASSERT_TRUE(reply.accepted) << reply.reason;
    ASSERT_FALSE(reply.data.empty());
    text.add(reply.data);
  }
  EXPECT_EQ(text.crc32(), store.list().programs[0].crc32);
  // A piece of 64 KiB, a chunk and the index are far below 8 MiB; the program is above 95.
  EXPECT_LT(largest_resident_kilobytes() - before, 8 * 1024);
}

TEST_F(DirectoryFilesTest, AfterAKillAtAnyMomentAProgramIsOldOrNew) {
  const std::string texts[] = {std::string(30000, 'a'), std::string(50000, 'b')};
  std::mt19937 random(11);
  int seen[2] = {0, 0};
  for (int round = 0; round < 40; ++round) {
    testing_support::kill_while(random, 3, [&](auto done) {
      DirectoryFiles programs(directory_ + "/programs");
      for (int i = round;; ++i) {
        const auto& text = texts[i % 2];
        programs.create(".copy");
        programs.append(".copy", 0, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        programs.publish(".copy", "p");
        done();
      }
    });
    // A store that knows nothing yet, because the writer above is none.
    for (const auto* index : {"/programs.yaml", "/programs.yaml.previous"})
      std::filesystem::remove(directory_ + index);
    DirectoryFiles programs(directory_ + "/programs"), state(directory_);
    ProgramStore store(programs, state);  // removes the temporary file
    EXPECT_FALSE(std::filesystem::exists(directory_ + "/programs/.copy"));
    if (store.list().programs.empty()) continue;  // killed before the first
    const auto size = store.list().programs[0].size;
    ASSERT_TRUE(size == texts[0].size() || size == texts[1].size()) << size;
    ++seen[size == texts[1].size() ? 1 : 0];
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

}  // namespace
}  // namespace trunnion::program
