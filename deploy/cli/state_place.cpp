// SPDX-License-Identifier: Apache-2.0
#include "state_place.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "cluster/cluster.hpp"
#include "machine/machine.hpp"

namespace trunnion::cli {

void add_place_options(CLI::App& command, StatePlace& place) {
  command.add_option("--machine", place.machine, "Machine whose default state directory it is");
  command.add_option("--state", place.state, "State directory (default: that of the running cluster)");
}

StatePlace state_place(const Common& common, StatePlace place) {
  if (!place.machine.empty())
    place.machine = machine::load_machine(cluster::find_machine(place.machine)).name;
  if (!place.state.empty()) {
    place.state = std::filesystem::absolute(place.state).lexically_normal().string();
    return place;
  }
  if (!place.machine.empty()) {
    place.state = cluster::default_state_directory(place.machine);
    return place;
  }
  const auto cluster = cluster::find_cluster(common.domain);
  return {cluster.machine, cluster.state_directory};
}

}  // namespace trunnion::cli
