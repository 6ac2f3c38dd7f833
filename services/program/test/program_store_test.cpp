// SPDX-License-Identifier: Apache-2.0
// The program store on files in memory.
#include "program_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <span>
#include <string>

#include "machine/alarm_constants.hpp"
#include "memory_files.hpp"
#include "storage/crc32.hpp"

namespace trunnion::program {
namespace {

using testing::HasSubstr;

TEST(TextScan, CountsLinesWithAndWithoutALastEnd) {
  const auto lines = [](const std::string& text) {
    TextScan scan;
    for (const char c : text) scan.add(std::span(reinterpret_cast<const std::uint8_t*>(&c), 1));
    return scan.lines();
  };
  EXPECT_EQ(lines(""), 0u);
  EXPECT_EQ(lines("a"), 1u);
  EXPECT_EQ(lines("a\n"), 1u);
  EXPECT_EQ(lines("a\n\nb"), 3u);
  EXPECT_EQ(lines("a\r\n\r\nb\r\n"), 3u);
  EXPECT_EQ(lines("%\rO100\r\rM30\r"), 4u);
  EXPECT_EQ(lines("a\rb"), 2u);
}

TEST(TextScan, FindsTheNumberInTheFirstLineBehindTheTapesBeginning) {
  for (const std::string_view text : {"%\nO100\n", "%\r\nO100\r\n", "%\rO100\r", "\r\r%\r\rO100 G0\r"}) {
    TextScan scan;
    scan.add(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    EXPECT_EQ(scan.number(), (machine::ProgramNumber{100, 0})) << text;
  }
}

std::optional<machine::ProgramNumber> number_in(const std::string& text) {
  TextScan whole, pieces;
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  whole.add(bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i) pieces.add(bytes.subspan(i, 1));
  EXPECT_EQ(whole.number(), pieces.number()) << text;
  return whole.number();
}

TEST(TextScan, FindsTheNumberOfHeadsOfAnyForm) {
  const std::string nul(5, '\0');
  for (const std::string& text :
       {std::string(":100 (PLATE)\n"), std::string("%O100(PLATE)\n"), std::string("% : 100"),
        std::string("o 0100"), std::string("%100"), std::string("% TITLE\r\nO100\r\n"),
        std::string("(a)\n* b\n; c\n\n (d) O100"), std::string("\xef\xbb\xbf%\nO100"), nul + "%\nO100\n",
        nul + "O100\n", std::string("$PLATE.MIN%\nO100\n"), std::string("TEXT 1\r%\rO100\r"),
        std::string("TEXT\n%100\n"), "(" + std::string(5000, 'x') + ")\nO100\nX1\n"})
    EXPECT_EQ(number_in(text), (machine::ProgramNumber{100, 0})) << text;
  EXPECT_EQ(number_in("%100.9(NUM)\n"), (machine::ProgramNumber{100, 9}));
}

TEST(TextScan, ATextWithoutAHeadInFrontOfItsBlocksHasNoNumber) {
  for (const char* text : {"", "%", "G0 X1\nO100\n", "#1=2\nO100\n", "<NAME>\nO100\n", "O<NAME>\nO100\n",
                           "TEXT\nO100\n", "O\nG0 X1\nO100\n", "N5 O100\n", "O1234567890\n"})
    EXPECT_EQ(number_in(text), std::nullopt) << text;
  EXPECT_EQ(number_in(std::string(20000, '\n') + "O100\n"), std::nullopt)
      << "a head is in the first 16384 bytes";
}

TEST(ProgramStore, AnUploadBecomesAProgramWithRevisionSizeChecksumAndLines) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  const std::string text = "G0 X0\nG1 X10 F100\nM30\n";
  const auto reply = upload(store, "part.nc", text);
  ASSERT_TRUE(reply.accepted) << reply.reason;
  EXPECT_EQ(reply.entry, (idl::program::ProgramEntry{"part.nc", 1, text.size(), storage::crc32(text), 3, 1}));
  EXPECT_EQ(files.texts, (std::map<std::string, std::string>{{"part.nc", text}}));
  EXPECT_EQ(store.list().programs.size(), 1u);
  EXPECT_EQ(upload(store, "part.nc", text).entry.revision, 1u) << "the same text is no change";
  EXPECT_EQ(upload(store, "part.nc", "M30\n").entry.revision, 2u);
  EXPECT_EQ(ProgramStore(files, state).list(), store.list()) << "revisions survive a restart";
}

TEST(ProgramStore, ProgramsHaveNoMoreThanTheirBytesInAll) {
  MemoryFiles files, state;
  ProgramStore store(files, state, 3000);
  ASSERT_TRUE(store.apply(request(Operation::BEGIN_UPLOAD, "big"), 0).accepted);
  auto write = request(Operation::WRITE, "big");
  for (write.data.resize(1000); write.offset < 3000; write.offset += write.data.size())
    ASSERT_TRUE(store.apply(write, 0).accepted);
  write.data.resize(1);
  const auto refused = store.apply(write, 0);
  EXPECT_EQ(refused.alarm, alarm::storage_failed.number);
  EXPECT_THAT(refused.reason, HasSubstr("programs have at most 0 MB in all"));
  EXPECT_FALSE(upload(store, "small", "M30\n").accepted) << "uploads count";
  ASSERT_TRUE(store.apply(request(Operation::ABORT_UPLOAD, "big"), 0).accepted);
  const std::string half(1000, 'N');
  ASSERT_TRUE(upload(store, "a", half).accepted);
  ASSERT_TRUE(upload(store, "b", half).accepted);
  EXPECT_TRUE(upload(store, "a", half + half).accepted) << "in the place of another text";
  EXPECT_FALSE(upload(store, "c", "M30\n").accepted);
  ASSERT_TRUE(store.apply(request(Operation::REMOVE, "b"), 0).accepted);
  EXPECT_TRUE(upload(store, "c", "M30\n").accepted);
}

// What a program may change: 1 is a setter, 2 a builder.
TEST(ProgramStore, AProgramHasTheRoleOfWhoStoredItLast) {
  MemoryFiles files, state, delivered;
  delivered.texts = {{"cycle.nc", "M99\n"}};
  const auto role = [](const ProgramStore& store, const std::string& name) {
    for (const auto& entry : store.list().programs)
      if (entry.name == name) return static_cast<int>(entry.role);
    return -1;
  };
  {
    ProgramStore store(files, state);
    store.install(delivered);
    EXPECT_EQ(role(store, "cycle.nc"), 2) << "delivered with the machine";
    upload(store, "a", "M30\n", 2);
    upload(store, "b", "M2\n", 1);
    EXPECT_EQ(role(store, "a"), 2);
    EXPECT_EQ(role(store, "b"), 1);
    upload(store, "a", "M30\n", 1);
    EXPECT_EQ(role(store, "a"), 2) << "the same text, which a builder has released";
    upload(store, "a", "G0 X0\nM30\n", 1);
    EXPECT_EQ(role(store, "a"), 1) << "another text";
    const auto revision = store.list().revision;
    upload(store, "a", "G0 X0\nM30\n", 2);
    EXPECT_EQ(role(store, "a"), 2) << "released without a change";
    EXPECT_NE(store.list().revision, revision) << "and channels hear of it";
    upload(store, "cycle.nc", "M99 P1\n", 1);
    EXPECT_EQ(role(store, "cycle.nc"), 1);
    auto rename = request(Operation::RENAME, "b");
    rename.new_name = "c";
    EXPECT_TRUE(store.apply(rename, 0).accepted);
  }
  files.texts["d"] = "M30\n";
  const ProgramStore store(files, state);
  EXPECT_EQ(role(store, "a"), 2) << "kept through a restart";
  EXPECT_EQ(role(store, "c"), 1) << "a new name changes no right";
  EXPECT_EQ(role(store, "d"), 1) << "found there: nobody knows who has stored it";
}

TEST(ProgramStore, ReadsChunksOfTheExpectedRevisionOnly) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  upload(store, "a", "0123456789");
  auto read = request(Operation::READ, "a");
  read.offset = 4, read.length = 3, read.revision = 1;
  auto reply = store.apply(read, 0);
  EXPECT_EQ(std::string(reply.data.begin(), reply.data.end()), "456");
  read.offset = 8, read.length = 60000;
  reply = store.apply(read, 0);
  EXPECT_EQ(std::string(reply.data.begin(), reply.data.end()), "89");
  read.offset = 10;
  EXPECT_TRUE(store.apply(read, 0).accepted);
  read.offset = 11;
  EXPECT_FALSE(store.apply(read, 0).accepted);
  read.offset = 0, read.length = 60001;
  EXPECT_FALSE(store.apply(read, 0).accepted);
  upload(store, "a", "other");
  read.length = 5;
  reply = store.apply(read, 0);
  EXPECT_FALSE(reply.accepted);
  EXPECT_EQ(reply.reason, "program 'a' has changed: revision 2, expected 1");
  read.revision = 0;
  EXPECT_TRUE(store.apply(read, 0).accepted);
  EXPECT_EQ(store.apply(request(Operation::READ, "b"), 0).alarm, alarm::program_missing.number);
}

TEST(ProgramStore, AnUploadWithAGapAWrongSizeOrAWrongChecksumIsRefused) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  EXPECT_FALSE(store.apply(request(Operation::WRITE, "a"), 0).accepted);
  store.apply(request(Operation::BEGIN_UPLOAD, "a"), 0);
  auto write = request(Operation::WRITE, "a");
  write.data = {'a', 'b'};
  EXPECT_TRUE(store.apply(write, 0).accepted);
  EXPECT_FALSE(store.apply(write, 0).accepted) << "offset 0 is not the end";
  write.offset = 3;
  EXPECT_THAT(store.apply(write, 0).reason, HasSubstr("offset 3 is not the end of the upload at 2"));
  auto commit = request(Operation::COMMIT_UPLOAD, "a");
  commit.size = 3, commit.crc32 = storage::crc32("ab");
  EXPECT_FALSE(store.apply(commit, 0).accepted);
  commit.size = 2, commit.crc32 ^= 1;
  EXPECT_FALSE(store.apply(commit, 0).accepted);
  EXPECT_TRUE(store.list().programs.empty());
  commit.crc32 ^= 1;
  EXPECT_TRUE(store.apply(commit, 0).accepted);
}

