// SPDX-License-Identifier: Apache-2.0
// YAML with errors that begin with file:line:column (yaml-cpp counts marks from 0).
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace trunnion::machine {

/// "file:line:column: error: " of a node.
std::string at(const std::string& file, const YAML::Node& node);
/// The text of a key or of one value. Throws std::runtime_error with file:line:column for a map or a list.
std::string scalar(const std::string& file, const YAML::Node& node);
/// Throws std::runtime_error with file:line:column.
YAML::Node parse_yaml(const std::string& text, const std::string& file);
/// `text` (UTF-8) as one scalar that reads back the same: plain when it is a word of letters, digits and '_',
/// else quoted.
std::string scalar_text(const std::string& text);
/// A whole file. Throws std::runtime_error naming it.
std::string read_text(const std::string& path);

}  // namespace trunnion::machine
