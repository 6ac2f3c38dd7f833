// SPDX-License-Identifier: Apache-2.0
#include "parameter_request.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"

namespace trunnion::cli {
namespace {

// Of ParameterRequest in idl/parameters.idl.
constexpr std::size_t most_values = 4096, most_author = 64;

}  // namespace

std::string user_name() {
  const char* name = std::getenv("USER");
  return name != nullptr && *name != 0 ? name : "uid " + std::to_string(getuid());
}

int send_parameters(const Common& common, cluster::Client& client, idl::parameters::ParameterRequest request,
                    const std::string& suffix, bool silent) {
  request.who = user_name().substr(0, most_author - suffix.size()) + suffix;
  const auto reply = client.parameter(std::move(request));
  if (silent) return 0;
  if (common.json)
    std::cout
        << bus::Json{{"accepted", true}, {"revision", reply.revision}, {"pending", reply.pending}}.dump()
        << "\n";
  else
    std::printf("accepted, active revision %llu%s\n", static_cast<unsigned long long>(reply.revision),
                reply.pending > 0
                    ? (", " + std::to_string(reply.pending) + " waiting for reset or restart").c_str()
                    : "");
  return 0;
}

int import_parameters(const Common& common, const std::map<std::uint32_t, machine::ParameterValue>& values,
                      const std::string& suffix, bool silent) {
  if (values.size() > most_values)
    throw std::runtime_error(std::to_string(values.size()) + " parameters; one import takes " +
                             std::to_string(most_values) + " at most");
  cluster::Client client(cluster::find_cluster(common.domain).run.domain);
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::IMPORT;
  for (const auto& [number, value] : values) request.values.push_back({number, value.value, value.text});
  return send_parameters(common, client, std::move(request), suffix, silent);
}

}  // namespace trunnion::cli