TEST(ProgramStore, UploadsOfTwoClientsDoNotMeetAndStaleOnesAreDropped) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  store.apply(request(Operation::BEGIN_UPLOAD, "a", 1), 0);
  store.apply(request(Operation::BEGIN_UPLOAD, "a", 2), 30);
  EXPECT_EQ(store.uploads(), 2u);
  store.drop_stale_uploads(61);
  EXPECT_EQ(store.uploads(), 1u);
  EXPECT_EQ(files.texts.size(), 1u);
  EXPECT_TRUE(store.apply(request(Operation::ABORT_UPLOAD, "a", 2), 61).accepted);
  EXPECT_TRUE(files.texts.empty());
}

TEST(ProgramStore, NamesLeadNowhereElse) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  for (const auto& name : {std::string("../a"), std::string("a/b"), std::string(".hidden"), std::string(""),
                           std::string(65, 'a'), std::string("a b"), std::string("a\0b", 3)})
    EXPECT_FALSE(store.apply(request(Operation::BEGIN_UPLOAD, name), 0).accepted) << name;
  EXPECT_TRUE(valid_name(std::string(64, 'a')));
}

TEST(ProgramStore, AProgramThatComesBackHasANewRevision) {
  MemoryFiles files, state;
  {
    ProgramStore store(files, state);
    upload(store, "a", "1");
    EXPECT_TRUE(store.apply(request(Operation::REMOVE, "a"), 0).accepted);
    EXPECT_FALSE(store.apply(request(Operation::REMOVE, "a"), 0).accepted);
  }
  ProgramStore store(files, state);
  EXPECT_EQ(upload(store, "a", "1").entry.revision, 2u);
}

