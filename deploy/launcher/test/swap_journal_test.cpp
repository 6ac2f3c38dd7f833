// SPDX-License-Identifier: Apache-2.0
#include "swap_journal.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cluster/cluster_files.hpp"
#include "storage/file.hpp"

namespace trunnion::launcher {
namespace {

std::vector<nlohmann::json> lines_of(const std::string& file) {
  std::ifstream in(file);
  std::vector<nlohmann::json> lines;
  for (std::string line; std::getline(in, line);)
    lines.push_back(nlohmann::json::parse(line, nullptr, false));
  return lines;
}

TEST(SwapJournal, SaysWhatWasSwappedForWhatOneLineEach) {
  const auto directory = std::filesystem::path(testing::TempDir()) / "trunnion_swap_journal";
  std::filesystem::remove_all(directory);
  std::filesystem::create_directories(directory);
  const auto executable = (directory / "service").string();
  std::ofstream(executable) << "123456789";
  idl::service::SwapRequest request;
  request.service = "kinematics", request.replica = 1;
  idl::service::SwapReply reply;
  reply.cycle = 4711, reply.compared = 500, reply.seconds = 0.5;
  const SwapSide before{executable, "cyclonedds", "0.1.0", "aaaa"};
  const SwapSide after{executable + "-that-is-gone", "fastdds", "0.2.0 \"new\"\n\xff", "aaaa"};
  append_swap(directory.string(), swap_line(request, reply, before, after));
  request.service = "plc";
  append_swap(directory.string(), swap_line(request, reply, after, before));

  const auto lines = lines_of((directory / cluster::swap_journal_file).string());
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0]["service"], "kinematics");
  EXPECT_EQ(lines[0]["replica"], 1);
  EXPECT_EQ(lines[0]["cycle"], 4711);
  EXPECT_EQ(lines[0]["compared_cycles"], 500);
  EXPECT_EQ(lines[0]["old"]["vendor"], "cyclonedds");
  EXPECT_EQ(lines[0]["old"]["crc32"], "cbf43926") << "the check value of CRC-32: that of \"123456789\"";
  EXPECT_EQ(lines[0]["new"]["build"], "0.2.0 \"new\"\n\xEF\xBF\xBD") << "a line stays a line of UTF-8";
  EXPECT_EQ(lines[1]["service"], "plc");
  std::filesystem::remove_all(directory);
}

TEST(SwapJournal, ADirectoryThatIsGoneIsAnError) {
  EXPECT_THROW(append_swap("/nowhere/at/all", "{}\n"), storage::StorageError);
}

}  // namespace
}  // namespace trunnion::launcher
