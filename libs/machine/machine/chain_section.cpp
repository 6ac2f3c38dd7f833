// SPDX-License-Identifier: Apache-2.0
#include "machine/chain_section.hpp"

#include <set>
#include <stdexcept>

#include "machine/kinematics.hpp"
#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::machine {
namespace {

using geometry::ChainElement;
using geometry::ElementKind;

[[noreturn]] void fail(const std::string& file, const YAML::Node& node, const std::string& text) {
  throw std::runtime_error(at(file, node) + text);
}

geometry::Vec3 read_vector(const std::string& file, const YAML::Node& node) {
  if (!node.IsSequence() || node.size() != 3) fail(file, node, "expected [x, y, z]");
  geometry::Vec3 v;
  for (std::size_t i = 0; i < 3; ++i) {
    double value = 0;
    if (!YAML::convert<double>::decode(node[i], value)) fail(file, node[i], "expected a number");
    v[static_cast<Eigen::Index>(i)] = value;
  }
  if (!v.allFinite()) fail(file, node, "a value is not finite");
  return v;
}

std::size_t read_letter(const std::string& file, const YAML::Node& node, const std::string& letters) {
  const auto text = scalar(file, node);
  const auto found = text.size() == 1 ? letters.find(text) : std::string::npos;
  if (found == std::string::npos) fail(file, node, "'" + text + "' is none of the axes " + letters);
  return found;
}

ChainElement read_element(const std::string& file, const YAML::Node& node) {
  YamlReader(file).only(node, {"name", "offset", "correction", "rotary", "linear", "direction", "base"});
  ChainElement element;
  if (!node["name"]) fail(file, node, "an element without a name");
  element.name = scalar(file, node["name"]);
  const auto offset = node["offset"], correction = node["correction"], rotary = node["rotary"],
             linear = node["linear"], direction = node["direction"], base = node["base"];
  if (int{offset.IsDefined()} + int{correction.IsDefined()} + int{rotary.IsDefined()} +
          int{linear.IsDefined()} + int{base.IsDefined()} !=
      1)
    fail(file, node, "an element is one of offset, correction, rotary, linear and base");
  if (rotary) {
    element.kind = ElementKind::rotary;
    element.axis = read_letter(file, rotary, "ABCUVW");
    if (!direction) fail(file, node, "a rotary axis without a direction");
    element.vector = read_vector(file, direction);
  } else if (linear) {
    element.kind = ElementKind::linear;
    element.axis = read_letter(file, linear, "XYZ");
    element.vector = direction
                         ? read_vector(file, direction)
                         : geometry::Vec3(geometry::Vec3::Unit(static_cast<Eigen::Index>(element.axis)));
  } else {
    if (direction) fail(file, direction, "only axes have a direction");
    if (base) {
      if (scalar(file, base) != "true") fail(file, base, "'base' can only be true");
      element.kind = ElementKind::base;
      return element;
    }
    element.kind = offset ? ElementKind::offset : ElementKind::correction;
    element.vector = read_vector(file, offset ? offset : correction);
  }
  return element;
}

geometry::ChainDescription read_chain(const std::string& file, const YAML::Node& node) {
  geometry::ChainDescription chain;
  if (node["tool_direction"]) chain.tool_direction = read_vector(file, node["tool_direction"]);
  if (node["closed"] && !YAML::convert<bool>::decode(node["closed"], chain.closed))
    fail(file, node["closed"], "'closed' must be true or false");
  const auto elements = node["elements"];
  if (!elements || !elements.IsSequence()) fail(file, node, "'elements' is missing");
  std::set<std::string> names;
  for (const auto& element : elements) {
    chain.elements.push_back(read_element(file, element));
    if (!names.insert(chain.elements.back().name).second)
      fail(file, element, "'" + chain.elements.back().name + "' is there twice");
  }
  return chain;
}

// Calls visit(channel, description, node) for every entry.
template <class Visit>
void visit_chains(const YAML::Node& section, const std::string& file, Visit&& visit) {
  if (!section) return;
  if (!section.IsSequence()) fail(file, section, "'chains' is a list");
  std::set<int> channels;
  for (const auto& node : section) {
    YamlReader(file).only(node, {"channel", "tool_direction", "closed", "elements"});
    int channel = 0;
    if (node["channel"] &&
        (!YAML::convert<int>::decode(node["channel"], channel) || channel < 0 || channel > 9))
      fail(file, node["channel"], "channel must be 0 .. 9");
    if (!channels.insert(channel).second)
      fail(file, node, "channel " + std::to_string(channel) + " has two chains");
    visit(static_cast<std::uint16_t>(channel), read_chain(file, node), node);
  }
}

}  // namespace

std::map<std::uint16_t, geometry::ChainDescription> read_chains(const YAML::Node& section,
                                                                const std::string& file) {
  std::map<std::uint16_t, geometry::ChainDescription> chains;
  visit_chains(section, file,
               [&](std::uint16_t channel, geometry::ChainDescription chain, const YAML::Node&) {
                 chains.emplace(channel, std::move(chain));
               });
  return chains;
}

std::map<std::uint32_t, ParameterValue> read_chain_parameters(const YAML::Node& section,
                                                              const std::string& file) {
  std::map<std::uint32_t, ParameterValue> values;
  visit_chains(section, file,
               [&](std::uint16_t channel, const geometry::ChainDescription& chain, const YAML::Node& node) {
                 try {
                   values.merge(parameters_of_chain(chain, channel));
                 } catch (const KinematicsError& e) {
                   fail(file, node, e.what());
                 }
               });
  return values;
}

}  // namespace trunnion::machine
