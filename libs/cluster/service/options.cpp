// SPDX-License-Identifier: Apache-2.0
#include "service/options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

#include "bus/contract.hpp"
#include "service/network.hpp"
#include "trunnion/version.hpp"

namespace trunnion::service {

void add_options(CLI::App& app, Options& options) {
  app.set_version_flag("--version",
                       options.service + " " + version + ", contract " + bus::contract_of(options.service));
  app.add_option("--machine", options.machine_directory, "Directory with machine.yaml")->required();
  app.add_option("--state", options.state_directory, "Directory for what must survive a restart")->required();
  app.add_option("--instance", options.instance, "Number of this process in the cluster");
  app.add_option("--replica", options.replica, "Number of this replica of a stage");
  app.add_option("--channel", options.channel, "Channel number");
  app.add_option("--domain", options.network.domain, "DDS domain, 0 .. 100")->check(CLI::Range(0, 100));
  add_network_options(app, options.network);
  app.add_option_function<std::string>(
         "--vendor", [&options](const std::string& name) { options.vendor = bus::vendor_from(name); },
         "DDS vendor: fastdds or cyclonedds")
      ->check(CLI::IsMember({"fastdds", "cyclonedds"}));
  app.add_flag("--virtual-time", options.virtual_time,
               "Time advances with the setpoints, not with the clock");
  app.add_flag("--standby", options.standby,
               "Begin on standby beside the service that this one replaces, until the launcher promotes it");
  app.add_option("--snapshot", options.snapshot,
                 "File with the recorded state that this process continues from, for a verification")
      ->check(CLI::ExistingFile);
  app.add_flag("--parent-bound", options.parent_bound, "Stop when the parent process is gone");
}

int parse_options(CLI::App& app, int argc, char** argv, Options& options) {
  try {
    app.parse(argc, argv);
    options.network.identity = options.service;
    options.machine = machine::load_machine(options.machine_directory);
  } catch (const CLI::ParseError& e) {
    return app.exit(e);
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
  return -1;
}

}  // namespace trunnion::service
