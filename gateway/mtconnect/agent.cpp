// SPDX-License-Identifier: Apache-2.0
#include "mtconnect/agent.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mtconnect/values.hpp"

namespace trunnion::gateway::mtconnect {
namespace {

using bus::Json;

MachineShape shape_of(const AgentSettings& settings, const ClusterState& cluster) {
  const auto& parameters = *cluster.values;
  MachineShape shape;
  shape.name = settings.machine;
  shape.title = settings.title;
  shape.uuid = settings.machine + "." + settings.computer;
  shape.axes = machine::drive_axes(parameters);
  shape.spindles = machine::spindles(parameters);
  for (const auto& [number, state] : cluster.channels) {
    auto name = state.name;
    if (name.empty()) name = std::string("channel") + std::to_string(number);
    shape.channels.push_back({number, std::move(name)});
  }
  return shape;
}

bool same(const ToolAsset& a, const ToolAsset& b) {
  return a.length == b.length && a.diameter == b.diameter && a.name == b.name && a.removed == b.removed;
}

}  // namespace

void Agent::rebuild(const ClusterState& cluster, const std::string& time) {
  auto device = device_of(shape_of(settings_, cluster));
  if (device_ && *device_ == device) return;
  if (device_) ++rebuilt_;  // its sequence numbers begin again
  device_ = std::move(device);
  items_ = items_of(*device_);
  std::vector<bool> conditions;
  for (const auto* item : items_)
    conditions.push_back(type_of(item->quantity).category == Category::condition);
  values_.assign(items_.size(), "");
  active_.clear();
  model_changed_ = time;
  buffer_.emplace(settings_.buffer_size, conditions);
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (conditions[i]) {
      Observation normal;
      normal.item = i;
      normal.time = time;
      buffer_->add(std::move(normal));
    } else {
      set(i, unavailable, time);
    }
}

void Agent::set(std::uint32_t item, const std::string& value, const std::string& time) {
  if (values_[item] == value) return;
  values_[item] = value;
  Observation observation;
  observation.item = item;
  observation.time = time;
  observation.value = value;
  buffer_->add(std::move(observation));
}

void Agent::observe(const ClusterState& cluster, const std::string& time) {
  if (!cluster.parameters || cluster.channels.size() < settings_.channels) return;
  if (!device_ || cluster.parameters->revision != revision_) rebuild(cluster, time);
  revision_ = cluster.parameters->revision;
  const ValuesOf values(cluster, settings_.channel_of);
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (const auto value = values.of(*items_[i])) set(i, *value, time);
  observe_tools(cluster, time);
  observe_conditions(cluster, time);
}

void Agent::observe_tools(const ClusterState& cluster, const std::string& time) {
  if (!cluster.tools || cluster.tools == table_) return;
  const bool first = table_ == nullptr;
  table_ = cluster.tools;
  const auto report = [&](Quantity quantity, const ToolAsset& tool) {
    for (std::uint32_t i = 0; i < items_.size(); ++i)
      if (!first && items_[i]->quantity == quantity) {
        values_[i].clear();  // the same tool may change twice
        set(i, tool.id(), time);
      }
  };
  std::set<std::uint32_t> present;
  for (const auto& row : table_->tools) {
    present.insert(row.number);
    ToolAsset tool{
        row.number, row.length + row.length_wear, 2 * (row.radius + row.radius_wear), row.name, time, false};
    auto& known = tools_[row.number];
    if (known.number == row.number && same(known, tool)) continue;
    known = std::move(tool);
    report(Quantity::asset_changed, known);
  }
  for (auto& [number, tool] : tools_) {
    if (tool.removed || present.contains(number)) continue;
    tool.removed = true;
    tool.time = time;
    report(Quantity::asset_removed, tool);
  }
  for (auto one = tools_.begin(); tools_.size() > most_assets && one != tools_.end();)
    one = one->second.removed ? tools_.erase(one) : std::next(one);
}

void Agent::observe_conditions(const ClusterState& cluster, const std::string& time) {
  std::map<std::pair<std::uint32_t, std::string>, Active> now;
  const auto item_of = [&](const FoundCondition& found) -> std::optional<std::uint32_t> {
    for (std::uint32_t i = 0; i < items_.size(); ++i)
      if (items_[i]->quantity == found.quantity && items_[i]->part == found.part) return i;
    return {};
  };
  for (const auto& found : conditions_of(cluster, settings_.channel_of))
    if (const auto item = item_of(found))
      now[{*item, found.code}] = {found.fault ? Level::fault : Level::warning, found.text, found.severity};
  for (const auto& [key, before] : active_)
    if (!now.contains(key)) buffer_->add({0, key.first, time, "", Level::normal, key.second, ""});
  for (const auto& [key, active] : now) {
    const auto before = active_.find(key);
    if (before != active_.end() && before->second == active) continue;
    buffer_->add({0, key.first, time, active.text, active.level, key.second, active.severity});
  }
  active_ = std::move(now);
}

const Device& Agent::known_device() const {
  if (!device_)
    throw RequestError(503, "INTERNAL_ERROR",
                       "the machine has not published its parameters and channels yet");
  return *device_;
}

AgentHeader Agent::header(const std::string& now) const {
  AgentHeader header;
  header.instance = settings_.instance + rebuilt_;
  header.sender = settings_.computer;
  header.now = now;
  header.model_changed = device_ ? model_changed_ : now;
  header.buffer_size = settings_.buffer_size;
  for (const auto& [number, tool] : tools_) header.assets += tool.removed ? 0 : 1;
  return header;
}

Request Agent::parse(std::string_view method, std::string_view target) const {
  return parse_request(method, target, settings_.machine, settings_.machine + "." + settings_.computer,
                       settings_.buffer_size);
}

std::string Agent::error(const RequestError& error, const std::string& now) const {
  return error_document(header(now), error);
}

std::string Agent::answer(const Request& request, const std::string& now) const {
  const auto& device = known_device();
  if (request.kind == Kind::probe) return devices_document(header(now), device);
  if (request.kind == Kind::assets) return assets(request, now);
  if (request.kind == Kind::current && request.at &&
      (*request.at < buffer_->first() || *request.at > buffer_->last()))
    throw RequestError(400, "OUT_OF_RANGE",
                       "at must be " + std::to_string(buffer_->first()) + " .. " +
                           std::to_string(buffer_->last()) + ", not " + std::to_string(*request.at));
  return part(request, request.from.value_or(request.count < 0 ? buffer_->last() : buffer_->first()), now)
      .document;
}

Agent::Part Agent::part(const Request& request, std::uint64_t from, const std::string& now) const {
  const auto& device = known_device();
  std::set<std::uint32_t> wanted;
  if (!request.path.empty()) wanted = items_at(device, request.path);
  const auto is_wanted = [&](const Observation& one) { return wanted.empty() || wanted.contains(one.item); };
  const auto first = buffer_->first(), next = buffer_->next();
  std::vector<const Observation*> list;
  Part part;
  part.next = next;
  if (request.kind == Kind::current) {
    const auto then = request.at ? buffer_->state(*request.at) : State();
    for (const auto* one : (request.at ? then : buffer_->newest()).all())
      if (is_wanted(*one)) list.push_back(one);
    part.any = !list.empty();
    part.document = streams_document(header(now), device, list, first, buffer_->last(), next);
    return part;
  }
  if (from < first || from > next)
    throw RequestError(400, "OUT_OF_RANGE",
                       "from must be " + std::to_string(first) + " .. " + std::to_string(next) + ", not " +
                           std::to_string(from));
  const auto most = static_cast<std::size_t>(std::abs(request.count));
  if (request.count > 0) {
    auto at = from;
    for (; at < next && list.size() < most; ++at)
      if (is_wanted(buffer_->at(at))) list.push_back(&buffer_->at(at));
    part.next = at;
  } else {
    auto at = std::min(from, buffer_->last());
    for (; at >= first && list.size() < most; --at)
      if (is_wanted(buffer_->at(at))) list.push_back(&buffer_->at(at));
    std::ranges::reverse(list);
    part.next = list.empty() ? from : list.back()->sequence + 1;
  }
  part.any = !list.empty();
  part.document = streams_document(header(now), device, list, first, buffer_->last(), part.next);
  return part;
}

std::string Agent::assets(const Request& request, const std::string& now) const {
  std::vector<ToolAsset> list;
  for (const auto& id : request.assets) {
    const auto found = std::ranges::find_if(tools_, [&](const auto& one) { return one.second.id() == id; });
    if (found == tools_.end()) throw RequestError(404, "ASSET_NOT_FOUND", "there is no asset '" + id + "'");
    list.push_back(found->second);
  }
  if (request.assets.empty() && (request.type.empty() || request.type == "CuttingTool"))
    for (const auto& [number, tool] : tools_)
      if ((request.removed || !tool.removed) && list.size() < static_cast<std::size_t>(request.count))
        list.push_back(tool);
  return assets_document(header(now), known_device(), list);
}

}  // namespace trunnion::gateway::mtconnect
