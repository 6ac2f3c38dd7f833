// Included by node/node.hpp.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>

#include "machine/services.hpp"

namespace trunnion::node {

/// Waits as a shadow. False when the process is told to end before it is needed.
template <class S>
bool wait_until_needed(Node& node) {
  if constexpr (requires { typename S::Rehearsal; }) {
    if (node.shadow()) {
      typename S::Rehearsal rehearsal(node);
      return node.stand_by(&rehearsal);
    }
  }
  return node.stand_by();
}

template <class S>
int service_main(int argc, char** argv, const char* name) {
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
    if (!S::works_as_shadow && !wait_until_needed<S>(node)) return 0;
    S service(node);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-" << name << ": error: " << e.what() << "\n";
    return 1;
  }
}

}  // namespace trunnion::node
