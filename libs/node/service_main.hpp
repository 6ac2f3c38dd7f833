// Included by node/node.hpp.
#pragma once

#include <CLI/CLI.hpp>
#include <iostream>

namespace trunnion::node {

template <class S>
int service_main(int argc, char** argv, const char* name) {
  Options options;
  options.service = name;
  CLI::App app(std::string("trunnion-") + name + ": a service of the Trunnion controller");
  add_options(app, options);
  if (const int status = parse_options(app, argc, argv, options); status >= 0) return status;
  try {
    Node node(options);
    S service(node);
    return node.run(service);
  } catch (const std::exception& e) {
    std::cerr << "trunnion-" << name << ": error: " << e.what() << "\n";
    return 1;
  }
}

}  // namespace trunnion::node
