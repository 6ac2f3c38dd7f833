// SPDX-License-Identifier: Apache-2.0
#include "machine/yaml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {

void YamlReader::fail(const YAML::Node& node, const std::string& text) const {
  throw std::runtime_error(at(file_, node) + text);
}

void YamlReader::each(const YAML::Node& map, const std::string& keys, const Visit& visit) const {
  if (!map.IsMap()) fail(map, "expected 'key: value' with the keys " + keys);
  std::set<std::string> seen;
  for (const auto& entry : map) {
    const auto key = scalar(file_, entry.first);
    if (!seen.insert(key).second) fail(entry.first, "'" + key + "' is there twice");
    if (!visit(key, entry.second))
      fail(entry.first, std::string("unknown key '").append(key).append("'; the keys are ").append(keys));
  }
}

void YamlReader::only(const YAML::Node& map, const std::vector<std::string>& names) const {
  std::string keys;
  for (const auto& name : names) keys.append(keys.empty() ? "" : ", ").append(name);
  each(map, keys, [&](const std::string& key, const YAML::Node&) {
    return std::find(names.begin(), names.end(), key) != names.end();
  });
}

double YamlReader::number(const YAML::Node& node, Limits limits) const {
  const auto word = text(node);
  double value = 0;
  const char* last = word.data() + word.size();
  const char* first = word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-');
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    fail(node, "'" + word + "' is not a number");
  if (value < limits.low || value > limits.high) {
    char range[80];
    std::snprintf(range, sizeof range, " is not within %.9g .. %.9g", limits.low, limits.high);
    fail(node, word + range);
  }
  return value;
}

std::int64_t YamlReader::whole(const YAML::Node& node, Limits limits) const {
  const double value = number(node, limits);
  if (value != std::floor(value)) fail(node, "expected a whole number");
  return static_cast<std::int64_t>(value);
}

std::vector<double> YamlReader::numbers(const YAML::Node& node, std::size_t most, Limits limits) const {
  if (!node.IsSequence() || node.size() == 0 || node.size() > most)
    fail(node, "expected a list of 1 .. " + std::to_string(most) + " numbers");
  std::vector<double> values;
  for (const auto& element : node) values.push_back(number(element, limits));
  return values;
}

geometry::Vec3 YamlReader::vector(const YAML::Node& node, Limits limits) const {
  if (!node.IsSequence() || node.size() != 3) fail(node, "expected [x, y, z]");
  return {number(node[0], limits), number(node[1], limits), number(node[2], limits)};
}

std::string YamlReader::text(const YAML::Node& node) const { return scalar(file_, node); }

std::string YamlReader::host(const YAML::Node& node) const {
  constexpr std::size_t longest_name = 253;  // of the DNS, RFC 1035
  auto name = text(node);
  if (name.empty() || name.size() > longest_name) fail(node, "expected an address or the name of a computer");
  return name;
}

}  // namespace trunnion::machine
