// SPDX-License-Identifier: Apache-2.0
#include "core/cluster_state.hpp"

#include <algorithm>
#include <cmath>

#include "core/precondition.hpp"
#include "machine/parameter_constants.hpp"
#include "text/utf8.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

/// Class of a parameter by its number, as the catalogue's head lays them out.
const char* group_of(std::uint32_t number) {
  if (number < 10000) return "nc";
  if (number < 40000) return "user";
  if (number < 100000) return "channel";
  if (number < 300000) return "axis";
  if (number < 700000) return "compensation";
  return "table";
}

Json number_json(double value) {
  // Whole numbers are shown as such: 8, not 8.0.
  if (std::floor(value) == value && std::abs(value) < 1e15) return static_cast<std::int64_t>(value);
  return value;
}

std::uint32_t index_of(const machine::Definition& definition, std::uint32_t number) {
  const auto distance = number - definition.number();
  return definition.units > 1 ? distance % 1000 : distance;
}

Json entry(const ClusterState& cluster, const machine::Definition& definition, std::uint32_t number) {
  const auto& values = cluster.values->values;
  const bool is_text = definition.type == machine::ParameterType::text;
  const auto known = values.find(number);
  Json json;
  json["number"] = number;
  json["name"] = definition.count > 1
                     ? definition.name + " " + std::to_string(index_of(definition, number) + 1)
                     : definition.name;
  json["unit"] = machine::unit_of(number, values);
  json["type"] = machine::to_string(definition.type);
  const double fallback = machine::Catalogue::instance().default_of(number);
  if (is_text) {
    json["default"] = "";
    json["value"] = known != values.end() ? known->second.text : "";
  } else {
    json["minimum"] = number_json(definition.minimum);
    json["maximum"] = number_json(definition.maximum);
    json["default"] = number_json(fallback);
    json["value"] = number_json(known != values.end() ? known->second.value : fallback);
  }
  json["activation"] = machine::to_string(definition.activation);
  json["access"] = definition.access;
  const auto& pending = cluster.parameters->pending;
  const auto waiting = std::ranges::lower_bound(pending, number, {}, &idl::parameters::Parameter::number);
  json["pending"] = waiting != pending.end() && waiting->number == number;
  if (json["pending"].get<bool>())
    json["pending_value"] = is_text ? Json(waiting->text) : Json(number_json(waiting->value));
  json["help"] = definition.help;
  json["group"] = group_of(number);
  return json;
}

}  // namespace

void ClusterState::set_parameters(std::shared_ptr<const idl::parameters::ParameterSet> set) {
  values = std::make_shared<const machine::Parameters>(machine::parameters_of(*set));
  parameters_tag = entity_tag(*set);
  parameters = std::move(set);
}

Json status_answer(const ClusterState& cluster, const std::string& contract) {
  Json json;
  const auto& document = cluster.document;
  json["contract"] = contract;
  json["cluster"] = document.contains("cluster") ? document["cluster"] : Json(nullptr);
  json["services"] = Json::array();
  if (document.contains("services"))
    for (const auto& [instance, service] : document["services"].items()) {
      Json one = {{"instance", std::stoul(instance)}};
      one.update(service);
      json["services"].push_back(std::move(one));
    }
  json["channels"] = Json::array();
  for (const auto& [number, state] : cluster.channels) json["channels"].push_back(number);
  json["alarms"] = document.contains("alarms") ? document["alarms"].size() : 0;
  json["drive"] = document.contains("drive") ? document["drive"] : Json(nullptr);
  json["plc"] = document.contains("plc") ? document["plc"] : Json(nullptr);
  return json;
}

Json alarms_answer(const ClusterState& cluster) {
  auto list = Json::array();
  if (cluster.document.contains("alarms"))
    for (const auto& [key, alarm] : cluster.document["alarms"].items()) list.push_back(alarm);
  return {{"alarms", std::move(list)}};
}

