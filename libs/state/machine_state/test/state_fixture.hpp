// SPDX-License-Identifier: Apache-2.0
// A state directory with every kind of file.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "machine_state/index_file.hpp"
#include "machine_state/state_check.hpp"
#include "storage/crc32.hpp"
#include "storage/kept_file.hpp"
#include "storage/retained_pair.hpp"
#include "testing_support/damage.hpp"

namespace trunnion::machine_state {

class StateFixture : public testing::Test {
 protected:
  StateFixture() : root_(testing::TempDir() + "machine_state_" + std::to_string(getpid())) {
    std::filesystem::remove_all(root_);
    fill(state());
  }
  ~StateFixture() override { std::filesystem::remove_all(root_); }
  std::string state() const { return root_ + "/state"; }

  static void fill(const std::string& directory) {
    std::filesystem::create_directories(directory + "/programs");
    for (const int generation : {1, 2}) {
      const auto text = "value: " + std::to_string(generation) + "\n";
      for (const auto* name : {"parameters.yaml", "tools.yaml", "channel-0.variables"})
        storage::write_kept(directory + "/" + name, text);
    }
    const std::string program = "G0 X1\nM30\n";
    std::ofstream(directory + "/programs/part.nc") << program;
    IndexFile index{1, {}};
    index.rows["part.nc"].revision = 1;
    index.rows["part.nc"].stored = {"part.nc", 1, program.size(), storage::crc32(program), 2};
    storage::write_kept(directory + "/" + index_file, write_index(index));
    storage::RetainedPair encoders(directory + "/encoders.bin", "encoders", 64);
    encoders.open(std::vector<std::uint8_t>(64, 7));
    std::ofstream(directory + "/journal.jsonl") << "{\"what\": \"tool\"}\n";
    // What is no state.
    std::ofstream(directory + "/cluster.boot") << "1\n";
    std::ofstream(directory + "/cluster.lock") << "{}\n";
    std::ofstream(directory + "/tools.yaml.damaged") << "x";
  }
  // Names and problems of what is not good, in one text.
  static std::string problems(const std::string& directory) {
    std::string all;
    for (const auto& report : check_state(directory))
      if (!report.problem.empty()) all += report.name + ": " + report.problem + "\n";
    return all;
  }
  std::string root_;
};

}  // namespace trunnion::machine_state
