// SPDX-License-Identifier: Apache-2.0
// Machines whose stages have two replicas.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cluster/cluster_files.hpp"

namespace trunnion::integration {

/// A copy of the machine ac-table in which each stage of `stages` has two replicas, the second one on
/// `second`.
class TwinMachine {
 public:
  explicit TwinMachine(const std::vector<std::string>& stages, const std::string& second = "fastdds")
      : directory_(std::filesystem::temp_directory_path() / ("trunnion-twin-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(directory_);
    std::filesystem::copy(cluster::find_machine("ac-table"), directory_,
                          std::filesystem::copy_options::recursive);
    std::ifstream in(directory_ / "machine.yaml");
    std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const auto& stage : stages) {
      const std::string line = "{service: " + stage + "}";
      text.replace(text.find(line), line.size(),
                   "{service: " + stage + ", replicas: 2, vendor: [cyclonedds, " + second + "]}");
    }
    std::ofstream(directory_ / "machine.yaml") << text;
  }
  /// Parameter 000900, cycles.
  void set_lead(int cycles) const {
    std::ofstream(directory_ / "parameters.yaml", std::ios::app) << "\"000900\": " << cycles << "\n";
  }
  ~TwinMachine() { std::filesystem::remove_all(directory_); }
  TwinMachine(const TwinMachine&) = delete;
  TwinMachine& operator=(const TwinMachine&) = delete;
  std::string path() const { return directory_.string(); }

 private:
  std::filesystem::path directory_;
};

}  // namespace trunnion::integration
