// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace trunnion::gateway::mtconnect {
namespace {

using bus::Json;
using idl::channel::Mode;
using idl::channel::RunState;

constexpr std::uint32_t generation_step = 10000;  // as in cluster/instances.hpp

// 0.1 um and 0.1 mdeg: finer changes would fill the buffer.
std::string number(double value, int digits = 4) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, std::isfinite(value) ? value : 0.0);
  std::string shown = text;
  if (shown.find('.') != std::string::npos) {
    shown.erase(shown.find_last_not_of('0') + 1);
    if (shown.ends_with('.')) shown.pop_back();
  }
  return shown == "-0" ? "0" : shown;
}

double member(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_number() ? found->get<double>() : 0.0;
}

const Json& part_of(const Json& json, const std::string& name) {
  static const Json nothing = Json::object();
  const auto found = json.find(name);
  return found != json.end() && found->is_object() ? *found : nothing;
}

const char* execution_of(const idl::channel::ChannelState& state) {
  switch (state.state) {
    case RunState::RUNNING:
      return "ACTIVE";
    case RunState::HOLDING:
    case RunState::HELD:
      return "FEED_HOLD";
    case RunState::WAITING:
      return "WAIT";
    case RunState::INTERRUPTED:
      return "INTERRUPTED";
    default:
      return "READY";
  }
}

const char* mode_of(Mode mode) {
  return mode == Mode::AUTO ? "AUTOMATIC" : mode == Mode::MDI ? "MANUAL_DATA_INPUT" : "MANUAL";
}

std::string work_offset_name(std::uint8_t index) {
  return index < 6 ? "G" + std::to_string(54 + index) : "G54.1 P" + std::to_string(index - 5);
}

std::string path_position(const idl::channel::ChannelState& state) {
  std::string text;
  for (const char letter : {'X', 'Y', 'Z'}) {
    const auto i = state.letters.find(letter);
    const double value = i < state.workpiece.size() ? state.workpiece[i] : 0.0;
    text += (text.empty() ? "" : " ") + number(value);
  }
  return text;
}

}  // namespace

ValuesOf::ValuesOf(const ClusterState& cluster, const std::map<std::uint32_t, std::uint32_t>& channel_of)
    : cluster_(cluster) {
  std::map<std::string, bool> alive;
  for (const auto& [instance, service] : part_of(cluster.document, "services").items()) {
    const bool here = service.value("alive", false);
    const auto name = service.value("service", "");
    alive[name] = alive[name] || here;
    const auto channel = channel_of.find(static_cast<std::uint32_t>(std::stoul(instance)) % generation_step);
    if (name != "channel" || channel == channel_of.end()) continue;
    const auto known = silent_channels_.try_emplace(channel->second, true).first;
    known->second = known->second && !here;
  }
  drive_ = !alive.contains("drive") || alive["drive"];
  plc_ = !alive.contains("plc") || alive["plc"];
}

std::optional<std::string> ValuesOf::of_axis(const DataItem& item) const {
  if (item.quantity == Quantity::rotary_mode) return "CONTOUR";
  const auto& axis = part_of(part_of(cluster_.document, "axes"), std::to_string(item.part));
  if (!drive_ || axis.empty()) return unavailable;
  switch (item.quantity) {
    case Quantity::position:
    case Quantity::angle:
      return number(member(axis, "actual"));
    case Quantity::position_commanded:
    case Quantity::angle_commanded:
      return number(member(axis, "commanded"));
    case Quantity::axis_feed:
    case Quantity::angular_velocity:
      return number(member(axis, "velocity"), 2);
    default:
      return number(100 * member(axis, "torque"), 1);
  }
}

std::optional<std::string> ValuesOf::of_spindle(const DataItem& item) const {
  if (item.quantity == Quantity::spindle_override) {
    if (cluster_.channels.empty()) return unavailable;
    return number(100 * cluster_.channels.begin()->second.spindle_override, 1);
  }
  const bool actual = item.quantity == Quantity::spindle_speed;
  const auto& source = part_of(cluster_.document, actual ? "drive" : "plc");
  const auto speeds = source.find("spindle_speed");
  if (!(actual ? drive_ : plc_) || speeds == source.end() || item.part >= speeds->size()) return unavailable;
  return number((*speeds)[item.part].get<double>(), 1);
}

