// Included by node/node.hpp.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <iterator>

namespace trunnion::service {

/// Waits until the process is promoted, if it is on standby. False when it is told to end instead.
template <class S>
bool wait_for_promotion(Node& node) {
  if constexpr (requires { typename S::Rehearsal; }) {
    if (node.on_standby()) {
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
  constexpr const char* cyclic[] = {"channel", "kinematics", "compensation", "gantry", "drive", "plc"};
  const bool is_cyclic =
      std::any_of(std::begin(cyclic), std::end(cyclic), [&](const char* c) { return options.service == c; });
  if (is_cyclic && !options.virtual_time) use_real_time_scheduling();
  try {
    Node node(options);
    if (!S::works_on_standby && !wait_for_promotion<S>(node)) return 0;
    S service(node);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-" << name << ": error: " << e.what() << "\n";
    return 1;
  }
}

}  // namespace trunnion::service
