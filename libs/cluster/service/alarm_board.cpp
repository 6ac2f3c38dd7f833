// SPDX-License-Identifier: Apache-2.0
#include "service/alarm_board.hpp"

#include <utility>

#include "text/utf8.hpp"

namespace trunnion::service {
namespace {

constexpr std::size_t longest_text = 256;  // as in idl/service.idl

}  // namespace

AlarmBoard::AlarmBoard(bus::Bus& bus, std::uint32_t instance, std::string service)
    : instance_(instance), service_(std::move(service)), writer_(bus.writer(topics::alarm)) {}

void AlarmBoard::publish(Entry& entry) {
  if (!muted_) writer_.write(entry.alarm);
}

void AlarmBoard::unmute() {
  muted_ = false;
  for (auto& [key, entry] : entries_)
    if (entry.alarm.active) publish(entry);
}

void AlarmBoard::raise(const machine::AlarmDefinition& alarm, std::uint32_t part, const std::string& text,
                       std::uint64_t cycle) {
  auto& entry = entries_[{alarm.number, part}];
  auto shown = text::shortened(text, longest_text);
  const bool news = !entry.alarm.active || entry.alarm.text != shown;
  entry.cause = true;
  if (!news) return;
  auto& a = entry.alarm;
  a.instance = instance_, a.number = alarm.number, a.part = part;
  a.severity = static_cast<idl::service::Severity>(alarm.severity);
  a.reaction = static_cast<idl::service::Reaction>(alarm.reaction);
  a.source = service_, a.text = std::move(shown), a.cycle = cycle;
  a.active = true;
  ++a.occurrences;
  entry.subject = alarm.subject;
  publish(entry);
}

void AlarmBoard::report(const machine::AlarmDefinition& alarm, std::uint32_t part, const std::string& text,
                        std::uint64_t cycle) {
  clear(alarm, part);
  raise(alarm, part, text, cycle);
  release(alarm, part);
}

void AlarmBoard::release(const machine::AlarmDefinition& alarm, std::uint32_t part) {
  const auto found = entries_.find({alarm.number, part});
  if (found != entries_.end()) found->second.cause = false;
}

void AlarmBoard::clear(const machine::AlarmDefinition& alarm, std::uint32_t part) {
  const auto found = entries_.find({alarm.number, part});
  if (found == entries_.end() || !found->second.alarm.active) return;
  found->second.alarm.active = false;
  found->second.cause = false;
  publish(found->second);
}

void AlarmBoard::reset() {
  reset([](machine::Subject, std::uint32_t) { return true; });
}

void AlarmBoard::reset(const std::function<bool(machine::Subject, std::uint32_t)>& concerned) {
  for (auto& [key, entry] : entries_)
    if (entry.alarm.active && !entry.cause && concerned(entry.subject, key.second)) {
      entry.alarm.active = false;
      publish(entry);
    }
}

bool AlarmBoard::active(const machine::AlarmDefinition& alarm, std::uint32_t part) const {
  const auto found = entries_.find({alarm.number, part});
  return found != entries_.end() && found->second.alarm.active;
}

bool AlarmBoard::any() const {
  for (const auto& [key, entry] : entries_)
    if (entry.alarm.active) return true;
  return false;
}

}  // namespace trunnion::service
