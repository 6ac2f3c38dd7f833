// SPDX-License-Identifier: Apache-2.0
#include "core/state_document.hpp"
#include "bus/contract.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::gateway {
namespace {

using bus::Json;

/// Display needs no more than a nanometre, and short numbers make short messages.
double rounded(double value) { return std::isfinite(value) ? std::round(value * 1e6) / 1e6 + 0.0 : 0.0; }

Json rounded_row(const std::vector<double>& row) {
  auto json = Json::array();
  for (const double value : row) json.push_back(rounded(value));
  return json;
}

}  // namespace

void StateDocument::apply(const idl::service::Announcement& announcement) {
  auto& known = services_[announcement.instance];
  known.announcement = announcement;
  known.announced = true;
  known.contract_matches = announcement.contract == bus::contract_of(announcement.service);
}

void StateDocument::apply(const idl::service::ServiceState& state, double now) {
  auto& known = services_[state.instance];
  if (known.beating && known.state.pid != state.pid)
    // Another process took the place: no process is left to clear what its predecessor had raised. What
    // arrived after the predecessor's last heartbeat may be the successor's and stays.
    std::erase_if(alarms_, [&](const auto& entry) {
      return std::get<0>(entry.first) == state.instance && entry.second.heard <= known.heard;
    });
  known.state = state;
  known.heard = now;
  known.beating = true;
}

void StateDocument::apply(const idl::service::Alarm& alarm, double now, const std::string& time) {
  const std::tuple key{alarm.instance, alarm.number, alarm.part};
  if (!alarm.active) {
    alarms_.erase(key);
    return;
  }
  auto& raised = alarms_[key];
  if (raised.since.empty()) raised.since = time;
  raised.alarm = alarm;
  raised.heard = now;
}

bool StateDocument::is_active(const idl::service::Alarm& alarm) const {
  return alarms_.contains({alarm.instance, alarm.number, alarm.part});
}

void StateDocument::apply(const idl::service::Cluster& cluster) {
  cluster_ = cluster;
  has_cluster_ = true;
}

void StateDocument::apply(const idl::channel::ChannelState& state) {
  channels_[state.channel] = state;
  if (has_feedback_) run_times_[state.channel].observe(state, feedback_.tick);
}

void StateDocument::apply(const idl::plc::Outputs& outputs) {
  auto channels = Json::array();
  for (const auto& control : outputs.channels) channels.push_back(bus::to_json(control));
  plc_ = {{"emergency_stop", outputs.emergency_stop},
          {"feed_hold", outputs.feed_hold},
          {"coolant", outputs.coolant},
          {"spindle_speed", outputs.spindle_speed},
          {"channels", std::move(channels)}};
}

void StateDocument::apply(const idl::stream::Feedback& feedback) {
  const std::size_t columns = feedback.axis_count;
  const std::size_t rows =
      columns == 0 ? 0 : std::min(feedback.actual.size(), feedback.commanded.size()) / columns;
  for (std::size_t row = 0; row < std::min<std::size_t>(feedback.count, rows); ++row) {
    commanded_.assign(&feedback.commanded[row * columns], &feedback.commanded[row * columns] + columns);
    actual_.assign(&feedback.actual[row * columns], &feedback.actual[row * columns] + columns);
    peak_.resize(columns, 0.0);
    for (std::size_t i = 0; i < columns; ++i) {
      const double error = commanded_[i] - actual_[i];
      if (std::abs(error) > std::abs(peak_[i])) peak_[i] = error;
    }
    trace_.add(feedback.first + row, actual_);
    executed_ = true;
  }
  if (!executed_) {
    commanded_ = actual_ = feedback.position;
    peak_.assign(feedback.position.size(), 0.0);
  }
  feedback_ = feedback;
  has_feedback_ = true;
}

void StateDocument::apply(const idl::measurement::MeasurementState& state) {
  measurement_ = bus::to_json(state);
}

void StateDocument::set_title(std::string title) { title_ = std::move(title); }

void StateDocument::set_drive_axes(std::vector<std::uint16_t> axes) { drive_axes_ = std::move(axes); }

void StateDocument::set_revision(const char* what, std::uint64_t revision) { revisions_[what] = revision; }

Json StateDocument::services(double now) const {
  auto json = Json::object();
  std::map<std::uint32_t, const idl::service::ClusterService*> expected;
  for (const auto& service : cluster_.services) expected[service.instance] = &service;
  static const Known nothing;
  static const idl::service::ClusterService unplanned;
  const auto add = [&](std::uint32_t instance, const Known& known,
                       const idl::service::ClusterService* wanted) {
    const auto& plan = wanted != nullptr ? *wanted : unplanned;
    const auto& state = known.state;
    const auto& announcement = known.announcement;
    const bool alive = known.beating && now - known.heard < heartbeat_timeout;
    auto& entry = json[std::to_string(instance)] = Json::object();
    // The newest of what is known: its heartbeat, else its announcement, else what the launcher expects.
    const auto newest = [&](const auto& beat, const auto& announced, const auto& planned) {
      return known.beating ? beat : known.announced ? announced : planned;
    };
    entry["service"] = newest(state.service, announcement.service, plan.service);
    entry["replica"] = known.beating ? state.replica : plan.replica;
    entry["vendor"] = newest(state.vendor, announcement.vendor, plan.vendor);
    entry["host"] = announcement.host;
    entry["pid"] = newest(state.pid, announcement.pid, plan.pid);
    entry["lifecycle"] = alive ? bus::to_string(state.lifecycle) : "ABSENT";
    entry["detail"] = alive ? state.detail : std::string("no heartbeat");
    entry["messages_per_second"] = alive ? std::round(state.messages_per_second) : 0.0;
    entry["cycles_lost"] = state.cycles_lost;
    entry["uptime"] = std::floor(state.uptime);
    entry["revision"] = state.revision;
    entry["in_step"] = state.in_step;
    entry["alive"] = alive;
    entry["expected"] = wanted != nullptr;
    entry["restarts"] = plan.restarts;
    entry["contract"] = announcement.contract;
    entry["contract_match"] = known.contract_matches;
  };
  for (const auto& [instance, known] : services_) {
    const auto wanted = expected.find(instance);
    const bool planned = wanted != expected.end();
    // Another process has its place, after a swap say: its silence is no fault. One of another contract has
    // only announced itself, and is shown.
    if (!planned && has_cluster_ && known.beating && now - known.heard >= heartbeat_timeout) continue;
    add(instance, known, planned ? wanted->second : nullptr);
  }
  for (const auto& [instance, wanted] : expected)
    if (!services_.contains(instance)) add(instance, nothing, wanted);
  return json;
}

