// SPDX-License-Identifier: Apache-2.0
#include "verification/shown_state.hpp"

#include <algorithm>
#include <cmath>

#include "bus/codec.hpp"
#include "bus/contract.hpp"
#include "contracts/topics.hpp"
#include "machine/axes.hpp"

namespace trunnion::verification {
namespace {

using bus::Json;

constexpr double rounding = 0.51e-6;  // mm or deg: the document is rounded to a millionth

// Of a service's entry: what a missing heartbeat changes.
constexpr const char* by_heartbeat[] = {"lifecycle", "detail", "messages_per_second", "alive"};

// As a document that has been sent: bytes that are not UTF-8 replaced, and no number that JSON does not have.
Json as_sent(const Json& json) { return Json::parse(bus::text_of(json)); }

double at(const std::vector<double>& values, std::size_t i, double otherwise) {
  return i < values.size() ? values[i] : otherwise;
}

template <class T>
bool is(const StoredMessage& message, const char* handle, T& value) {
  return message.topic->handle == handle && bus::decode(message.cdr, value);
}

// The angle is shown in hundredths of a degree, from 0 up to 359.99, speeds in hundredths of 1/min, the
// synchronization error in thousandths of a degree.
Json shown(const idl::stream::SpindleState& spindle) {
  const auto turn = spindle.angle - std::floor(spindle.angle);
  return {{"condition", bus::to_string(spindle.condition)},
          {"homed", spindle.homed},
          {"angle", std::fmod(std::round(turn * 36000), 36000) / 100},
          {"gear", spindle.gear},
          {"reference", std::round(spindle.reference * 100) / 100},
          {"master", spindle.master},
          {"synchronization_error", std::round(spindle.synchronization_error * 360000) / 1000},
          {"correction", std::round(spindle.correction * 100) / 100}};
}

}  // namespace

bool is_shown(const bus::TopicEntry& topic) {
  static const std::set<std::string> handles = {
      "announcement",      "service_state",     "alarm",        "cluster",      "channel_state", "feedback",
      "plc_outputs",       "tool_table",        "work_offsets", "program_list", "parameter_set", "plc_image",
      "measurement_state", "measurement_result"};
  return handles.contains(topic.handle);
}

void ShownState::observe(const StoredMessage& message) {
  idl::service::Announcement announcement;
  idl::service::ServiceState state;
  idl::service::Alarm alarm;
  idl::channel::ChannelState channel;
  idl::stream::Feedback feedback;
  idl::plc::Outputs outputs;
  idl::parameters::ParameterSet set;
  idl::parameters::ToolTable tools;
  idl::parameters::WorkOffsets offsets;
  idl::measurement::MeasurementState measurement;
  idl::measurement::MeasurementResult result;
  idl::program::ProgramList programs;
  idl::plc::Image image;
  if (is(message, "announcement", announcement)) {
    announced_[announcement.instance] = announcement;
  } else if (is(message, "service_state", state)) {
    beat(state);
  } else if (is(message, "alarm", alarm)) {
    const std::tuple key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active)
      alarms_[key] = {alarm, false};
    else
      alarms_.erase(key);
  } else if (is(message, "cluster", plan_)) {
    cluster_ = {{"domain", plan_.domain},
                {"machine", plan_.machine},
                {"ready", plan_.ready},
                {"virtual_time", plan_.virtual_time},
                {"lead", plan_.lead}};
  } else if (is(message, "channel_state", channel)) {
    channels_[channel.channel] = bus::to_json(channel);
  } else if (is(message, "feedback", feedback)) {
    const std::size_t width = feedback.axis_count;
    const auto whole = [&](const std::vector<double>& rows) { return width == 0 ? 0 : rows.size() / width; };
    const std::size_t rows = std::min(
        {static_cast<std::size_t>(feedback.count), whole(feedback.actual), whole(feedback.commanded)});
    if (rows > 0) {
      const auto row = [&](const std::vector<double>& values) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>((rows - 1) * width);
        return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(width));
      };
      commanded_ = row(feedback.commanded);
      actual_ = row(feedback.actual);
      executed_ = true;
    } else if (!executed_) {
      commanded_ = actual_ = feedback.position;
    }
    drive_ = {{"executed", feedback.first + feedback.count},
              {"tick", feedback.tick},
              {"mode", bus::to_string(feedback.mode)},
              {"starved", feedback.starved},
              {"spindle_speed", feedback.spindle_speed}};
    for (const auto& spindle : feedback.spindles) drive_["spindles"].push_back(shown(spindle));
    feedback_ = std::move(feedback);
  } else if (is(message, "plc_outputs", outputs)) {
    auto channels = Json::array();
    for (const auto& control : outputs.channels) channels.push_back(bus::to_json(control));
    plc_ = {{"emergency_stop", outputs.emergency_stop},
            {"feed_hold", outputs.feed_hold},
            {"coolant", outputs.coolant},
            {"spindle_speed", outputs.spindle_speed},
            {"channels", std::move(channels)}};
  } else if (is(message, "parameter_set", set)) {
    revisions_["parameters"] = set.revision;
    revisions_["pending"] = set.pending.size();
    columns_.clear();
    for (const auto& axis : machine::drive_axes(machine::parameters_of(set))) columns_.push_back(axis.number);
  } else if (is(message, "tool_table", tools)) {
    revisions_["tools"] = tools.revision;
    newest_["/api/tools"] = bus::to_json(tools);
  } else if (is(message, "work_offsets", offsets)) {
    revisions_["work_offsets"] = offsets.revision;
    newest_["/api/work-offsets"] = bus::to_json(offsets);
  } else if (is(message, "program_list", programs)) {
    revisions_["programs"] = programs.revision;
    newest_["/api/programs"] = bus::to_json(programs);
  } else if (is(message, "measurement_state", measurement)) {
    measurement_ = bus::to_json(measurement);
  } else if (is(message, "measurement_result", result)) {
    measurement_result_ = bus::to_json(result);
  } else if (is(message, "plc_image", image)) {
    newest_["/api/plc/image"] = bus::to_json(image);
  }
}

