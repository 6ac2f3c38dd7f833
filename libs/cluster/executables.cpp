// SPDX-License-Identifier: Apache-2.0
#include "cluster/executables.hpp"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

#include "machine/services.hpp"

namespace trunnion::cluster {
namespace fs = std::filesystem;

Executables read_executables(const std::vector<std::string>& texts) {
  Executables executables;
  for (const auto& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw std::runtime_error("--exec " + text + ": expected SERVICE=PATH");
    const auto service = text.substr(0, equals);
    if (machine::find_service(service) == nullptr)
      throw std::runtime_error("--exec " + text + ": there is no service '" + service + "'");
    const auto path = fs::absolute(text.substr(equals + 1)).lexically_normal();
    if (!fs::is_regular_file(path) || access(path.c_str(), X_OK) != 0)
      throw std::runtime_error("--exec " + text + ": there is no executable " + path.string());
    if (!executables.emplace(service, path.string()).second)
      throw std::runtime_error("--exec " + text + ": service '" + service + "' has one already");
  }
  return executables;
}

std::vector<std::string> executable_arguments(const Executables& executables) {
  std::vector<std::string> arguments;
  for (const auto& [service, path] : executables) {
    arguments.emplace_back("--exec");
    arguments.push_back(service + "=" + path);
  }
  return arguments;
}

}  // namespace trunnion::cluster
