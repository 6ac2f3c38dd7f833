// YAML with errors that say file:line:column (yaml-cpp counts marks from 0).
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace trunnion::machine {

/// "file:line:column: error: " of a node.
std::string at(const std::string& file, const YAML::Node& node);
/// Throws std::runtime_error with file:line:column.
YAML::Node parse_yaml(const std::string& text, const std::string& file);
YAML::Node load_yaml(const std::string& path);

}  // namespace trunnion::machine