Json StateDocument::alarms() const {
  auto json = Json::object();
  for (const auto& [key, raised] : alarms_) {
    const auto& [instance, number, part] = key;
    auto alarm = bus::to_json(raised.alarm);
    alarm.erase("active");
    alarm["since"] = raised.since;
    json[std::to_string(instance) + "/" + std::to_string(number) + "/" + std::to_string(part)] =
        std::move(alarm);
  }
  return json;
}

Json StateDocument::axes() {
  auto json = Json::object();
  for (std::size_t i = 0; i < std::min(actual_.size(), drive_axes_.size()); ++i) {
    const double error = commanded_[i] - actual_[i];
    auto& axis = json[std::to_string(drive_axes_[i])] = Json::object();
    axis["commanded"] = rounded(commanded_[i]);
    axis["actual"] = rounded(actual_[i]);
    axis["following_error"] = rounded(error);
    axis["following_peak"] = rounded(peak_[i]);
    axis["position"] = rounded(i < feedback_.position.size() ? feedback_.position[i] : actual_[i]);
    axis["velocity"] = rounded(i < feedback_.velocity.size() ? feedback_.velocity[i] : 0);
    axis["torque"] = rounded(i < feedback_.torque.size() ? feedback_.torque[i] : 0);
    axis["enabled"] = i < feedback_.enabled.size() && feedback_.enabled[i] != 0;
    peak_[i] = error;
  }
  return json;
}

Json StateDocument::run_times() {
  auto json = Json::object();
  if (!has_feedback_) return json;
  for (const auto& [number, state] : channels_) {
    auto& time = run_times_[number];
    time.observe(state, feedback_.tick);
    json[std::to_string(number)] = {{"ticks", time.ticks()}, {"partial", time.partial()}};
  }
  return json;
}

Json StateDocument::spindles() const {
  auto json = Json::array();
  for (const auto& spindle : feedback_.spindles)
    json.push_back(
        {{"condition", bus::to_string(spindle.condition)},
         {"homed", spindle.homed},
         {"angle",
          rounded(std::fmod(std::round((spindle.angle - std::floor(spindle.angle)) * 36000), 36000) / 100)},
         {"gear", spindle.gear},
         {"reference", rounded(std::round(spindle.reference * 100) / 100)},
         {"master", spindle.master},
         {"synchronization_error", rounded(std::round(spindle.synchronization_error * 360000) / 1000)},
         {"correction", rounded(std::round(spindle.correction * 100) / 100)}});
  return json;
}

Json StateDocument::document(double now) {
  auto json = Json::object();
  if (has_cluster_)
    json["cluster"] = {
        {"domain", cluster_.domain}, {"machine", cluster_.machine},           {"title", title_},
        {"ready", cluster_.ready},   {"virtual_time", cluster_.virtual_time}, {"lead", cluster_.lead}};
  json["services"] = services(now);
  json["alarms"] = alarms();
  auto& channels = json["channels"] = Json::object();
  for (const auto& [number, state] : channels_) channels[std::to_string(number)] = bus::to_json(state);
  json["run_times"] = run_times();
  json["axes"] = axes();
  if (has_feedback_) {
    json["drive"] = {{"executed", feedback_.first + feedback_.count},
                     {"tick", feedback_.tick},
                     {"mode", bus::to_string(feedback_.mode)},
                     {"starved", feedback_.starved},
                     {"spindle_speed", rounded_row(feedback_.spindle_speed)}};
    if (!feedback_.spindles.empty()) json["drive"]["spindles"] = spindles();
  }
  if (!plc_.is_null()) json["plc"] = plc_;
  if (!measurement_.is_null()) json["measurement"] = measurement_;
  if (!trace_.empty() && !drive_axes_.empty()) {
    auto rows = Json::array();
    for (const auto& row : trace_.rows()) rows.push_back(rounded_row(row));
    auto since = Json::array();
    for (const auto cycle : trace_.cycles()) since.push_back(cycle - trace_.first());
    trace_document_ = {{"first", trace_.first()},
                       {"since", std::move(since)},
                       {"axes", drive_axes_},
                       {"rows", std::move(rows)}};
  }
  trace_.clear();
  if (!trace_document_.is_null()) json["trace"] = trace_document_;
  json["revisions"] = revisions_;
  return json;
}

const idl::channel::ChannelState* StateDocument::channel(std::uint16_t number) const {
  const auto found = channels_.find(number);
  return found == channels_.end() ? nullptr : &found->second;
}

}  // namespace trunnion::gateway
