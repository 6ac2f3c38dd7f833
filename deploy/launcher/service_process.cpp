#include "service_process.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <vector>

#include "cluster/cluster_files.hpp"
#include "service/network.hpp"
#include "service/node.hpp"

namespace trunnion::launcher {

void ServiceProcess::start(const LaunchOptions& options, bool shadow) {
  const auto& e = entry;
  std::vector<std::string> args{executable,
                                "--machine",
                                options.machine.directory,
                                "--state",
                                options.state_directory,
                                "--instance",
                                std::to_string(e.instance),
                                "--copy",
                                std::to_string(e.copy),
                                "--channel",
                                std::to_string(e.channel),
                                "--domain",
                                std::to_string(options.machine.domain),
                                "--vendor",
                                e.vendor,
                                "--parent-bound"};
  for (auto& argument : service::network_arguments(options.network)) args.push_back(std::move(argument));
  if (options.virtual_time) args.emplace_back("--virtual-time");
  if (shadow) args.emplace_back("--shadow");
  if (e.service == "gateway") {
    args.insert(args.end(), {"--port", std::to_string(options.port)});
    if (const auto web = cluster::web_directory(); !web.empty()) args.insert(args.end(), {"--web", web});
  }
  std::vector<char*> argv;
  for (auto& arg : args) argv.push_back(arg.data());
  argv.push_back(nullptr);
  const int child = fork();
  if (child == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (out >= 0) {
      dup2(out, 1);
      dup2(out, 2);
    }
    const int null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, 0);
    for (int fd = 3; fd < 256; ++fd) close(fd);
    execv(argv[0], argv.data());
    dprintf(2, "%s: cannot be started\n", argv[0]);
    _exit(127);
  }
  pid = child;
  policy.started(service::monotonic_seconds());
  lifecycle = idl::service::Lifecycle::UNCONFIGURED;
  in_step = false;
  frames_out = 0;
  alive = false;
}

bool ServiceProcess::hear(const idl::service::ServiceState& state, double now) {
  if (entry.instance != state.instance || pid != state.pid || pid == 0) return false;
  policy.beat(now);
  alive = true;
  lifecycle = state.lifecycle;
  detail = state.detail;
  in_step = state.in_step;
  frames_out = state.frames_out;
  return true;
}

std::string ServiceProcess::name() const {
  return entry.service + (entry.service == "channel" ? " " + std::to_string(entry.channel)
                          : entry.copy > 0           ? " (copy " + std::to_string(entry.copy) + ")"
                                                     : "");
}

}  // namespace trunnion::launcher
