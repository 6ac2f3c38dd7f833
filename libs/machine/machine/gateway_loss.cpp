// SPDX-License-Identifier: Apache-2.0
#include "machine/gateway_loss.hpp"

#include <regex>
#include <stdexcept>

#include "machine/yaml.hpp"
#include "machine/yaml_reader.hpp"

namespace trunnion::machine {

namespace {

std::string input(const YAML::Node& node, const std::string& name, const std::string& file) {
  static const std::regex bit("X([0-9]{1,3})\\.[0-7]");
  std::smatch match;
  const auto text = node[name] && node[name].IsScalar() ? node[name].Scalar() : "";
  if (!std::regex_match(text, match, bit) || std::stoi(match[1]) > 511)
    throw std::runtime_error(at(file, node[name] ? node[name] : node) + "continue_with needs '" + name +
                             "', the PLC input of a panel, X0.0 .. X511.7");
  return text;
}

}  // namespace

std::optional<StoppingInputs> read_gateway_loss(const YAML::Node& document, const std::string& file) {
  const auto node = document["gateway_loss"];
  if (!node || (node.IsScalar() && node.Scalar() == "hold")) return std::nullopt;
  const YamlReader reader(file);
  const auto inputs = node.IsMap() ? node["continue_with"] : YAML::Node(YAML::NodeType::Undefined);
  if (!inputs || !inputs.IsMap())
    throw std::runtime_error(
        at(file, node) +
        "gateway_loss must be 'hold', or {continue_with: {feed_hold: INPUT, emergency_stop: INPUT}}");
  reader.only(node, {"continue_with"});
  reader.only(inputs, {"feed_hold", "emergency_stop"});
  StoppingInputs stopping{input(inputs, "feed_hold", file), input(inputs, "emergency_stop", file)};
  if (stopping.feed_hold == stopping.emergency_stop)
    throw std::runtime_error(at(file, inputs) + "feed_hold and emergency_stop must be two inputs");
  return stopping;
}

std::optional<StoppingInputs> load_gateway_loss(const std::string& directory) {
  const auto file = directory + "/machine.yaml";
  return read_gateway_loss(parse_yaml(read_text(file), file), file);
}

}  // namespace trunnion::machine
