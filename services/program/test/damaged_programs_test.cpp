// SPDX-License-Identifier: Apache-2.0
// Programs that were damaged or are missing, and files in memory that fail in every way a disk does.
#include <gtest/gtest.h>

#include "bus/codec.hpp"
#include "machine/alarm_constants.hpp"
#include "memory_files.hpp"

namespace trunnion::program {
namespace {

/// Nothing more can be written.
class DiskFullFiles : public MemoryFiles {
 public:
  void append(const std::string& name, std::uint64_t offset, std::span<const std::uint8_t> bytes) override {
    if (full) throw StorageError("disk: no space");
    MemoryFiles::append(name, offset, bytes);
  }
  bool full = false;
};

/// A finished file cannot be put in place.
class RenameFailsFiles : public MemoryFiles {
 public:
  void publish(const std::string&, const std::string&) override { throw StorageError("disk: read-only"); }
};

// A store with the programs a and b, closed again.
void fill(MemoryFiles& files, MemoryFiles& state) {
  ProgramStore store(files, state);
  upload(store, "a", "1"), upload(store, "b", "2");
}

TEST(ProgramStore, AProgramThatDoesNotMatchItsChecksumIsRefusedUntilItIsUploadedAgain) {
  MemoryFiles files, state;
  fill(files, state);
  files.texts["a"] = "3";
  files.texts[".upload-9"] = "left behind";
  for (int start = 0; start < 2; ++start) {
    ProgramStore store(files, state);
    EXPECT_EQ(store.list().programs[0].revision, 1u) << "not adopted";
    EXPECT_EQ(files.texts.count(".upload-9"), 0u);
    auto read = request(Operation::READ, "a");
    read.length = 10;
    const auto reply = store.apply(read, 0);
    EXPECT_FALSE(reply.accepted);
    // CRC-32 of "3" and "1".
    EXPECT_EQ(
        reply.reason,
        "Program 'a' was changed outside the control or is damaged (1 bytes with checksum 6dd28e9b, not "
        "83dcefb7): upload it again, or 'trunnion state accept programs/a'");
    read.name = "b";
    EXPECT_TRUE(store.apply(read, 0).accepted) << "the others are not concerned";
  }
  ProgramStore store(files, state);
  ASSERT_EQ(store.damaged().size(), 1u);
  EXPECT_TRUE(upload(store, "a", "1").accepted);
  EXPECT_TRUE(store.damaged().empty());
  EXPECT_EQ(files.texts["a"], "1");
  EXPECT_TRUE(ProgramStore(files, state).damaged().empty());
}

TEST(ProgramStore, AChangedProgramThatTheOperatorAcceptsGetsANewRevision) {
  MemoryFiles files, state;
  fill(files, state);
  files.texts["a"] = "3";
  files.texts[".accepted-a"] = "";
  ProgramStore store(files, state);
  EXPECT_TRUE(store.damaged().empty());
  EXPECT_EQ(store.list().programs[0].revision, 2u);
  EXPECT_EQ(store.list().programs[1].revision, 1u);
  EXPECT_EQ(files.texts.count(".accepted-a"), 0u) << "once";
}

TEST(ProgramStore, AMissingProgramIsReportedOnceAndARenamedOneIsNot) {
  MemoryFiles files, state;
  fill(files, state);
  files.texts.erase("a");
  files.texts["c"] = files.texts["b"];
  files.texts.erase("b");
  {
    const ProgramStore store(files, state);
    ASSERT_EQ(store.damaged().size(), 1u);
    EXPECT_EQ(store.damaged().at("a"),
              "Program 'a' is missing: upload it again, or 'trunnion restore' a backup");
  }
  EXPECT_TRUE(ProgramStore(files, state).damaged().empty());
}

/// The process ends before the n-th change of a file.
struct Killed {};
class KilledFiles : public MemoryFiles {
 public:
  explicit KilledFiles(int& left) : left_(left) {}
  void publish(const std::string& from, const std::string& to) override {
    step();
    MemoryFiles::publish(from, to);
  }
  void remove(const std::string& name) override {
    step();
    MemoryFiles::remove(name);
  }

 private:
  void step() {
    if (left_-- == 0) throw Killed();
  }
  int& left_;
};

TEST(ProgramStore, AKillBetweenTwoStepsOfAnyChangeDamagesNothing) {
  for (const auto operation : {Operation::COMMIT_UPLOAD, Operation::REMOVE, Operation::RENAME})
    for (int steps = 0; steps < 4; ++steps) {
      int left = 1000;
      KilledFiles files(left), state(left);
      fill(files, state);
      {
        ProgramStore store(files, state);
        left = steps;
        auto change = request(operation, "a");
        change.new_name = "c";
        try {
          if (operation == Operation::COMMIT_UPLOAD)
            upload(store, "a", "new");
          else
            store.apply(change, 0);
        } catch (const Killed&) {
        }
      }
      left = 1000;
      const ProgramStore store(files, state);
      EXPECT_TRUE(store.damaged().empty())
          << bus::to_string(operation) << " after " << steps << " steps: " << store.damaged().begin()->second;
      EXPECT_EQ(files.texts["b"], "2");
    }
}

TEST(ProgramStore, ADamagedProgramIsReplacedByTheDeliveredOneItWas) {
  MemoryFiles files, state, delivered;
  delivered.texts = {{"a", "1"}, {"b", "2"}};
  {
    ProgramStore store(files, state);
    store.install(delivered);
    upload(store, "b", "mine");
  }
  files.texts["a"] = "x", files.texts["b"] = "y";
  ProgramStore store(files, state);
  store.install(delivered);
  EXPECT_EQ(files.texts["a"], "1");
  EXPECT_EQ(files.texts["b"], "y") << "it was the user's";
  EXPECT_EQ(store.damaged().size(), 1u);
}

TEST(ProgramStore, AFullDiskRefusesTheChunkAndTheUploadGoesOnLater) {
  DiskFullFiles files;
  MemoryFiles state;
  ProgramStore store(files, state);
  store.apply(request(Operation::BEGIN_UPLOAD, "a"), 0);
  auto write = request(Operation::WRITE, "a");
  write.data = {'1'};
  files.full = true;
  EXPECT_EQ(store.apply(write, 0).alarm, alarm::storage_failed.number);
  files.full = false;
  EXPECT_TRUE(store.apply(write, 0).accepted);
}

TEST(ProgramStore, AnUploadThatCannotBePutInPlaceChangesNothing) {
  RenameFailsFiles files;
  MemoryFiles state;
  ProgramStore store(files, state);
  EXPECT_EQ(upload(store, "a", "1").alarm, alarm::storage_failed.number);
  EXPECT_TRUE(store.list().programs.empty());
}

}  // namespace
}  // namespace trunnion::program