// A new process in the place of another takes the alarms away that the other has left.
void ShownState::beat(const idl::service::ServiceState& state) {
  const auto before = beats_.find(state.instance);
  const bool other = before != beats_.end() && before->second.pid != state.pid;
  for (auto entry = alarms_.begin(); entry != alarms_.end();) {
    auto& [key, raised] = *entry;
    const bool own = std::get<0>(key) == state.instance;
    const bool left = own && other && raised.before_beat;
    if (own) raised.before_beat = true;
    entry = left ? alarms_.erase(entry) : std::next(entry);
  }
  beats_[state.instance] = state;
}

Json ShownState::services() const {
  std::map<std::uint32_t, Json> entries;
  const auto identity = [&](std::uint32_t instance, const auto& from) {
    auto& entry = entries[instance];
    entry["service"] = from.service;
    entry["vendor"] = from.vendor;
    entry["pid"] = from.pid;
    return &entry;
  };
  // The later of the three knows better.
  for (const auto& service : plan_.services)
    (*identity(service.instance, service))["replica"] = service.replica;
  for (const auto& [instance, announcement] : announced_) identity(instance, announcement);
  for (const auto& [instance, state] : beats_) (*identity(instance, state))["replica"] = state.replica;
  auto json = Json::object();
  for (auto& [instance, entry] : entries) {
    const auto planned = std::find_if(plan_.services.begin(), plan_.services.end(),
                                      [&, i = instance](const auto& s) { return s.instance == i; });
    const auto beat = beats_.find(instance);
    const auto state = beat != beats_.end() ? beat->second : idl::service::ServiceState{};
    const auto said = announced_.find(instance);
    const auto announcement = said != announced_.end() ? said->second : idl::service::Announcement{};
    if (!entry.contains("replica")) entry["replica"] = 0;
    entry["host"] = announcement.host;
    entry["cycles_lost"] = state.cycles_lost;
    entry["uptime"] = std::floor(state.uptime);
    entry["revision"] = state.revision;
    entry["in_step"] = state.in_step;
    entry["expected"] = planned != plan_.services.end();
    entry["restarts"] = planned != plan_.services.end() ? planned->restarts : 0;
    entry["contract"] = announcement.contract;
    entry["contract_match"] =
        said == announced_.end() || announcement.contract == bus::contract_of(announcement.service);
    json[std::to_string(instance)] = std::move(entry);
  }
  return json;
}

Json ShownState::axes() const {
  auto json = Json::object();
  for (std::size_t i = 0; i < std::min(actual_.size(), columns_.size()); ++i)
    json[std::to_string(columns_[i])] = {
        {"commanded", commanded_[i]},
        {"actual", actual_[i]},
        {"following_error", commanded_[i] - actual_[i]},
        {"position", at(feedback_.position, i, actual_[i])},
        {"velocity", at(feedback_.velocity, i, 0)},
        {"torque", at(feedback_.torque, i, 0)},
        {"enabled", i < feedback_.enabled.size() && feedback_.enabled[i] != 0}};
  return json;
}

