// SPDX-License-Identifier: Apache-2.0
#include "parameter_request.hpp"

#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "bus/json.hpp"
#include "cluster/cluster.hpp"
#include "machine/roles.hpp"

namespace trunnion::cli {
namespace {

// Of ParameterRequest in idl/parameters.idl.
constexpr std::size_t most_values = 4096, most_author = 64;

int print_reply(const Common& common, const idl::parameters::ParameterReply& reply, const std::string& done) {
  if (common.json)
    std::cout
        << bus::Json{{"accepted", true}, {"revision", reply.revision}, {"pending", reply.pending}}.dump()
        << "\n";
  else
    std::printf("%s%s\n", done.c_str(),
                reply.pending > 0
                    ? (", " + std::to_string(reply.pending) + " waiting for reset or restart").c_str()
                    : "");
  return 0;
}

}  // namespace

std::string user_name() {
  const char* name = std::getenv("USER");
  return name != nullptr && *name != 0 ? name : "uid " + std::to_string(getuid());
}

int send_parameters(const Common& common, cluster::Client& client, idl::parameters::ParameterRequest request,
                    const std::string& suffix, bool silent) {
  request.who = user_name().substr(0, most_author - suffix.size()) + suffix;
  const auto reply = client.parameter(std::move(request));
  return silent ? 0
                : print_reply(common, reply, "accepted, active revision " + std::to_string(reply.revision));
}

int save_parameters(const Common& common, const StatePlace& place,
                    idl::parameters::ParameterRequest request) {
  request.who = user_name().substr(0, most_author);
  request.role = machine::role::builder;
  return print_reply(common, change_saved_parameters(place, request), "saved, active from the next start on");
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
