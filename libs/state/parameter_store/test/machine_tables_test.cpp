// SPDX-License-Identifier: Apache-2.0
#include "parameter_store/machine_tables.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "parameter_store/tool_tables.hpp"

namespace trunnion::tool_tables {
namespace {

namespace fs = std::filesystem;

const std::string ac_table = MACHINES_DIRECTORY "/ac-table";

TEST(MachineTables, AChannelTheMachineDoesNotHaveIsRefused) {
  EXPECT_THROW(load_machine_tables(ac_table, 1), std::runtime_error);
  EXPECT_EQ(load_machine_tables(MACHINES_DIRECTORY "/two-channel", 1).channel, 1);
}

TEST(MachineTables, AWrongTableIsRefusedWithItsPlace) {
  const fs::path copy = fs::temp_directory_path() / ("machine_tables_test_" + std::to_string(getpid()));
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

using idl::parameters::LifeUnit;

Tools read_table(const std::string& text) {
  std::uint64_t revision = 0;
  return read_tools(text, "tools.yaml", revision);
}

TEST(ToolTable, TypeAndLifeAreKeptAndMayBeMissing) {
  const auto tools = read_table(
      "- {number: 1, length: 100, radius: 5}\n"
      "- {number: 2, type: \"end: mill\", life_used: 12.5, life_limit: 90}\n"
      "- {number: 3, life_limit: 200, life_unit: pieces}\n");
  EXPECT_EQ(tools.at(1).type, "");
  EXPECT_EQ(tools.at(1).life_limit, 0);
  EXPECT_EQ(tools.at(1).life_unit, LifeUnit::MINUTES);
  EXPECT_EQ(tools.at(2).type, "end: mill");
  EXPECT_EQ(tools.at(2).life_used, 12.5);
  EXPECT_EQ(tools.at(2).life_unit, LifeUnit::MINUTES);
  EXPECT_EQ(tools.at(3).life_limit, 200);
  EXPECT_EQ(tools.at(3).life_unit, LifeUnit::PIECES);
  EXPECT_EQ(read_table(write_tools(tools, 7)), tools);
}

TEST(ToolTable, WhatIsNotUsedIsNotWrittenSoThatAnOlderVersionReadsTheTable) {
  EXPECT_EQ(write_tools(read_table("- {number: 1, length: 100, radius: 5, name: mill}\n"), 2),
            "revision: 2\ntools:\n  - {number: 1, length: 100, length_wear: 0, radius: 5, radius_wear: 0, "
            "name: mill}\n");
}

TEST(ToolTable, AWrongLifeOrTypeIsRefusedWithItsPlaceAndLimits) {
  const auto refusal = [](const std::string& fields) {
    try {
      read_table("- {number: 1, " + fields + "}\n");
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("life_unit: hours").find("tools.yaml:1:26: error: 'hours' is not minutes or pieces"),
            std::string::npos)
      << refusal("life_unit: hours");
  EXPECT_NE(refusal("life_used: -1").find("tool 1 (life_used): -1 is outside 0 .. 999999"),
            std::string::npos);
  EXPECT_NE(refusal("life_limit: .nan").find("tool 1 (life_limit)"), std::string::npos);
  EXPECT_NE(refusal("type: " + std::string(33, 'x')).find("tool 1 (type): longer than 32 bytes"),
            std::string::npos);
}

}  // namespace
}  // namespace trunnion::tool_tables