std::optional<std::string> ValuesOf::of_channel(const DataItem& item) const {
  const auto found = cluster_.channels.find(static_cast<std::uint16_t>(item.part));
  const auto silent = silent_channels_.find(item.part);
  if (found == cluster_.channels.end() || (silent != silent_channels_.end() && silent->second))
    return unavailable;
  const auto& state = found->second;
  switch (item.quantity) {
    case Quantity::execution:
      return execution_of(state);
    case Quantity::controller_mode:
      return mode_of(state.mode);
    case Quantity::program:
      return state.program;
    case Quantity::line:
      return std::to_string(state.line);
    case Quantity::parts:
      return std::to_string(state.parts);
    case Quantity::path_feed:
      return number(state.feed / 60, 2);
    case Quantity::path_feed_programmed:
      return number(state.programmed_feed / 60, 2);
    case Quantity::feed_override:
      return number(100 * state.feed_override, 1);
    case Quantity::rapid_override:
      return number(100 * state.rapid_override, 1);
    case Quantity::path_position:
      return path_position(state);
    case Quantity::tool_number:
      return std::to_string(state.tool);
    case Quantity::tool_asset: {
      const bool known = cluster_.tools && std::ranges::any_of(cluster_.tools->tools, [&](const auto& tool) {
                           return tool.number == state.tool;
                         });
      return known ? "T" + std::to_string(state.tool) : std::string();
    }
    default:
      return work_offset_name(state.work_offset);
  }
}

std::optional<std::string> ValuesOf::of(const DataItem& item) const {
  switch (item.quantity) {
    case Quantity::availability:
      return cluster_.document.contains("cluster") ? "AVAILABLE" : unavailable;
    case Quantity::emergency_stop: {
      const auto& plc = part_of(cluster_.document, "plc");
      if (!plc_ || plc.empty()) return unavailable;
      return plc.value("emergency_stop", false) ? "TRIGGERED" : "ARMED";
    }
    case Quantity::asset_changed:
    case Quantity::asset_removed:
      return {};
    case Quantity::rotary_mode:
      return item.id.starts_with("spindle") ? "SPINDLE" : "CONTOUR";
    case Quantity::spindle_speed:
    case Quantity::spindle_speed_commanded:
    case Quantity::spindle_override:
      return of_spindle(item);
    default:
      break;
  }
  if (type_of(item.quantity).category == Category::condition) return {};
  return item.quantity >= Quantity::position ? of_axis(item) : of_channel(item);
}

std::vector<FoundCondition> conditions_of(const ClusterState& cluster,
                                          const std::map<std::uint32_t, std::uint32_t>& channel_of) {
  std::vector<FoundCondition> list;
  for (const auto& [key, alarm] : part_of(cluster.document, "alarms").items()) {
    FoundCondition found;
    const auto source = alarm.value("source", "");
    const auto instance = static_cast<std::uint32_t>(member(alarm, "instance")) % generation_step;
    const auto channel = channel_of.find(instance);
    if (source == "plc") found.quantity = Quantity::logic_program;
    if (source == "drive") found.quantity = Quantity::hardware;
    if (source == "channel" && channel != channel_of.end()) {
      found.quantity = Quantity::motion_program;
      found.part = channel->second;
    }
    found.code = key.substr(key.find('/') + 1);  // number/part; the same of two sources is one
    found.severity = alarm.value("severity", "");
    found.fault = found.severity == "ERROR" || found.severity == "EMERGENCY";
    found.text = alarm.value("text", "");
    list.push_back(std::move(found));
  }
  for (const auto& [instance, service] : part_of(cluster.document, "services").items()) {
    if (service.value("alive", false) || !service.value("expected", false)) continue;
    auto text = service.value("service", "");
    text.append(" (instance ").append(instance).append(") sends no heartbeat");
    list.push_back({Quantity::communications, 0, instance, "ERROR", std::move(text), true});
  }
  return list;
}

}  // namespace trunnion::gateway::mtconnect
