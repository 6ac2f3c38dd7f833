// SPDX-License-Identifier: Apache-2.0
#include "machine_directory.hpp"

#include <filesystem>

#include "cluster/cluster_files.hpp"

namespace trunnion::cli {

std::string machine_directory(const std::string& machine) {
  const std::filesystem::path path(machine);
  if (path.filename() != "machine.yaml") return cluster::find_machine(machine);
  return cluster::find_machine(path.has_parent_path() ? path.parent_path().string() : ".");
}

}  // namespace trunnion::cli