TEST(ProgramStore, RenamesUnlessTheNewNameIsTaken) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  upload(store, "a", "1"), upload(store, "b", "2");
  auto rename = request(Operation::RENAME, "a");
  rename.new_name = "b";
  EXPECT_FALSE(store.apply(rename, 0).accepted);
  rename.new_name = "../c";
  EXPECT_FALSE(store.apply(rename, 0).accepted);
  rename.new_name = "c";
  EXPECT_TRUE(store.apply(rename, 0).accepted);
  EXPECT_EQ(files.texts, (std::map<std::string, std::string>{{"b", "2"}, {"c", "1"}}));
}

TEST(ProgramStore, DeliveredProgramsAreCopiedOnceAndStayRemoved) {
  MemoryFiles files, state, delivered;
  delivered.texts = {{"a.nc", "1"}, {"b.nc", "2"}, {"bad name", "3"}};
  {
    ProgramStore store(files, state);
    EXPECT_EQ(store.install(delivered), std::vector<std::string>{"bad name"});
    upload(store, "a.nc", "mine");
    store.apply(request(Operation::REMOVE, "b.nc"), 0);
  }
  ProgramStore store(files, state);
  store.install(delivered);
  EXPECT_EQ(files.texts, (std::map<std::string, std::string>{{"a.nc", "mine"}}));
}

