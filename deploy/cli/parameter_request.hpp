// SPDX-License-Identifier: Apache-2.0
// Changes of parameters of a running cluster, and of a machine that is down.
#pragma once

#include <map>

#include "cluster/client.hpp"
#include "commands.hpp"
#include "machine/parameters.hpp"
#include "saved_parameters.hpp"

namespace trunnion::cli {

/// Who calls the command, for journals.
std::string user_name();

/// Sends the request in the name of the user and prints the reply; 0. Throws std::runtime_error when it is
/// refused.
/// `suffix` follows the user's name in the journal; `silent` prints nothing.
int send_parameters(const Common& common, cluster::Client& client, idl::parameters::ParameterRequest request,
                    const std::string& suffix = "", bool silent = false);

/// The same in a state directory that no cluster uses.
int save_parameters(const Common& common, const StatePlace& place, idl::parameters::ParameterRequest request);

/// Sets every value in the running cluster, all or none. The parameters service writes its journal.
int import_parameters(const Common& common, const std::map<std::uint32_t, machine::ParameterValue>& values,
                      const std::string& suffix = "", bool silent = false);

}  // namespace trunnion::cli
