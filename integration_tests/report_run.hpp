// SPDX-License-Identifier: Apache-2.0
// `trunnion run` as a user calls it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cluster/cluster.hpp"

namespace trunnion::integration {

/// The report as JSON; the run must succeed.
inline nlohmann::json run(const std::string& arguments) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("trunnion-report-" + std::to_string(getpid()));
  const std::string command =
      cluster::binary_directory() + "/trunnion run " + arguments + " --json --report " + directory.string();
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (const auto n = fread(buffer.data(), 1, buffer.size(), pipe)) text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << text;
  std::filesystem::remove_all(directory);
  return nlohmann::json::parse(text, nullptr, false);
}

}  // namespace trunnion::integration
