// SPDX-License-Identifier: Apache-2.0
#include "private_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "directory_files.hpp"
#include "program_store.hpp"

namespace trunnion::program {
namespace {

class PrivateFilesTest : public testing::Test {
 protected:
  PrivateFilesTest() : directory_(testing::TempDir() + "private_files_" + std::to_string(getpid())) {
    std::filesystem::remove_all(directory_);
    for (const char* part : {"/programs", "/state", "/delivered"})
      std::filesystem::create_directories(directory_ + part);
  }
  ~PrivateFilesTest() override { std::filesystem::remove_all(directory_); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(directory_ + "/" + name, std::ios::binary) << text;
  }
  std::map<std::string, std::string> on_the_disk() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(directory_)) {
      if (!entry.is_regular_file()) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      files[entry.path()] = {std::istreambuf_iterator<char>(in), {}};
    }
    return files;
  }
  static std::string text_of(Files& files, const std::string& name) {
    std::uint8_t buffer[64];
    const auto n = files.read(name, 0, buffer);
    return {buffer, buffer + n};
  }
  static std::span<const std::uint8_t> bytes(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
  }
  const std::string directory_;
};

TEST_F(PrivateFilesTest, EveryChangeIsSeenInItAndNoneOnTheDisk) {
  write("programs/a", "A"), write("programs/b", "B"), write("programs/c", "C");
  const auto before = on_the_disk();
  DirectoryFiles disk(directory_ + "/programs");
  PrivateFiles files(disk);
  EXPECT_EQ(files.list(), (std::vector<std::string>{"a", "b", "c"}));
  files.remove("a");
  files.create("new");
  files.append("new", 0, bytes("first"));
  files.append("new", 5, bytes(" second"));
  files.append("b", 1, bytes("!"));
  files.publish("new", "c");
  files.publish("b", "d");
  EXPECT_EQ(files.list(), (std::vector<std::string>{"c", "d"}));
  EXPECT_EQ(text_of(files, "c"), "first second");
  EXPECT_EQ(text_of(files, "d"), "B!");
  EXPECT_THROW(text_of(files, "a"), StorageError);
  std::uint8_t buffer[6];
  EXPECT_EQ(files.read("c", 6, buffer), 6u);
  EXPECT_EQ(std::string(buffer, buffer + 6), "second");
  EXPECT_EQ(files.read("c", 100, buffer), 0u);
  EXPECT_EQ(on_the_disk(), before);
}

// An upload that was left behind, a program that is not in the index and one that is delivered: all of them
// make a store write.
TEST_F(PrivateFilesTest, AStoreOverThemHasTheListOfAStoreOverTheDisk) {
  write("programs/one.nc", "G0 X1\n"), write("programs/.upload-7", "G0"), write("delivered/two.nc", "M30\n");
  const auto before = on_the_disk();
  DirectoryFiles programs(directory_ + "/programs"), state(directory_ + "/state"),
      delivered(directory_ + "/delivered");
  PrivateFiles private_programs(programs), private_state(state);
  ProgramStore standby(private_programs, private_state);
  standby.install(delivered);
  EXPECT_EQ(on_the_disk(), before);
  ProgramStore store(programs, state);
  store.install(delivered);
  EXPECT_EQ(standby.list(), store.list());
  ASSERT_EQ(standby.list().programs.size(), 2u);
  EXPECT_EQ(standby.list().programs[1].name, "two.nc");
}

}  // namespace
}  // namespace trunnion::program
