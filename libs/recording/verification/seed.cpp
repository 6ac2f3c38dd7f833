// SPDX-License-Identifier: Apache-2.0
#include "verification/seed.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bus/codec.hpp"

namespace trunnion::verification {
namespace {

using idl::service::ServiceSnapshot;
using idl::service::SnapshotKind;

constexpr auto forever = std::numeric_limits<std::uint64_t>::max();

bool is_needed_to_start(const bus::TopicEntry& topic) {
  for (const auto* handle : {"parameter_set", "tool_table", "work_offsets", "program_list", "stage_progress"})
    if (topic.handle == handle) return true;
  return false;
}

// When each process of the instance was heard of first, in the order of time.
std::map<std::uint64_t, std::int32_t> processes_of(const StoredRecording& recording, std::uint32_t instance) {
  std::map<std::int32_t, std::uint64_t> first;
  const auto note = [&](std::uint32_t number, std::int32_t pid, std::uint64_t time) {
    if (number != instance) return;
    const auto [known, news] = first.try_emplace(pid, time);
    if (!news) known->second = std::min(known->second, time);
  };
  idl::service::Announcement announcement;
  idl::service::ServiceState state;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "announcement" && bus::decode(message.cdr, announcement))
      note(announcement.instance, announcement.pid, message.time);
    else if (message.topic->handle == "service_state" && bus::decode(message.cdr, state))
      note(state.instance, state.pid, message.time);
  std::map<std::uint64_t, std::int32_t> lives;
  for (const auto& [pid, time] : first) lives[time] = pid;
  return lives;
}

Seed seed_of(snapshot::Snapshot snapshot, const std::map<std::uint64_t, std::int32_t>& lives) {
  Seed seed;
  seed.time = snapshot.head.time;
  const auto next = lives.upper_bound(seed.time);
  seed.until = next == lives.end() ? forever : next->first;
  for (const auto& [first, pid] : lives)
    if (pid == snapshot.head.pid) seed.begin = first;
  for (const auto& input : snapshot.head.taken)
    if (const auto* topic = bus::find_topic(input.topic)) seed.taken[topic] = input.time;
  seed.snapshot = std::move(snapshot);
  return seed;
}

}  // namespace

bool Seed::had_taken(const StoredMessage& message) const {
  const auto newest = taken.find(message.topic);
  // An event does not reach a process that was not there yet: it is in the state of the one before, or lost.
  if (message.topic->qos == bus::QosKind::event && message.time < begin) return true;
  return message.time <= (newest == taken.end() ? time : newest->second);
}

std::vector<const StoredMessage*> Seed::needed_to_start(const StoredRecording& recording,
                                                        bool older_parameters) const {
  std::vector<const StoredMessage*> needed;
  std::map<std::pair<const bus::TopicEntry*, bus::KeyHash>, const StoredMessage*> newest;
  for (const auto& message : recording.messages) {
    if (!is_needed_to_start(*message.topic) || !had_taken(message)) continue;
    bus::KeyHash key{};
    const auto& description = message.topic->description;
    if (description.keyed && !description.key_of(message.cdr, key)) continue;
    if (older_parameters && message.topic->handle == "parameter_set") needed.push_back(&message);
    auto& kept = newest[{message.topic, key}];
    if (kept == nullptr || kept->time <= message.time) kept = &message;
  }
  for (const auto& [key, message] : newest)
    if (!older_parameters || message->topic->handle != "parameter_set") needed.push_back(message);
  std::stable_sort(needed.begin(), needed.end(),
                   [](const auto* a, const auto* b) { return a->time < b->time; });
  return needed;
}

std::vector<Seed> find_seeds(const StoredRecording& recording, std::uint32_t instance) {
  // Everything from the first request on is in the recording; a state from before may be one that others
  // have asked for.
  std::uint64_t begin = forever;
  for (const auto& message : recording.messages)
    if (message.topic->handle == "snapshot_request") begin = std::min(begin, message.time);
  if (begin == forever) return {};

  const auto lives = processes_of(recording, instance);
  std::map<std::int32_t, snapshot::Assembly> assemblies;
  std::vector<Seed> seeds;
  std::string why;
  std::uint64_t end = 0;
  for (const auto& message : recording.messages) end = std::max(end, message.time);
  const auto length = [&](const Seed& seed) { return std::min(seed.until, end + 1) - seed.time; };
  ServiceSnapshot part;
  for (const auto& message : recording.messages) {
    if (message.topic->handle != "service_snapshot" || !bus::decode(message.cdr, part)) continue;
    if (part.instance != instance || part.time < begin) continue;
    if (part.kind == SnapshotKind::NOT_NEEDED) return {};
    if (part.kind == SnapshotKind::LATER) {
      why = part.detail;
      continue;
    }
    auto whole = assemblies[part.pid].add(part);
    if (!whole) continue;
    seeds.push_back(seed_of(std::move(*whole), lives));
    seeds.back().refused = why;
  }
  if (seeds.empty())
    throw std::runtime_error(
        "it cannot be verified: the recording has no state of the service to start from" +
        (why.empty() ? "" : "; " + why));
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](const Seed& a, const Seed& b) { return length(a) > length(b); });
  return seeds;
}

}  // namespace trunnion::verification