Json ShownState::document() const {
  auto json = Json::object();
  if (!cluster_.is_null()) json["cluster"] = cluster_;
  json["services"] = services();
  auto& alarms = json["alarms"] = Json::object();
  for (const auto& [key, raised] : alarms_) {
    const auto& [instance, number, part] = key;
    auto alarm = bus::to_json(raised.alarm);
    alarm.erase("active");
    alarms[std::to_string(instance) + "/" + std::to_string(number) + "/" + std::to_string(part)] =
        std::move(alarm);
  }
  auto& channels = json["channels"] = Json::object();
  for (const auto& [number, state] : channels_) channels[std::to_string(number)] = state;
  json["axes"] = axes();
  if (!drive_.is_null()) json["drive"] = drive_;
  if (!plc_.is_null()) json["plc"] = plc_;
  if (!measurement_.is_null()) json["measurement"] = measurement_;
  auto& revisions = json["revisions"] = Json::object();
  for (const auto& [what, revision] : revisions_) revisions[what] = revision;
  return as_sent(json);
}

std::map<std::string, Json> ShownState::answers() const {
  std::map<std::string, Json> answers;
  for (const auto& [path, answer] : newest_) answers[path] = as_sent(answer);
  if (!measurement_.is_null()) {
    Json measurement = {{"state", measurement_}};
    if (!measurement_result_.is_null()) measurement["result"] = measurement_result_;
    answers["/api/measurement"] = as_sent(measurement);
  }
  auto list = Json::array();
  for (const auto& [number, state] : channels_) list.push_back(state);
  answers["/api/channels"] = as_sent({{"channels", std::move(list)}});
  return answers;
}

namespace {
bool is_planned(const Json& service) {
  if (!service.is_object()) return true;
  const auto expected = service.find("expected");
  return expected == service.end() || !expected->is_boolean() || expected->get<bool>();
}
}  // namespace

void take_out_clock(Json& document, std::uint32_t instance) {
  if (!document.is_object()) return;
  document.erase("trace");
  document.erase("run_times");
  if (const auto cluster = document.find("cluster"); cluster != document.end() && cluster->is_object())
    cluster->erase("title");
  const auto own = std::to_string(instance);
  if (const auto services = document.find("services"); services != document.end() && services->is_object()) {
    services->erase(own);
    // A process that the launcher does not name is shown only while it has a heartbeat.
    for (auto entry = services->begin(); document.contains("cluster") && entry != services->end();)
      entry = is_planned(*entry) ? std::next(entry) : services->erase(entry);
    for (auto& service : *services)
      if (service.is_object())
        for (const char* field : by_heartbeat) service.erase(field);
  }
  if (const auto alarms = document.find("alarms"); alarms != document.end() && alarms->is_object()) {
    Json kept = Json::object();
    for (auto& [key, alarm] : alarms->items()) {
      if (key.starts_with(own + "/")) continue;
      if (alarm.is_object()) alarm.erase("since");
      kept[key] = alarm;
    }
    *alarms = std::move(kept);
  }
  if (const auto axes = document.find("axes"); axes != document.end() && axes->is_object())
    for (auto& axis : *axes)
      if (axis.is_object()) axis.erase("following_peak");
}

std::string shown_difference(const Json& expected, const Json& shown, const std::string& path) {
  const auto differs = [&](const std::string& what) {
    return (path.empty() ? "document" : path) + ": " + what;
  };
  const auto below = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  if (expected.is_object() && shown.is_object()) {
    for (const auto& [name, value] : expected.items()) {
      if (!shown.contains(name)) return differs(name + " is not shown");
      if (auto found = shown_difference(value, shown[name], below(name)); !found.empty()) return found;
    }
    for (const auto& [name, value] : shown.items())
      if (!expected.contains(name)) return differs(name + " is shown, but no topic has it");
    return "";
  }
  if (expected.is_array() && shown.is_array() && expected.size() == shown.size()) {
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (auto found = shown_difference(expected[i], shown[i], below(std::to_string(i))); !found.empty())
        return found;
    return "";
  }
  if (expected == shown) return "";
  const bool is_rounded = path.starts_with("axes.") || path.starts_with("drive.");
  if (is_rounded && expected.is_number_float() && shown.is_number() &&
      std::abs(expected.get<double>() - shown.get<double>()) <= rounding)
    return "";
  return differs("expected " + bus::text_of(expected) + ", shown " + bus::text_of(shown));
}

}  // namespace trunnion::verification
