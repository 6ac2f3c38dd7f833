// SPDX-License-Identifier: Apache-2.0
// The process that starts and watches a machine's services; `trunnion up` starts it.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <iostream>

#include "launcher.hpp"
#include "machine/service_constants.hpp"
#include "service/network.hpp"

namespace {

using trunnion::launcher::Start;

int report_pipe = -1;

// Who started us waits for one line: that the cluster is ready, or why it is not.
void report(Start start, const std::string& why) {
  if (report_pipe < 0) {
    if (start == Start::ready)
      std::printf("ready\n");
    else
      std::fprintf(stderr, "%s\n", why.c_str());
    std::fflush(stdout);
    return;
  }
  const std::string message = start == Start::ready    ? "ready\n"
                              : start == Start::faulty ? "faulty " + why + "\n"
                                                       : "error " + why + "\n";
  if (write(report_pipe, message.data(), message.size()) < 0) return;
  close(report_pipe);
  report_pipe = -1;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace trunnion;
  launcher::LaunchOptions options;
  std::string machine, vendor;
  std::uint32_t domain = 0;
  CLI::App app("trunnion-launcher: starts the services of a machine and watches them until SIGTERM");
  app.add_option("--machine", machine, "Directory with machine.yaml")->required();
  app.add_option("--vendor", vendor, "fastdds, cyclonedds or mixed, instead of machine.yaml's");
  app.add_option("--state", options.state_directory, "Directory for what must survive")->required();
  app.add_option("--domain", domain, "DDS domain")->required();
  app.add_option("--port", options.port, "Port of the gateway, 0 = no gateway");
  app.add_flag("--virtual-time", options.virtual_time,
               "Time advances with the setpoints, not with the clock");
  app.add_option("--host", options.host, "Which host of machine.yaml this is");
  std::vector<std::string> executables;
  app.add_option("--exec", executables, "SERVICE=PATH: what to start in the place of its executable");
  std::int64_t clock_offset = 0;
  app.add_option("--clock-offset", clock_offset, "ns from the monotonic clock to the time in messages");
  app.add_flag("--keep-faulty", options.keep_faulty,
               "Continue when a service runs and cannot take part, so that it can be corrected");
  app.add_option("--session", options.session, "Session that may stop it without naming it");
  app.add_option("--owner", options.owner, "Process id: stop when this process ends");
  bool one_host = false;
  app.add_flag("--one-host", one_host, "Start everything here, whatever hosts machine.yaml names");
  app.add_option("--report", report_pipe, "File descriptor to which 'ready' or 'error ...' is written");
  CLI11_PARSE(app, argc, argv);
  if (report_pipe >= 0) fcntl(report_pipe, F_SETFD, FD_CLOEXEC);
  try {
    options.machine = machine::load_machine(machine, vendor);
    options.machine.domain = domain;
    options.executables = cluster::read_executables(executables);
    if (one_host) machine::forget_hosts(options.machine);
    options.network = service::network_of(options.machine, options.host);
    options.network.identity = "deploy";
    options.network.clock_offset = clock_offset;
    options.run.domain = domain;
    if (options.port == 0)
      std::erase_if(options.machine.services,
                    [](const auto& s) { return s.service == machine::service::gateway.name; });
    return launcher::Launcher(std::move(options)).run(report);
  } catch (const std::exception& e) {
    report(Start::failed, e.what());
    return 1;
  }
}