Json past_alarms_answer(const ClusterState& cluster, const std::string& search) {
  auto list = Json::array();
  if (cluster.past_alarms)
    for (const auto& past : *cluster.past_alarms)
      if (matches(past, search)) list.push_back(past_alarm_document(past));
  return {{"alarms", std::move(list)}};
}

Json channels_answer(const ClusterState& cluster) {
  auto list = Json::array();
  for (const auto& [number, state] : cluster.channels) list.push_back(bus::to_json(state));
  return {{"channels", std::move(list)}};
}

Json channel_answer(const ClusterState& cluster, std::uint16_t number) {
  const auto found = cluster.channels.find(number);
  if (found == cluster.channels.end()) return nullptr;
  const auto& state = found->second;
  auto json = bus::to_json(state);
  auto& positions = json["positions"] = Json::array();
  const auto column = [](const std::vector<double>& values, std::size_t i) {
    return i < values.size() ? Json(values[i]) : Json(nullptr);
  };
  for (std::size_t i = 0; i < state.axes.size(); ++i) {
    Json row;
    row["letter"] = i < state.letters.size() ? std::string(1, state.letters[i]) : "";
    row["axis"] = state.axes[i];
    row["machine"] = column(state.machine, i);
    row["workpiece"] = column(state.workpiece, i);
    row["distance_to_go"] = column(state.distance_to_go, i);
    const auto key = std::to_string(state.axes[i]);
    if (cluster.document.contains("axes") && cluster.document["axes"].contains(key))
      row.update(cluster.document["axes"][key]);
    positions.push_back(std::move(row));
  }
  return json;
}

Json parameters_answer(const ClusterState& cluster, const ParameterQuery& query) {
  if (!cluster.parameters) return nullptr;
  const auto& values = cluster.values->values;
  const auto name_number = parameter::axis_name.number();
  std::set<std::uint32_t> axes, channels;
  for (const auto& [number, value] : values)
    if (number >= name_number && number < name_number + 100000 && (number - name_number) % 1000 == 0 &&
        !value.text.empty())
      axes.insert((number - name_number) / 1000);
  for (const auto& [number, state] : cluster.channels) channels.insert(number);
  const auto wanted = text::lower_case(query.search);
  auto wanted_name = wanted;
  std::replace(wanted_name.begin(), wanted_name.end(), ' ', '_');  // names are shown with spaces

  std::map<std::uint32_t, const machine::Definition*> found;
  for (const auto& definition : machine::Catalogue::instance().definitions()) {
    const std::string group = group_of(definition.number());
    if (!query.group.empty() && group != query.group) continue;
    for (std::uint32_t unit = 0; unit < definition.units; ++unit) {
      const bool here = group == "channel"                           ? channels.contains(unit)
                        : group == "axis" || group == "compensation" ? axes.contains(unit)
                                                                     : true;
      for (std::uint32_t i = 0; i < definition.count; ++i) {
        const auto number = definition.number(unit, i);
        if (!here && !values.contains(number)) continue;
        if (!wanted.empty() && machine::number_text(number).find(wanted) == std::string::npos &&
            text::lower_case(definition.name).find(wanted_name) == std::string::npos &&
            text::lower_case(definition.help).find(wanted) == std::string::npos)
          continue;
        found.emplace(number, &definition);
      }
    }
  }
  auto list = Json::array();
  std::size_t index = 0;
  for (const auto& [number, definition] : found) {
    if (index++ < query.offset) continue;
    if (list.size() == query.limit) break;
    list.push_back(entry(cluster, *definition, number));
  }
  return {{"revision", cluster.parameters->revision},
          {"pending", cluster.parameters->pending.size()},
          {"total", found.size()},
          {"parameters", std::move(list)}};
}

Json parameter_answer(const ClusterState& cluster, std::uint32_t number) {
  const auto* definition = machine::Catalogue::instance().find(number);
  if (definition == nullptr || !cluster.parameters) return nullptr;
  return entry(cluster, *definition, number);
}

}  // namespace trunnion::gateway
