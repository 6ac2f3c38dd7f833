// SPDX-License-Identifier: Apache-2.0
#include "saved_parameters.hpp"

#include <filesystem>

#include "cluster/cluster.hpp"
#include "cluster/cluster_locks.hpp"
#include "machine/machine.hpp"
#include "parameter_store/file_storage.hpp"
#include "parameter_store/machine_defaults.hpp"
#include "parameter_store/private_storage.hpp"
#include "service/node.hpp"

namespace trunnion::cli {
namespace {

namespace fs = std::filesystem;
using parameters::FileStorage;
using parameters::ParameterStore;

struct Saved {
  machine::MachineConfig machine;
  std::string directory;
};

// The directory does not say which machine it belongs to. By default it has the machine's name.
Saved saved_in(const StatePlace& place) {
  const auto name = place.machine.empty() ? fs::path(place.state).filename().string() : place.machine;
  Saved saved;
  try {
    saved.machine = machine::load_machine(cluster::find_machine(name));
  } catch (const std::runtime_error&) {
    if (!place.machine.empty()) throw;
    throw std::runtime_error("say with --machine whose parameters " + place.state + " has");
  }
  saved.directory = place.state.empty() ? cluster::default_state_directory(saved.machine.name) : place.state;
  if (!fs::is_directory(saved.directory))
    throw std::runtime_error(saved.directory + ": there is no such directory");
  return saved;
}

}  // namespace

machine::Parameters saved_parameters(const StatePlace& place) {
  const auto saved = saved_in(place);
  FileStorage files(saved.directory);
  parameters::PrivateStorage copy(files);
  return machine::parameters_of(ParameterStore(copy, parameters::defaults_of(saved.machine), "").set());
}

idl::parameters::ParameterReply change_saved_parameters(const StatePlace& place,
                                                        const idl::parameters::ParameterRequest& request) {
  const auto saved = saved_in(place);
  const cluster::StateLock lock(saved.directory, cluster::make_identity(saved.machine.name, 0, false), 0);
  FileStorage files(saved.directory, true);
  ParameterStore store(files, parameters::defaults_of(saved.machine), "");
  auto reply = store.apply(request, service::time_of_day());
  if (!reply.accepted) throw std::runtime_error(reply.reason);
  return reply;
}

}  // namespace trunnion::cli
