// SPDX-License-Identifier: Apache-2.0
#include "state_place.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <stdexcept>

#include "cluster/cluster.hpp"
#include "machine/machine.hpp"

namespace trunnion::cli {
namespace {

// With the machine's name in the place of its directory.
StatePlace of_machine(const std::string& machine) {
  StatePlace place;
  place.directory = cluster::find_machine(machine);
  place.machine = machine::load_machine(place.directory).name;
  return place;
}

}  // namespace

void add_place_options(CLI::App& command, StatePlace& place) {
  command.add_option("--machine", place.machine,
                     "The machine (default: the one with the name of the state directory); without --state "
                     "its own state directory");
  command.add_option("--state", place.state, "State directory (default: that of the running cluster)");
}

StatePlace state_place(const Common& common, const StatePlace& given) {
  if (!given.given()) {
    const auto cluster = cluster::find_cluster(common.domain);
    return {cluster.machine, cluster.state_directory, cluster.machine_directory};
  }
  if (common.domain)
    throw std::runtime_error(
        "--domain names a cluster that runs, --state and --machine a directory: leave --domain out");
  StatePlace place;
  if (!given.machine.empty()) place = of_machine(given.machine);
  place.state = given.state.empty() ? cluster::default_state_directory(place.machine)
                                    : std::filesystem::absolute(given.state).lexically_normal().string();
  // Of "state/mill/" the machine is "mill", too.
  if (const std::filesystem::path path(place.state); !path.has_filename())
    place.state = path.parent_path().string();
  if (given.machine.empty()) try {
      const auto state = place.state;
      place = of_machine(std::filesystem::path(state).filename().string());
      place.state = state;
    } catch (const std::runtime_error&) {
    }
  return place;
}

const std::string& known_machine(const StatePlace& place) {
  if (place.directory.empty())
    throw std::runtime_error("say with --machine whose state " + place.state + " is");
  return place.directory;
}

}  // namespace trunnion::cli
