// SPDX-License-Identifier: Apache-2.0
// Changes of parameters of a running cluster.
#pragma once

#include <map>

#include "cluster/client.hpp"
#include "commands.hpp"
#include "machine/parameters.hpp"

namespace trunnion::cli {

/// Who calls the command, for journals.
std::string user_name();

/// Sends the request in the name of the user and prints the reply; 0. Throws std::runtime_error when it is
/// refused.
/// `suffix` follows the user's name in the journal; `silent` prints nothing.
int send_parameters(const Common& common, cluster::Client& client, idl::parameters::ParameterRequest request,
                    const std::string& suffix = "", bool silent = false);

/// Sets every value in the running cluster, all or none. The parameters service writes its journal.
int import_parameters(const Common& common, const std::map<std::uint32_t, machine::ParameterValue>& values,
                      const std::string& suffix = "", bool silent = false);

}  // namespace trunnion::cli
