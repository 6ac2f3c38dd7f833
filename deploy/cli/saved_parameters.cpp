// SPDX-License-Identifier: Apache-2.0
#include "saved_parameters.hpp"

#include <filesystem>
#include <stdexcept>

#include "cluster/cluster_locks.hpp"
#include "machine/machine.hpp"
#include "parameter_store/file_storage.hpp"
#include "parameter_store/machine_defaults.hpp"
#include "parameter_store/private_storage.hpp"
#include "service/node.hpp"

namespace trunnion::cli {
namespace {

using parameters::FileStorage;
using parameters::ParameterStore;

machine::MachineConfig machine_of(const StatePlace& place) {
  auto machine = machine::load_machine(known_machine(place));
  if (!std::filesystem::is_directory(place.state))
    throw std::runtime_error(place.state + ": there is no such directory");
  return machine;
}

// The next start reports damage; a change here would put it aside without a word.
void require_whole(const std::string& state) {
  FileStorage files(state);
  for (const auto* name : {parameters::parameters_file, parameters::active_file, tool_tables::tools_file,
                           tool_tables::offsets_file})
    files.read(name);
  for (const auto& [name, kept] : files.damaged())
    throw std::runtime_error(storage::damage_text(files.path(name), kept, "values"));
}

}  // namespace

machine::Parameters saved_parameters(const StatePlace& place) {
  const auto machine = machine_of(place);
  require_whole(place.state);
  FileStorage files(place.state);
  parameters::PrivateStorage copy(files);
  return machine::parameters_of(ParameterStore(copy, parameters::defaults_of(machine), "").set());
}

idl::parameters::ParameterReply change_saved_parameters(const StatePlace& place,
                                                        const idl::parameters::ParameterRequest& request) {
  const auto machine = machine_of(place);
  const cluster::StateLock lock(place.state, cluster::make_identity(machine.name, 0, false), 0);
  require_whole(place.state);
  FileStorage files(place.state, true);
  ParameterStore store(files, parameters::defaults_of(machine), "");
  auto reply = store.apply(request, service::time_of_day());
  if (!reply.accepted) throw std::runtime_error(reply.reason);
  return reply;
}

}  // namespace trunnion::cli