TEST(ProgramStore, ResolvesNameThenExtensionThenNumberThenTextThenCycles) {
  MemoryFiles files, state, cycles;
  files.texts = {{"O0100.txt", "x"},
                 {"O1234.nc", "x"},
                 {"part", "%\n\n  %77 comment\nG0"},
                 {"part.nc", "%\nO88\n"},
                 {"wheel.nc", "x"}};
  cycles.texts = {{"O8100.nc", "x"}, {"wheel.nc", "cycle"}};
  ProgramStore store(files, state);
  store.set_cycles(cycles);
  const auto name = [&](const char* call) {
    return store.apply(request(Operation::RESOLVE, call), 0).entry.name;
  };
  EXPECT_EQ(name("part"), "part");
  EXPECT_EQ(name("wheel"), "wheel.nc");
  EXPECT_EQ(name("O1234"), "O1234.nc");
  EXPECT_EQ(name("1234"), "O1234.nc");
  EXPECT_EQ(name("%1234"), "O1234.nc");
  EXPECT_EQ(name("O100"), "O0100.txt");
  EXPECT_EQ(name("O77"), "part");
  EXPECT_EQ(name("88"), "part.nc");
  EXPECT_EQ(name("O8100"), "O8100.nc");
  EXPECT_EQ(store.list().programs.size(), 5u) << "cycles are not listed";
  auto read = request(Operation::READ, "O8100.nc");
  read.length = 10;
  EXPECT_EQ(store.apply(read, 0).data.size(), 1u);
  EXPECT_FALSE(store.apply(request(Operation::RESOLVE, "O9"), 0).accepted);
  EXPECT_FALSE(store.apply(request(Operation::RESOLVE, "../etc"), 0).accepted);
}

// %9990.9 of the NUM dialect, which homes one axis, is another program than %9990.
TEST(ProgramStore, ResolvesANumberWithAnIndexToThatProgramAlone) {
  MemoryFiles files, state, cycles;
  files.texts = {{"O9990.9", "x"}, {"O99901", "x"}, {"O12.nc", "x"}, {"first", "%7.1 (group 1)\nG0"}};
  ProgramStore store(files, state);
  store.set_cycles(cycles);
  const auto name = [&](const char* call) {
    return store.apply(request(Operation::RESOLVE, call), 0).entry.name;
  };
  EXPECT_EQ(name("O9990.9"), "O9990.9");
  EXPECT_EQ(name("%9990.9"), "O9990.9");
  EXPECT_EQ(name("O9990"), "") << "it is not stored";
  EXPECT_EQ(name("O12"), "O12.nc");
  EXPECT_EQ(name("O0012.3"), "") << "it is not stored";
  EXPECT_EQ(name("O7.1"), "first");
  EXPECT_EQ(name("O7"), "");
  upload(store, "9990.nc", "M30\n");
  EXPECT_EQ(name("O9990"), "9990.nc");
}

TEST(ProgramStore, WhatAChannelExecutesIsNeitherReplacedNorRemovedNorRenamedUntilItHasEnded) {
  MemoryFiles files, state;
  ProgramStore store(files, state);
  upload(store, "a", "M30\n");
  upload(store, "b", "M30\n");
  store.set_executed(0, "a");
  store.set_executed(1, "a");
  auto rename = request(Operation::RENAME, "a");
  rename.new_name = "c";
  for (const auto& refused : {request(Operation::REMOVE, "a"), rename}) {
    const auto reply = store.apply(refused, 0);
    EXPECT_FALSE(reply.accepted);
    EXPECT_EQ(reply.reason, "a is being executed by channel 0: reset the channel first");
  }
  EXPECT_EQ(upload(store, "a", "G4 P1\n").reason,
            "a is being executed by channel 0: reset the channel first");
  EXPECT_EQ(store.uploads(), 0u);
  EXPECT_TRUE(upload(store, "a", "M30\n").accepted) << "the same text is no change";
  EXPECT_TRUE(store.apply(request(Operation::REMOVE, "b"), 0).accepted);
  store.set_executed(0, "");
  EXPECT_FALSE(store.apply(rename, 0).accepted) << "channel 1 still executes it";
  store.set_executed(1, "c");
  EXPECT_TRUE(store.apply(rename, 0).accepted);
  EXPECT_FALSE(store.apply(request(Operation::REMOVE, "c"), 0).accepted);
  EXPECT_EQ(store.list().programs.size(), 1u);
}

}  // namespace
}  // namespace trunnion::program
