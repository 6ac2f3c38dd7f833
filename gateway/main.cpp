#include <CLI/CLI.hpp>
#include <iostream>

#include "service.hpp"

int main(int argc, char** argv) {
  using namespace trunnion;
  node::Options options;
  options.service = "gateway";
  gateway::GatewayOptions own;
  CLI::App app("trunnion-gateway: the cluster's HTTP and WebSocket side");
  node::add_options(app, options);
  app.add_option("--address", own.address,
                 "Address to listen on; anything but 127.0.0.1 opens the machine to a network");
  app.add_option("--port", own.port, "Port to listen on (default: the one of machine.yaml)");
  app.add_option("--web", own.web, "Directory of the built page");
  if (const int status = node::parse_options(app, argc, argv, options); status >= 0) return status;
  try {
    node::Node node(options);
    if (!node.stand_by()) return 0;
    gateway::GatewayService service(node, own);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-gateway: error: " << e.what() << "\n";
    return 1;
  }
}
