// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <filesystem>

#include "bus/json.hpp"
#include "machine/alarm_constants.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/kept_files.hpp"

namespace trunnion::parameters {
namespace {

constexpr const char* boot_file = "cluster.boot";

// The state directory; with the files of a snapshot, if there is one to continue from.
std::string prepare_directory(const service::Node& node) {
  const auto& path = node.options().state_directory;
  std::filesystem::create_directories(path);
  if (node.snapshot() != nullptr) snapshot::put_files(path, node.snapshot()->at("files"));
  return path;
}

}  // namespace

ParameterService::ParameterService(service::Node& node)
    : node_(node),
      storage_(prepare_directory(node), true),
      store_(storage_, defaults_of(node.options().machine), storage_.read(boot_file).value_or("")),
      set_(node.bus().writer(topics::parameter_set)),
      tools_(node.bus().writer(topics::tool_table)),
      offsets_(node.bus().writer(topics::work_offsets)),
      channels_(node.bus().reader(topics::channel_state)),
      requests_(node.bus(), topics::parameter_request, topics::parameter_reply) {
  report_damage();
  report_misfit();
  if (!store_.problem().empty()) node.alarms().raise(alarm::storage_failed, 0, store_.problem());
  if (node.snapshot() == nullptr)
    publish();
  else
    store_.take_changes();  // they were published before the snapshot
}

void ParameterService::report_damage() {
  const std::map<std::string, const char*> contents = {{parameters_file, "saved parameters"},
                                                       {active_file, "revisions of the active parameters"},
                                                       {tool_tables::tools_file, "tools"},
                                                       {tool_tables::offsets_file, "work offsets"}};
  std::uint32_t part = 0;
  for (const auto& [name, kept] : storage_.damaged())
    service::report_damage(node_.alarms(), part++, storage_.path(name), kept, contents.at(name));
}

// Of a state that is older than the refusal of such changes, or of a machine that has got other files.
void ParameterService::report_misfit() {
  const auto faults = store_.faults();
  if (faults.empty()) return node_.alarms().release(alarm::axes_misfit, 0);
  const auto further = faults.size() - 1;
  node_.alarms().raise(alarm::axes_misfit, 0,
                       faults.front().text +
                           (further == 0 ? "" : "; and " + std::to_string(further) + " more faults like it"));
}

service::SnapshotAnswer ParameterService::snapshot() {
  const bus::Json state = {
      {"files", snapshot::kept_files(node_.options().state_directory,
                                     {boot_file, parameters_file, active_file, tool_tables::tools_file,
                                      tool_tables::offsets_file})}};
  return {idl::service::SnapshotKind::GIVEN, "", bus::text_of(state)};
}

void ParameterService::publish() {
  const auto changes = store_.take_changes();
  if (changes.set) {
    set_.write(store_.set());
    report_misfit();
  }
  if (changes.tools) tools_.write(store_.tool_table());
  if (changes.offsets) offsets_.write(store_.work_offsets());
}

void ParameterService::pump() {
  idl::channel::ChannelState state;
  while (channels_.take(state)) {
    try {
      store_.channel_reset_count(state.channel, state.reset_count);
    } catch (const StorageError& e) {
      node_.alarms().raise(alarm::storage_failed, 0, e.what(), state.cycle);
    }
    publish();
  }
  idl::parameters::ParameterRequest request;
  while (requests_.take(request)) {
    const auto reply = store_.apply(request, service::time_of_day());
    if (reply.accepted)
      node_.alarms().release(alarm::storage_failed, 0);
    else if (reply.alarm == alarm::storage_failed.number)
      node_.alarms().raise(alarm::storage_failed, 0, reply.reason);
    publish();
    requests_.reply(request, reply);
  }
}

service::Health ParameterService::health() const {
  service::Health health;
  health.lifecycle = idl::service::Lifecycle::ACTIVE;
  health.revision = store_.revision();
  return health;
}

}  // namespace trunnion::parameters
