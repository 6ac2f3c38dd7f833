// SPDX-License-Identifier: Apache-2.0
#include "core/alarm_history.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "text/utf8.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;
using idl::service::Alarm;

std::string line_of(const PastAlarm& past) {
  auto json = bus::to_json(past.alarm);
  json.erase("active");
  json["id"] = past.id;
  json["raised"] = past.raised;
  json["cleared"] = past.cleared;
  return bus::text_of(json) + "\n";
}

template <class Enum>
Enum named(const Json& json, const char* field) {
  const auto value = bus::from_string<Enum>(json.at(field).get<std::string>());
  return value.value();
}

template <class Whole>
Whole whole(const Json& json, const char* field) {
  const auto& value = json.at(field);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<Whole>::max())
    throw std::runtime_error(std::string(field) + " is no number of its range");
  return value.get<Whole>();
}

// Throws when it is not what line_of() writes.
PastAlarm parsed(const std::string& line) {
  const auto json = Json::parse(line);
  PastAlarm past;
  past.id = whole<std::uint64_t>(json, "id");
  past.raised = json.at("raised").get<std::string>();
  past.cleared = json.at("cleared").get<std::string>();
  auto& alarm = past.alarm;
  alarm.active = past.cleared.empty();
  alarm.instance = whole<std::uint32_t>(json, "instance");
  alarm.number = whole<std::uint32_t>(json, "number");
  alarm.part = whole<std::uint32_t>(json, "part");
  alarm.severity = named<idl::service::Severity>(json, "severity");
  alarm.reaction = named<idl::service::Reaction>(json, "reaction");
  alarm.source = json.at("source").get<std::string>();
  alarm.text = json.at("text").get<std::string>();
  alarm.cycle = whole<std::uint64_t>(json, "cycle");
  alarm.occurrences = whole<std::uint32_t>(json, "occurrences");
  return past;
}

}  // namespace

PastAlarm* AlarmHistory::active(const Alarm& alarm) {
  // A service that was started anew has another instance and raises what it finds again: the same alarm.
  const auto same = [&](const PastAlarm& past) {
    return past.cleared.empty() && past.alarm.number == alarm.number && past.alarm.part == alarm.part &&
           (past.alarm.instance == alarm.instance ||
            (past.alarm.source == alarm.source && std::ranges::find(restored_, past.id) != restored_.end()));
  };
  const auto found = std::find_if(alarms_.rbegin(), alarms_.rend(), same);
  return found == alarms_.rend() ? nullptr : &*found;
}

void AlarmHistory::changed(const PastAlarm& past) {
  lines_ += line_of(past);
  newest_.reset();
}

void AlarmHistory::clear(PastAlarm& past, const std::string& time) {
  past.cleared = time;
  past.alarm.active = false;
  changed(past);
}

void AlarmHistory::apply(const Alarm& alarm, const std::string& time) {
  auto* past = active(alarm);
  if (past != nullptr) std::erase(restored_, past->id);
  if (!alarm.active) {
    if (past != nullptr) clear(*past, time);
    return;
  }
  if (past != nullptr) {
    // How often it was raised again is written with its end.
    past->alarm = alarm;
    newest_.reset();
    return;
  }
  if (alarms_.size() == most) alarms_.pop_front();
  alarms_.push_back({next_++, alarm, time, ""});
  changed(alarms_.back());
}

void AlarmHistory::keep(const std::function<bool(const Alarm&)>& is_active, const std::string& time) {
  for (auto& past : alarms_) {
    if (!past.cleared.empty() || std::ranges::find(restored_, past.id) != restored_.end()) continue;
    if (!is_active(past.alarm)) clear(past, time);
  }
}

void AlarmHistory::settle(const std::string& time) {
  for (auto& past : alarms_)
    if (past.cleared.empty() && std::ranges::find(restored_, past.id) != restored_.end()) clear(past, time);
  restored_.clear();
}

std::size_t AlarmHistory::restore(const std::string& lines) {
  std::size_t damaged = 0;
  for (std::size_t from = 0; from < lines.size();) {
    const auto end = std::min(lines.find('\n', from), lines.size());
    try {
      auto past = parsed(lines.substr(from, end - from));
      const auto known = std::ranges::find(alarms_, past.id, &PastAlarm::id);
      next_ = std::max(next_, past.id + 1);
      if (known != alarms_.end())
        *known = std::move(past);
      else
        alarms_.push_back(std::move(past));
      if (alarms_.size() > most) alarms_.pop_front();
    } catch (const std::exception&) {
      ++damaged;
    }
    from = end + 1;
  }
  restored_.clear();
  for (const auto& past : alarms_)
    if (past.cleared.empty()) restored_.push_back(past.id);
  newest_.reset();
  return damaged;
}

std::string AlarmHistory::take_lines() { return std::exchange(lines_, {}); }

std::string AlarmHistory::lines() const {
  std::string text;
  for (const auto& past : alarms_) text += line_of(past);
  return text;
}

std::shared_ptr<const PastAlarms> AlarmHistory::newest() const {
  if (!newest_) newest_ = std::make_shared<const PastAlarms>(alarms_.rbegin(), alarms_.rend());
  return newest_;
}

Json past_alarm_document(const PastAlarm& past) {
  auto json = bus::to_json(past.alarm);
  json.erase("active");
  json["raised"] = past.raised;
  if (!past.cleared.empty()) json["cleared"] = past.cleared;
  return json;
}

bool matches(const PastAlarm& past, const std::string& search) {
  if (search.empty()) return true;
  const auto wanted = text::lower_case(search);
  return std::to_string(past.alarm.number).find(wanted) != std::string::npos ||
         text::lower_case(past.alarm.text).find(wanted) != std::string::npos ||
         text::lower_case(past.alarm.source).find(wanted) != std::string::npos;
}

}  // namespace trunnion::gateway
