// SPDX-License-Identifier: Apache-2.0
// Changes of parameters of a running cluster.
#pragma once

#include <map>

#include "cluster/client.hpp"
#include "commands.hpp"
#include "machine/parameters.hpp"

namespace trunnion::cli {

/// Sends the request in the name of the user and prints the reply; 0. Throws std::runtime_error when it is
/// refused.
int send_parameters(const Common& common, cluster::Client& client, idl::parameters::ParameterRequest request);

/// Sets every value in the running cluster, all or none. The parameters service writes its journal.
int import_parameters(const Common& common, const std::map<std::uint32_t, machine::ParameterValue>& values);

}  // namespace trunnion::cli
