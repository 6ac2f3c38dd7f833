// SPDX-License-Identifier: Apache-2.0
// Files on a real disk: refused and killed writers.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "parameter_store/file_storage.hpp"
#include "testing_support/killed_process.hpp"

namespace trunnion::parameters {
namespace {

class FileStorageTest : public testing::Test {
 protected:
  FileStorageTest() {
    directory_ = testing::TempDir() + "parameters_" + std::to_string(getpid());
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  ~FileStorageTest() override { std::filesystem::remove_all(directory_); }
  std::string directory_;
};

TEST_F(FileStorageTest, ReplacesAppendsAndTakesBack) {
  FileStorage storage(directory_);
  EXPECT_FALSE(storage.read("a").has_value());
  storage.replace({{"a", "1"}, {"b", "2"}});
  storage.replace({{"a", "3"}});
  EXPECT_EQ(storage.read("a"), "3");
  EXPECT_EQ(storage.read("b"), "2");
  EXPECT_EQ(storage.append("j", "one\n"), 0u);
  EXPECT_EQ(storage.append("j", "two\n"), 4u);
  storage.truncate("j", 4);
  EXPECT_EQ(storage.read("j"), "one\n");
}

TEST_F(FileStorageTest, AnUnwritableDirectoryLeavesEverythingAsItWas) {
  FileStorage storage(directory_);
  storage.replace({{"a", "old"}});
  std::filesystem::create_directories(directory_ + "/b.new");  // the second temporary file cannot be made
  EXPECT_THROW(storage.replace({{"a", "new"}, {"b", "new"}}), StorageError);
  EXPECT_EQ(storage.read("a"), "old");
  EXPECT_FALSE(std::filesystem::exists(directory_ + "/a.new"));
}

TEST_F(FileStorageTest, AfterAKillAtAnyMomentAFileIsOldOrNew) {
  // Texts of different length, so that a mixture cannot look like one of them.
  const std::string texts[] = {std::string(20000, 'a'), std::string(70000, 'b')};
  FileStorage storage(directory_);
  storage.replace({{"f", texts[0]}});
  std::mt19937 random(20);
  int seen[2] = {0, 0};
  for (int round = 0; round < 60; ++round) {
    testing_support::kill_while(random, 3, [&](auto done) {
      FileStorage mine(directory_);
      for (int i = round;; ++i) {
        mine.replace({{"f", texts[i % 2]}});
        done();
      }
    });
    const auto text = storage.read("f");
    ASSERT_TRUE(text == texts[0] || text == texts[1]) << "round " << round;
    ASSERT_TRUE(storage.damaged().empty()) << storage.damaged().begin()->second.problem;
    ++seen[text == texts[1] ? 1 : 0];
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

TEST_F(FileStorageTest, DamageIsReportedAndOnlyTheOwnerRepairs) {
  FileStorage(directory_).replace({{"a", "one\n"}});
  FileStorage(directory_).replace({{"a", "two\n"}});
  std::filesystem::resize_file(directory_ + "/a", 3);
  FileStorage reader(directory_), owner(directory_, true), later(directory_);
  EXPECT_EQ(reader.read("a"), "one\n");
  EXPECT_EQ(reader.damaged().at("a").problem, "its last line is incomplete");
  EXPECT_EQ(std::filesystem::file_size(directory_ + "/a"), 3u) << "only read";
  EXPECT_EQ(owner.read("a"), "one\n");
  EXPECT_EQ(owner.damaged().size(), 1u);
  EXPECT_EQ(later.read("a"), "one\n");
  EXPECT_TRUE(later.damaged().empty());
}

TEST_F(FileStorageTest, WhatIsLostIsReportedUntilItIsWrittenAgain) {
  FileStorage(directory_).replace({{"a", "one\n"}});
  for (const auto* name : {"/a", "/a.previous"}) std::filesystem::resize_file(directory_ + name, 3);
  for (int start = 0; start < 2; ++start) {
    FileStorage owner(directory_, true);
    EXPECT_EQ(owner.read("a"), std::nullopt);
    EXPECT_EQ(owner.damaged().at("a").state, storage::KeptState::unusable);
  }
  FileStorage owner(directory_, true);
  owner.replace({{"a", "entered again\n"}});
  EXPECT_EQ(owner.read("a"), "entered again\n");
  EXPECT_TRUE(owner.damaged().empty());
}

}  // namespace
}  // namespace trunnion::parameters
