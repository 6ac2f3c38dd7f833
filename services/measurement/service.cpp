// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "bus/json.hpp"
#include "machine/alarm_constants.hpp"
#include "machine_facts.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/kept_files.hpp"
#include "storage/file.hpp"

namespace trunnion::measurement {
namespace {

constexpr const char* kept_file = "measurement.json";
constexpr double history_pause = 0.5;                       // s: until the history of calls has come
constexpr double active_period = 0.01, idle_period = 0.25;  // s

// With the file of a snapshot, if there is one to continue from.
std::string prepare_file(const service::Node& node) {
  const auto& directory = node.options().state_directory;
  std::filesystem::create_directories(directory);
  if (node.snapshot() != nullptr) snapshot::put_files(directory, node.snapshot()->at("files"));
  return directory + "/" + kept_file;
}

}  // namespace

MeasurementService::MeasurementService(service::Node& node)
    : node_(node),
      file_(prepare_file(node)),
      core_(load_facts(node.options().machine)),
      states_(node.bus().reader(topics::channel_state)),
      variables_(node.bus().reader(topics::variables)),
      alarms_(node.bus().reader(topics::alarm)),
      calls_(node.bus().reader(topics::cycle_request)),
      parameters_(node.bus().reader(topics::parameter_set)),
      state_(node.bus().writer(topics::measurement_state)),
      result_(node.bus().writer(topics::measurement_result)),
      call_reply_(node.bus().writer(topics::cycle_reply)),
      channel_(node.bus(), topics::channel_request, topics::channel_reply),
      program_(node.bus(), topics::program_request, topics::program_reply),
      parameter_(node.bus(), topics::parameter_request, topics::parameter_reply),
      requests_(node.bus(), topics::measurement_request, topics::measurement_reply),
      begun_(service::monotonic_seconds()) {
  restore();
  if (node.snapshot() == nullptr) publish();  // otherwise it was published before the snapshot
  core_.take_change();
  tell();
}

MeasurementService::~MeasurementService() {
  if (work_.valid()) work_.wait();
}

void MeasurementService::restore() {
  const auto kept = storage::read_kept(file_);
  service::report_damage(node_.alarms(), 0, kept_file, kept, "the measurement of the kinematics");
  if (kept.state == storage::KeptState::absent || kept.state == storage::KeptState::unusable) return;
  try {
    if (kept.state == storage::KeptState::previous) storage::repair_kept(file_, kept);
    core_.restore(parse_measurement(kept.content));
  } catch (const std::exception& e) {
    node_.alarms().raise(alarm::state_lost, 0, std::string(kept_file) + ": " + e.what());
    node_.alarms().release(alarm::state_lost, 0);
  }
}

double MeasurementService::period() const {
  return is_active(core_.stored().state.phase) ? active_period : idle_period;
}

void MeasurementService::listen(double now) {
  auto& machine = core_.machine();
  // Alarms before states: an alarm that has held the channel is known when its state is.
  idl::service::Alarm alarm;
  while (alarms_.take(alarm)) machine.take(alarm);
  idl::channel::ChannelState state;
  while (states_.take(state)) machine.take(state, now);
  idl::channel::Variables variables;
  while (variables_.take(variables)) machine.take(variables);
  idl::parameters::ParameterSet set;
  if (parameters_.take_newest(set)) core_.take(set);
  take_calls(now);
}

// A new process is sent the history of the topic: only the newest request of a channel may still be open.
void MeasurementService::take_calls(double now) {
  if (now - begun_ < history_pause) return;
  std::vector<idl::channel::CycleRequest> calls;
  idl::channel::CycleRequest call;
  while (calls_.take(call)) calls.push_back(call);
  for (auto one = calls.begin(); one != calls.end(); ++one) {
    const bool overtaken =
        std::any_of(one + 1, calls.end(), [&](const auto& later) { return later.channel == one->channel; });
    if (!overtaken || one->caller == idl::channel::CycleCaller::ENDED)
      core_.call(*one, service::time_of_day());
  }
}

void MeasurementService::take_answers(double now) {
  if (const auto reply = channel_.poll()) core_.answered(0, {reply->accepted, reply->reason}, now);
  if (const auto reply = program_.poll())
    core_.answered(1, {reply->accepted, reply->reason, reply->entry.revision}, now);
  if (const auto reply = parameter_.poll()) core_.answered(2, {reply->accepted, reply->reason}, now);
  if (work_.valid() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    core_.worked(work_.get(), now);
}

void MeasurementService::send(Request request) {
  if (auto* channel = std::get_if<idl::channel::ChannelRequest>(&request)) channel_.send(std::move(*channel));
  if (auto* program = std::get_if<idl::program::ProgramRequest>(&request)) program_.send(std::move(*program));
  if (auto* values = std::get_if<idl::parameters::ParameterRequest>(&request))
    parameter_.send(std::move(*values));
}

// What was decided is on the disk before anything of it is done.
void MeasurementService::keep() {
  if (!core_.take_change()) return;
  try {
    storage::write_kept(file_, text_of(core_.stored()));
    node_.alarms().release(alarm::storage_failed, 0);
  } catch (const storage::StorageError& e) {
    node_.alarms().raise(alarm::storage_failed, 0, e.what());
  }
  publish();
  tell();
}

void MeasurementService::publish() {
  // Who sees the end of a measurement finds its result.
  if (const auto& result = core_.stored().result; result != published_) {
    result_.write(result);
    published_ = result;
  }
  state_.write(core_.stored().state);
}

// The alarms say what the state says.
void MeasurementService::tell() {
  const auto& state = core_.stored().state;
  if (state.phase == told_ && state.error == told_error_) return;
  told_ = state.phase, told_error_ = state.error;
  auto& alarms = node_.alarms();
  if (state.phase == Phase::INTERRUPTED) {
    alarms.raise(alarm::measurement_stopped, state.channel, state.error);
    alarms.release(alarm::measurement_stopped, state.channel);
  } else {
    alarms.clear(alarm::measurement_stopped, state.channel);
  }
  if (state.phase == Phase::WAITING && !state.tolerance_alarm.empty())
    alarms.raise(alarm::measurement_tolerance, state.channel, state.tolerance_alarm);
  else
    alarms.clear(alarm::measurement_tolerance, state.channel);
}

void MeasurementService::advance(double now) {
  core_.step(now);
  keep();
  if (auto work = core_.take_work()) work_ = std::async(std::launch::async, std::move(*work));
  if (auto request = core_.take_request()) send(std::move(*request));
  if (const auto reply = core_.take_reply()) call_reply_.write(*reply);
}

void MeasurementService::pump() {
  const double now = service::monotonic_seconds();
  listen(now);
  take_answers(now);
  MeasurementRequest request;
  while (requests_.take(request)) {
    auto reply = core_.apply(request, service::time_of_day(), now);
    keep();
    requests_.reply(request, std::move(reply));
  }
  advance(now);
}

service::Health MeasurementService::health() const {
  service::Health health;
  // Without the parameters it would refuse what its state offers.
  using idl::service::Lifecycle;
  health.lifecycle = core_.has_parameters() ? Lifecycle::ACTIVE : Lifecycle::UNCONFIGURED;
  health.detail = core_.has_parameters() ? core_.stored().state.detail : "waiting for parameters";
  return health;
}

service::SnapshotAnswer MeasurementService::snapshot() {
  using idl::service::SnapshotKind;
  if (is_active(core_.stored().state.phase)) return {SnapshotKind::LATER, "a measurement is under way", ""};
  const bus::Json state = {{"files", snapshot::kept_files(node_.options().state_directory, {kept_file})}};
  return {SnapshotKind::GIVEN, "", bus::text_of(state)};
}

}  // namespace trunnion::measurement
