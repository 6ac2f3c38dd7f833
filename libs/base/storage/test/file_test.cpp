// SPDX-License-Identifier: Apache-2.0
// Files on a real disk: refused and torn writes, names that last, memory that outlives its process.
#include "storage/file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string_view>

#include "storage/mapped_file.hpp"

namespace trunnion::storage {
namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

class StorageTest : public testing::Test {
 protected:
  StorageTest() : directory_(testing::TempDir() + "storage_" + std::to_string(getpid())) {
    std::filesystem::remove_all(directory_);
    std::filesystem::create_directories(directory_);
  }
  ~StorageTest() override { std::filesystem::remove_all(directory_); }
  std::string path(const char* name) const { return directory_ + "/" + name; }
  std::string text(const char* name) const {
    const File file(path(name), O_RDONLY);
    std::string result(file.size() + 5, '\0');
    result.resize(file.read(0, {reinterpret_cast<std::uint8_t*>(result.data()), result.size()}));
    return result;
  }
  std::string directory_;
};

TEST_F(StorageTest, ReadsWhatWasAppendedUpToTheEnd) {
  File file(path("a"), O_RDWR | O_CREAT);
  file.append(0, bytes_of("one\n"));
  file.append(4, bytes_of("two\n"));
  file.sync();
  EXPECT_EQ(file.size(), 8u);
  EXPECT_EQ(text("a"), "one\ntwo\n");
  std::uint8_t three[3];
  EXPECT_EQ(file.read(6, three), 2u) << "bytes 6 and 7 are the last";
  EXPECT_EQ(file.read(8, three), 0u);
  file.truncate(4);
  EXPECT_EQ(text("a"), "one\n");
}

TEST_F(StorageTest, ARenamedFileReplacesTheOldOne) {
  File(path("a"), O_WRONLY | O_CREAT).append(0, bytes_of("old"));
  File(path("a.new"), O_WRONLY | O_CREAT).append(0, bytes_of("new one"));
  rename_over(path("a.new"), path("a"));
  sync_directory(directory_);
  EXPECT_EQ(text("a"), "new one");
  EXPECT_FALSE(std::filesystem::exists(path("a.new")));
}

TEST_F(StorageTest, RefusalsNameTheFile) {
  const auto refusal = [](auto action) -> std::string {
    try {
      action();
    } catch (const StorageError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal([&] { File(path("none"), O_RDONLY); }),
            path("none") + ": cannot be opened: No such file or directory");
  EXPECT_EQ(refusal([&] { rename_over(path("none"), path("a")); }),
            path("a") + ": cannot be replaced: No such file or directory");
  EXPECT_EQ(refusal([&] { sync_directory(path("none")); }),
            path("none") + ": cannot be opened: No such file or directory");
  EXPECT_EQ(refusal([&] { MappedFile(path("none/a"), 8); }),
            path("none/a") + ": cannot be mapped: No such file or directory");
}

TEST_F(StorageTest, AFileThatMayNotGrowIsNotHalfAppended) {
  File file(path("j"), O_WRONLY | O_CREAT);
  file.append(0, bytes_of("one\n"));
  const pid_t child = fork();  // the limit must not touch the test program's own output
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{6, 6};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      file.append(4, bytes_of("second\n"));
    } catch (const StorageError&) {
      _exit(0);
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text("j"), "one\n");
}

TEST_F(StorageTest, MappedMemoryIsZeroFirstAndOutlivesItsKilledWriter) {
  const pid_t child = fork();
  if (child == 0) {
    MappedFile memory(path("m"), 16);
    auto* numbers = static_cast<std::uint64_t*>(memory.data());
    if (numbers[0] != 0 || numbers[1] != 0) _exit(1);
    numbers[1] = 42;
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const MappedFile memory(path("m"), 16);
  EXPECT_EQ(static_cast<const std::uint64_t*>(memory.data())[1], 42u);
}

}  // namespace
}  // namespace trunnion::storage
