// SPDX-License-Identifier: Apache-2.0
#include "snapshot/kept_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "bus/json.hpp"

namespace trunnion::snapshot {
namespace {

namespace fs = std::filesystem;

class KeptFiles : public testing::Test {
 protected:
  ~KeptFiles() override { fs::remove_all(directory_); }
  std::string directory(const char* name) {
    const auto path = directory_ / name;
    fs::create_directories(path);
    return path;
  }
  fs::path directory_ = fs::temp_directory_path() / ("trunnion-kept-" + std::to_string(getpid()));
};

TEST_F(KeptFiles, EveryByteIsPutBackAndWhatDoesNotExistIsLeftOut) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const auto from = directory("from"), to = directory("to");
  std::ofstream(from + "/part.nc", std::ios::binary) << bytes;
  std::ofstream(from + "/empty");
  std::ofstream(from + "/other") << "not named";
  put_files(to, bus::Json::parse(bus::text_of(kept_files(from, {"part.nc", "empty", "missing"}))));
  std::ostringstream read;
  read << std::ifstream(to + "/part.nc", std::ios::binary).rdbuf();
  EXPECT_EQ(read.str(), bytes);
  EXPECT_TRUE(fs::exists(to + "/empty"));
  EXPECT_EQ(std::distance(fs::directory_iterator(to), fs::directory_iterator{}), 2);
}

TEST_F(KeptFiles, NoNameLeadsOutOfTheDirectory) {
  const auto to = directory("to");
  for (const auto* name : {"../stray", "/tmp/stray", "a/b"})
    EXPECT_THROW(put_files(to, {{{"name", name}, {"bytes", "00"}}}), std::runtime_error) << name;
  EXPECT_FALSE(fs::exists(directory_ / "stray"));
  EXPECT_THROW(put_files(to, {{{"name", "a"}, {"bytes", "0x"}}}), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::snapshot
