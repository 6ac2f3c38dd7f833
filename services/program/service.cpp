// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <filesystem>
#include <iostream>

#include "machine/alarm_constants.hpp"

namespace trunnion::program {
namespace {

std::string make_directory(const std::string& path) {
  std::filesystem::create_directories(path);
  return path;
}

}  // namespace

ProgramService::ProgramService(service::Node& node)
    : node_(node),
      programs_(make_directory(node.options().state_directory + "/programs")),
      state_(node.options().state_directory),
      store_(programs_, state_),
      list_(node.bus().writer(topics::program_list)),
      requests_(node.bus(), topics::program_request, topics::program_reply) {
  const auto& machine = node.options().machine;
  if (std::filesystem::is_directory(machine.programs_directory())) {
    DirectoryFiles delivered(machine.programs_directory());
    for (const auto& name : store_.install(delivered))
      std::cerr << machine.programs_directory() << "/" << name << ": warning: not a program name, left out\n";
  }
  if (const auto cycles = machine.directory + "/cycles"; std::filesystem::is_directory(cycles)) {
    cycles_.emplace(cycles);
    store_.set_cycles(*cycles_);
  }
  pump();
}

void ProgramService::pump() {
  const double now = service::monotonic_seconds();
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
