// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "service.hpp"
#include "standby_service.hpp"

namespace {

/// False when the process is told to end before it is needed.
bool stand_by(trunnion::service::Node& node, std::uint16_t port) {
  if (!node.on_standby()) return node.stand_by();
  trunnion::gateway::StandbyService standby(node, port);
  return node.stand_by(&standby);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace trunnion;
  service::Options options;
  options.service = "gateway";
  gateway::GatewayOptions own;
  CLI::App app("trunnion-gateway: the cluster's HTTP and WebSocket side");
  service::add_options(app, options);
  app.add_option("--address", own.address,
                 "Address to listen on; anything but 127.0.0.1 opens the machine to a network");
  app.add_option("--port", own.port, "Port to listen on (default: the one of machine.yaml)");
  app.add_option("--web", own.web, "Directory of the built page");
  if (const int status = service::parse_options(app, argc, argv, options); status >= 0) return status;
  try {
    service::Node node(options);
    if (own.port == 0) own.port = options.machine.port;
    own.host_names = options.machine.host_names;
    char computer[256] = {};
    gethostname(computer, sizeof computer - 1);
    own.host_names.insert(own.host_names.end(), {computer, std::string(computer) + ".local"});
    if (!stand_by(node, own.port)) return 0;
    gateway::GatewayService service(node, own);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-gateway: error: " << e.what() << "\n";
    return 1;
  }
}
