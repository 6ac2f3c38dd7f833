#include "machine/alarms.hpp"

#include <algorithm>
#include <stdexcept>

#include "machine/yaml.hpp"

namespace trunnion::machine {

extern const char* const alarms_text;

namespace {
template <class E>
E pick(const YAML::Node& node, const std::vector<std::string>& names) {
  const auto found = std::find(names.begin(), names.end(), node.as<std::string>());
  if (found == names.end()) throw std::runtime_error(at("alarms.yaml", node) + "unknown value");
  return static_cast<E>(found - names.begin());
}

std::vector<AlarmDefinition> load() {
  std::vector<AlarmDefinition> list;
  const auto document = parse_yaml(alarms_text, "alarms.yaml");
  for (const auto& node : document["alarms"])
    list.push_back({node["number"].as<std::uint32_t>(), node["name"].as<std::string>(),
                    pick<Severity>(node["severity"], {"hint", "warning", "error", "emergency"}),
                    pick<Reaction>(node["reaction"], {"show", "feed_hold", "axis_stop", "emergency_stop"}),
                    node["text"].as<std::string>()});
  return list;
}
}  // namespace

const std::vector<AlarmDefinition>& alarm_list() {
  static const auto list = load();
  return list;
}

const AlarmDefinition& alarm_definition(const std::string& name) {
  for (const auto& alarm : alarm_list())
    if (alarm.name == name) return alarm;
  throw std::out_of_range("no alarm is called " + name);
}

}  // namespace trunnion::machine
