// SPDX-License-Identifier: Apache-2.0
// A copy of a delivered machine that a test may change.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "cluster/cluster_files.hpp"

namespace trunnion::integration {

/// Parameter 000900, cycles, for tests in real time whose subject is not the lead. On a virtual machine even
/// the highest priority is without its processor for 17 ms now and then, and beside another test some
/// hundred.
constexpr int lead_beyond_stalls = 400;

class MachineCopy {
 public:
  explicit MachineCopy(const std::string& machine)
      : directory_(std::filesystem::temp_directory_path() /
                   ("trunnion-machine-" + std::to_string(getpid()))) {
    std::filesystem::remove_all(directory_);
    std::filesystem::copy(cluster::find_machine(machine), directory_,
                          std::filesystem::copy_options::recursive);
  }
  ~MachineCopy() { std::filesystem::remove_all(directory_); }
  MachineCopy(const MachineCopy&) = delete;
  MachineCopy& operator=(const MachineCopy&) = delete;

  std::string path() const { return directory_.string(); }
  std::ofstream append(const std::string& file) const { return {directory_ / file, std::ios::app}; }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::ostringstream text;
    text << std::ifstream(directory_ / file).rdbuf();
    auto content = text.str();
    const auto at = content.find(from);
    if (at == std::string::npos) throw std::runtime_error(file + " does not have '" + from + "'");
    content.replace(at, from.size(), to);
    std::ofstream(directory_ / file) << content;
  }
  /// Parameter 000900, cycles.
  void set_lead(int cycles) const { append("parameters.yaml") << "\"000900\": " << cycles << "\n"; }

 private:
  std::filesystem::path directory_;
};

}  // namespace trunnion::integration
