// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <iostream>

#include "machine/services.hpp"
#include "service/node.hpp"

namespace trunnion::service {
namespace {

/// Waits until the process is promoted, if it is on standby. False when it is told to end instead.
bool wait_for_promotion(Node& node, const ServiceType& type) {
  if (type.standby == nullptr || !node.on_standby()) return node.stand_by();
  const auto standby = type.standby(node);
  return node.stand_by(standby.get());
}

}  // namespace

int run_service(int argc, char** argv, const char* name, const ServiceType& type) {
  Options options;
  options.service = name;
  CLI::App app(std::string("trunnion-") + name + ": a service of the Trunnion controller");
  add_options(app, options);
  if (const int status = parse_options(app, argc, argv, options); status >= 0) return status;
  // The services of the stream share the cycle; what waits for files or browsers does not.
  const auto* definition = machine::find_service(options.service);
  if (definition != nullptr && definition->cyclic && !options.virtual_time) use_real_time_scheduling();
  try {
    Node node(options);
    if (!type.works_on_standby && !wait_for_promotion(node, type)) return 0;
    const auto service = type.service(node);
    return node.run(*service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-" << name << ": error: " << e.what() << "\n";
    return 1;
  }
}

}  // namespace trunnion::service
