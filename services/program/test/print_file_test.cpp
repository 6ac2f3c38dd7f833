// SPDX-License-Identifier: Apache-2.0
// Files to which programs print (DPRNT): lines at their end, each once, and no program of anybody.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "machine/alarm_constants.hpp"
#include "machine/print_file.hpp"
#include "memory_files.hpp"
#include "program_store.hpp"
#include "storage/crc32.hpp"

namespace trunnion::program::print_file_test {
namespace {

using testing::HasSubstr;

const std::string name = "DPRNT-part.nc.txt";

ProgramReply print(ProgramStore& store, std::uint64_t offset, const std::string& line) {
  auto write = request(Operation::WRITE, name);
  write.offset = offset;
  write.data.assign(line.begin(), line.end());
  return store.apply(write, 0);
}

TEST(PrintedLines, AreAddedAndListedAsAProgram) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  store.take_change();
  EXPECT_EQ(print(store, 0, "X1\n").offset, 3u);
  EXPECT_TRUE(store.take_change());
  const auto reply = print(store, 3, "X2\n");
  ASSERT_TRUE(reply.accepted) << reply.reason;
  EXPECT_EQ(files.texts[name], "X1\nX2\n");
  EXPECT_EQ(reply.entry, (idl::program::ProgramEntry{name, 2, 6, storage::crc32("X1\nX2\n"), 2, 0}));
  EXPECT_EQ(store.list().programs.size(), 1u);
  EXPECT_EQ(ProgramStore(files, state).list(), store.list());
  auto read = request(Operation::READ, name);
  read.length = 100;
  EXPECT_EQ(store.apply(read, 0).data.size(), 6u);
  EXPECT_TRUE(store.apply(request(Operation::REMOVE, name), 0).accepted);
  EXPECT_EQ(print(store, 6, "X3\n").offset, 0u) << "the end is told to who does not know it";
  EXPECT_EQ(print(store, 0, "X3\n").offset, 3u);
}

TEST(PrintedLines, ALineThatIsSentAgainIsNotThereTwice) {
  MemoryFiles files, state;
  {
    ProgramStore store(files, state);
    print(store, 0, "X1\n");
    print(store, 3, "X1\n");
  }
  ProgramStore store(files, state);  // the process before has died without an answer
  const auto again = print(store, 3, "X1\n");
  EXPECT_TRUE(again.accepted);
  EXPECT_EQ(again.offset, 6u);
  EXPECT_EQ(files.texts[name], "X1\nX1\n");
  const auto other = print(store, 3, "X2\n");
  EXPECT_EQ(other.alarm, alarm::request_invalid.number);
  EXPECT_EQ(other.offset, 6u);
  EXPECT_FALSE(print(store, 4, "1\nX2\n").accepted) << "not wholly there";
  EXPECT_EQ(files.texts[name], "X1\nX1\n");
}

TEST(PrintedLines, AreNoProgramThatIsCalledByItsNumber) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  print(store, 0, "O1234\n");
  EXPECT_FALSE(store.apply(request(Operation::RESOLVE, "O1234"), 0).accepted);
  ProgramStore later(files, state);
  EXPECT_FALSE(later.apply(request(Operation::RESOLVE, "O1234"), 0).accepted);
  upload(later, "part.nc", "O1234\nM30\n");
  EXPECT_EQ(later.apply(request(Operation::RESOLVE, "O1234"), 0).entry.name, "part.nc");
}

TEST(PrintedLines, BecomeAProgramByAnotherName) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  print(store, 0, "O1234\n");
  auto rename = request(Operation::RENAME, name);
  rename.new_name = "part.nc";
  ASSERT_TRUE(store.apply(rename, 0).accepted);
  EXPECT_EQ(store.apply(request(Operation::RESOLVE, "O1234"), 0).entry.name, "part.nc");
  rename = request(Operation::RENAME, "part.nc");
  rename.new_name = name;
  ASSERT_TRUE(store.apply(rename, 0).accepted);
  EXPECT_FALSE(store.apply(request(Operation::RESOLVE, "O1234"), 0).accepted);
  EXPECT_EQ(print(store, 6, "X1\n").offset, 9u);
}

TEST(PrintedLines, WhatACrashHasLeftOfALineIsNoDamage) {
  MemoryFiles files, state;
  { print(*std::make_unique<ProgramStore>(files, state), 0, "X1\n"); }
  files.texts[name] += "X2";
  ProgramStore store(files, state);
  EXPECT_TRUE(store.damaged().empty());
  EXPECT_EQ(store.list().programs.at(0).size, 5u);
  EXPECT_EQ(store.list().programs.at(0).role, 0u) << "no program becomes a setter's by a crash";
  EXPECT_TRUE(print(store, 5, "X3\n").accepted);
  files.texts.erase(name);
  ProgramStore without(files, state);
  EXPECT_TRUE(without.damaged().empty());
  EXPECT_TRUE(without.list().programs.empty());
}

TEST(PrintedLines, AFileHasAtMostFourMegabytes) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  const std::string line(longest_chunk, 'A');
  std::uint64_t end = 0;
  while (end + line.size() <= machine::most_print_bytes) {
    ASSERT_TRUE(print(store, end, line).accepted);
    end += line.size();
  }
  const auto refused = print(store, end, line);
  EXPECT_EQ(refused.alarm, alarm::storage_failed.number);
  EXPECT_THAT(refused.reason, HasSubstr("'DPRNT-part.nc.txt' has 4 MB"));
  EXPECT_EQ(files.texts[name].size(), end);
}

struct FullDisk : MemoryFiles {
  bool full = false;
  void append(const std::string& file, std::uint64_t offset, std::span<const std::uint8_t> bytes) override {
    if (full) throw StorageError(file + ": no space left on device");
    MemoryFiles::append(file, offset, bytes);
  }
};

TEST(PrintedLines, AFullDiskRefusesTheLineAndLeavesTheOthers) {
  FullDisk files;
  MemoryFiles state;
  ProgramStore store(files, state);
  print(store, 0, "X1\n");
  files.full = true;
  const auto refused = print(store, 3, "X2\n");
  EXPECT_EQ(refused.alarm, alarm::storage_failed.number);
  EXPECT_THAT(refused.reason, HasSubstr("no space left"));
  EXPECT_EQ(files.texts[name], "X1\n");
  files.full = false;
  EXPECT_EQ(print(store, 3, "X2\n").offset, 6u);
  EXPECT_EQ(files.texts[name], "X1\nX2\n");
}

TEST(PrintedLines, AnUploadOfSuchAFileIsAnUpload) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  ASSERT_TRUE(upload(store, name, "X1\n").accepted);
  EXPECT_EQ(print(store, 3, "X2\n").offset, 6u);
  auto write = request(Operation::WRITE, "part.nc");
  write.data = {'A'};
  EXPECT_THAT(store.apply(write, 0).reason, HasSubstr("no upload of 'part.nc' exists"));
}

}  // namespace
}  // namespace trunnion::program::print_file_test
