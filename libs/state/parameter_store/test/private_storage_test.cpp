// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/private_storage.hpp"
#include "testing_support/damage.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "parameter_store/file_storage.hpp"
#include "parameter_store/parameter_store.hpp"

namespace trunnion::parameters {
namespace {

class PrivateStorageTest : public testing::Test {
 protected:
  PrivateStorageTest() : directory_(testing::TempDir() + "private_" + std::to_string(getpid())) {
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  ~PrivateStorageTest() override { std::filesystem::remove_all(directory_); }
  std::map<std::string, std::string> on_the_disk() {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(directory_))
      files[entry.path().filename()] = testing_support::read_bytes(entry.path());
    return files;
  }
  const std::string directory_;
};

TEST_F(PrivateStorageTest, WhatIsWrittenIsReadBackAndTheDiskDoesNotKnowOfIt) {
  FileStorage disk(directory_);
  disk.replace({{"a", "old"}, {"b", "kept"}});
  const auto before = on_the_disk();
  PrivateStorage storage(disk);
  storage.replace({{"a", "new"}});
  EXPECT_EQ(storage.append("b", " and more"), 4u);
  EXPECT_EQ(storage.append("c", "begun"), 0u);
  EXPECT_EQ(storage.read("a"), "new");
  EXPECT_EQ(storage.read("b"), "kept and more");
  EXPECT_EQ(storage.read("c"), "begun");
  storage.truncate("b", 4);
  EXPECT_EQ(storage.read("b"), "kept");
  EXPECT_EQ(storage.read("d"), std::nullopt);
  EXPECT_EQ(on_the_disk(), before);
}

// A journal that is cut off, and a start of the cluster that activates what waited: both make a store write.
TEST_F(PrivateStorageTest, AStoreOverItPublishesWhatTheStoreOfTheFilesPublishes) {
  FileStorage disk(directory_);
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.operation = idl::parameters::Operation::SET;
  request.values = {{10, 0.004, ""}};
  {
    ParameterStore store(disk, {}, "first");
    ASSERT_TRUE(store.apply(request, "2024-01-01T00:00:00Z").accepted);
  }
  disk.append(journal_file, "{\"torn");
  const auto before = on_the_disk();
  {
    PrivateStorage files(disk);
    const ParameterStore standby(files, {}, "first");
    EXPECT_TRUE(standby.set().values.empty());
    ASSERT_EQ(standby.set().pending.size(), 1u) << "it waits for a reset";
    EXPECT_EQ(standby.set().pending[0].number, 10u);
  }
  PrivateStorage files(disk);
  const ParameterStore standby(files, {}, "second");
  EXPECT_EQ(on_the_disk(), before);
  ASSERT_EQ(standby.set().values.size(), 1u);
  EXPECT_EQ(standby.set().values[0].value, 0.004);
  const ParameterStore store(disk, {}, "second");
  EXPECT_EQ(standby.set(), store.set());
  EXPECT_EQ(standby.tool_table(), store.tool_table());
  EXPECT_EQ(standby.work_offsets(), store.work_offsets());
}

}  // namespace
}  // namespace trunnion::parameters
