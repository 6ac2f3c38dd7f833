// SPDX-License-Identifier: Apache-2.0
#include "service_process.hpp"

#include <vector>

#include "cluster/cluster_files.hpp"
#include "machine/service_constants.hpp"
#include "service/network.hpp"
#include "service/node.hpp"

namespace trunnion::launcher {

void ServiceProcess::start(const LaunchOptions& options, bool on_standby, double now) {
  const auto& e = entry;
  std::vector<std::string> args{executable,
                                "--machine",
                                options.machine.directory,
                                "--state",
                                options.state_directory,
                                "--instance",
                                std::to_string(e.instance),
                                "--replica",
                                std::to_string(e.replica),
                                "--channel",
                                std::to_string(e.channel),
                                "--domain",
                                std::to_string(options.machine.domain),
                                "--vendor",
                                e.vendor,
                                "--parent-bound"};
  for (auto& argument : service::network_arguments(options.network)) args.push_back(std::move(argument));
  if (options.virtual_time) args.emplace_back("--virtual-time");
  if (on_standby) args.emplace_back("--standby");
  if (e.service == machine::service::gateway.name) {
    args.insert(args.end(), {"--port", std::to_string(options.port)});
    if (const auto web = cluster::web_directory(); !web.empty()) args.insert(args.end(), {"--web", web});
  }
  cluster::ChildOptions child_options;
  child_options.arguments = std::move(args);
  child_options.log = log;
  child = cluster::ChildProcess(child_options);
  pid = child.pid();
  policy.started(now);
  lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  in_step = false;
  alive = false;
  standby = idl::service::StandbyState::JOINING;
  compared = 0;
  difference.clear();
}

std::optional<int> ServiceProcess::ended() {
  if (pid == 0) return std::nullopt;
  const auto status = child.status();
  if (status) pid = 0;
  return status;
}

bool ServiceProcess::hear(const idl::service::ServiceState& state, double now) {
  if (entry.instance != state.instance || pid != state.pid || pid == 0) return false;
  policy.beat(now);
  alive = true;
  lifecycle = state.lifecycle;
  detail = state.detail;
  in_step = state.in_step;
  standby = state.standby;
  compared = state.compared;
  difference = state.difference;
  return true;
}

std::string ServiceProcess::name() const {
  return entry.service + (entry.service == machine::service::channel.name
                              ? " " + std::to_string(entry.channel)
                          : entry.replica > 0 ? " (replica " + std::to_string(entry.replica) + ")"
                                              : "");
}

}  // namespace trunnion::launcher
