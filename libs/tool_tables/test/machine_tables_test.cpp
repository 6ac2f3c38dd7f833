// SPDX-License-Identifier: Apache-2.0
#include "tool_tables/machine_tables.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace trunnion::tool_tables {
namespace {

namespace fs = std::filesystem;

const std::string ac_table = MACHINES_DIRECTORY "/ac-table";

TEST(MachineTables, AChannelTheMachineDoesNotHaveIsRefused) {
  EXPECT_THROW(load_machine_tables(ac_table, 1), std::runtime_error);
  EXPECT_EQ(load_machine_tables(MACHINES_DIRECTORY "/two-channel", 1).channel, 1);
}

TEST(MachineTables, AWrongTableIsRefusedWithItsPlace) {
  const fs::path copy = fs::temp_directory_path() / ("tool_tables_test_" + std::to_string(getpid()));
  fs::copy(ac_table, copy, fs::copy_options::recursive);
  std::ofstream(copy / tools_file) << "- {number: 1, length: long}\n";
  std::string message;
  try {
    load_machine_tables(copy.string());
  } catch (const std::runtime_error& e) {
    message = e.what();
  }
  fs::remove_all(copy);
  EXPECT_NE(message.find("tools.yaml:1:23: error: 'length'"), std::string::npos) << message;
}

}  // namespace
}  // namespace trunnion::tool_tables
