// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <filesystem>
#include <iostream>

#include "bus/json.hpp"
#include "machine/alarm_constants.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/kept_files.hpp"

namespace trunnion::program {
namespace {

constexpr std::uint64_t most_snapshot_bytes = 8 << 20;  // of programs in a recording

std::string programs_directory(const service::Node& node) {
  return node.options().state_directory + "/programs";
}

// With the files of a snapshot, if there is one to continue from.
std::string prepare_programs(const service::Node& node) {
  const auto path = programs_directory(node);
  std::filesystem::create_directories(path);
  if (node.snapshot() == nullptr) return path;
  snapshot::put_files(path, node.snapshot()->at("programs"));
  snapshot::put_files(node.options().state_directory, node.snapshot()->at("index"));
  return path;
}

}  // namespace

ProgramService::ProgramService(service::Node& node)
    : node_(node),
      programs_(prepare_programs(node)),
      state_(node.options().state_directory),
      store_(programs_, state_),
      list_(node.bus().writer(topics::program_list)),
      channels_(node.bus().reader(topics::channel_state)),
      requests_(node.bus(), topics::program_request, topics::program_reply) {
  const auto& machine = node.options().machine;
  if (std::filesystem::is_directory(machine.programs_directory())) {
    DirectoryFiles delivered(machine.programs_directory());
    for (const auto& name : store_.install(delivered))
      std::cerr << machine.programs_directory() << "/" << name << ": warning: not a program name, left out\n";
  }
  service::report_damage(node.alarms(), 0, index_file, store_.index_found(),
                         "checksums and revisions of the programs");
  raise_damaged();
  if (const auto cycles = machine.directory + "/cycles"; std::filesystem::is_directory(cycles)) {
    cycles_.emplace(cycles);
    store_.set_cycles(*cycles_);
  }
  if (node.snapshot() != nullptr) store_.take_change();  // it was published before the snapshot
  pump();
}

service::SnapshotAnswer ProgramService::snapshot() {
  using idl::service::SnapshotKind;
  if (store_.uploads() > 0) return {SnapshotKind::LATER, "a program is being uploaded", ""};
  std::vector<std::string> names;
  std::uint64_t bytes = 0;
  for (const auto& entry : store_.list().programs) {
    names.push_back(entry.name);
    bytes += entry.size;
  }
  if (bytes > most_snapshot_bytes)
    return {SnapshotKind::LATER,
            "the stored programs have " + std::to_string(bytes >> 20) + " MiB, and a recording takes " +
                std::to_string(most_snapshot_bytes >> 20),
            ""};
  const bus::Json state = {{"index", snapshot::kept_files(node_.options().state_directory, {index_file})},
                           {"programs", snapshot::kept_files(programs_directory(node_), names)}};
  return {SnapshotKind::GIVEN, "", bus::text_of(state)};
}

// One alarm names the first damaged program and how many there are. It can be reset: reading such a program
// is refused with the same text.
void ProgramService::raise_damaged() {
  const auto& damaged = store_.damaged();
  if (damaged.empty()) return;
  const auto more = damaged.size() - 1;
  node_.alarms().raise(
      alarm::program_damaged, 0,
      damaged.begin()->second + (more > 0 ? " (and " + std::to_string(more) + " more programs)" : ""));
  node_.alarms().release(alarm::program_damaged, 0);
}

void ProgramService::watch_channels() {
  idl::channel::ChannelState state;
  while (channels_.take(state)) {
    const bool executed = state.suspended || state.state != idl::channel::RunState::IDLE;
    store_.set_executed(state.channel, executed ? state.program : "");
  }
}

void ProgramService::pump() {
  const double now = service::monotonic_seconds();
  watch_channels();
  idl::program::ProgramRequest request;
  while (requests_.take(request)) {
    auto reply = store_.apply(request, now);
    if (reply.alarm == alarm::storage_failed.number)
      node_.alarms().raise(alarm::storage_failed, 0, reply.reason);
    else if (reply.accepted)
      node_.alarms().release(alarm::storage_failed, 0);
    if (store_.take_change()) list_.write(store_.list());
    requests_.reply(request, std::move(reply));
  }
  try {
    store_.drop_stale_uploads(now);
  } catch (const StorageError& e) {
    node_.alarms().raise(alarm::storage_failed, 0, e.what());
  }
  if (store_.take_change()) list_.write(store_.list());
}

service::Health ProgramService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::ACTIVE;
  return health;
}

}  // namespace trunnion::program
