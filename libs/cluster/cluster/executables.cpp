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
    const auto refused = [&](const std::string& reason) {
      std::string line = "--exec ";
      return std::runtime_error(line.append(text).append(reason));
    };
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw refused(": expected SERVICE=PATH");
    const auto service = text.substr(0, equals);
    if (machine::find_service(service) == nullptr) throw refused(": there is no service of this name");
    const auto path = fs::absolute(text.substr(equals + 1)).lexically_normal();
    if (!fs::is_regular_file(path) || access(path.c_str(), X_OK) != 0)
      throw refused(": there is no executable " + path.string());
    if (!executables.emplace(service, path.string()).second)
      throw refused(": the service has an executable already");
  }
  return executables;
}

std::vector<std::string> executable_arguments(const Executables& executables) {
  std::vector<std::string> arguments;
  for (const auto& [service, path] : executables) {
    arguments.emplace_back("--exec");
    arguments.push_back(service);
    arguments.back().append("=").append(path);
  }
  return arguments;
}

}  // namespace trunnion::cluster
