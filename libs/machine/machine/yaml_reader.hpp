// SPDX-License-Identifier: Apache-2.0
// Numbers, vectors and maps of a YAML file, with limits and the place of a fault.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace trunnion::machine {

/// Of a number in a file, both allowed.
struct Limits {
  double low = 0, high = 0;
};

/// Every function throws std::runtime_error that begins with file:line:column.
class YamlReader {
 public:
  explicit YamlReader(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const YAML::Node& node, const std::string& text) const;
  /// Calls `visit(key, key_node, value)` for each entry; keys that are there twice are refused. The visitor
  /// returns false for a key it does not know; `keys` is named then.
  using Visit = std::function<bool(const std::string& key, const YAML::Node& value)>;
  void each(const YAML::Node& map, const std::string& keys, const Visit& visit) const;
  /// Every key of `map` must be one of `names`, and there once.
  void only(const YAML::Node& map, const std::vector<std::string>& names) const;
  double number(const YAML::Node& node, Limits limits) const;
  /// A number without a fraction, at most 2^53.
  std::int64_t whole(const YAML::Node& node, Limits limits) const;
  std::vector<double> numbers(const YAML::Node& node, std::size_t most, Limits limits) const;
  geometry::Vec3 vector(const YAML::Node& node, Limits limits) const;
  std::string text(const YAML::Node& node) const;
  /// An address or the name of a computer, which is not looked up.
  std::string host(const YAML::Node& node) const;
  /// The entry of `choices` that the node names.
  template <class T>
  T choice(const YAML::Node& node, const std::map<std::string, T>& choices) const {
    const auto word = text(node);
    const auto found = choices.find(word);
    if (found != choices.end()) return found->second;
    std::string names;
    for (const auto& [name, value] : choices) names.append(names.empty() ? "" : ", ").append(name);
    fail(node, "'" + word + "' is none of " + names);
  }

 private:
  std::string file_;
};

}  // namespace trunnion::machine
