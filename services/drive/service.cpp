// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <fcntl.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/timeouts.hpp"
#include "machine/service_constants.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/fields.hpp"
#include "storage/file.hpp"
#include "stream/stage_service.hpp"
#include "text/utf8.hpp"

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::drive {
namespace {
// Of virtual time at once: 10 s at 1 ms. A timer of hours would keep the drive from its heartbeat and from
// whatever starts meanwhile.
constexpr int most_idle_steps = 10000;
// Inputs are taken once in so many periods, and so often before the call returns: 2^15 periods.
constexpr std::uint64_t periods_between_inputs = 256;
constexpr int most_drained = 128;
constexpr double idle_feedback = 0.1;      // s between two feedback messages while nothing moves
constexpr std::size_t most_applied = 256;  // inputs that one feedback message can name

std::span<const std::uint8_t> bytes_of(const Memory& memory) {
  return {reinterpret_cast<const std::uint8_t*>(&memory), sizeof memory};
}

// The file of the version before, which ended with the channels: one file, without checksum.
std::optional<Memory> memory_of_format_0(const std::string& path, const Memory& now) {
  constexpr std::size_t size = offsetof(Memory, homed);
  std::error_code none;
  if (std::filesystem::exists(path + storage::previous_suffix, none) ||
      std::filesystem::file_size(path, none) != size || none)
    return std::nullopt;
  Memory memory = now;
  const storage::File file(path, O_RDONLY);
  file.read(0, {reinterpret_cast<std::uint8_t*>(&memory), size});
  if (memory.magic != Memory::magic_value || memory.axes != now.axes) return std::nullopt;
  return memory;
}

std::uint64_t identity(const auto& reader) {
  return static_cast<std::uint64_t>(reader.info().source_timestamp);
}
}  // namespace

DriveService::DriveService(service::Node& node, std::unique_ptr<DriveHardware> hardware)
    : node_(node),
      parameters_(node.bus()),
      encoders_(node.options().state_directory + "/encoders.bin", "encoders", sizeof(Memory)),
      core_(std::move(hardware)) {}

void DriveService::start() {
  if (node_.snapshot() != nullptr) {
    continue_from_snapshot();
  } else {
    configure(*parameters_.newest());
    restore();
  }
  restore_kept();
  const auto memory = core_.memory();
  encoders_.open(bytes_of(memory));
  const auto& p = *parameters_.find(revision_);
  const machine::StreamSettings stream(p, node_.options().virtual_time);
  batch_cycles_ = stream.batch;
  node_.bus().set_depth({stream::stream_depth(stream, 1)});
  writer_.emplace(node_.bus().writer(topics::feedback));
  samples_writer_.emplace(node_.bus().writer(topics::servo_test_samples));
  test_requests_.emplace(node_.bus().reader(topics::servo_test_request));
  outputs_.emplace(node_.bus().reader(topics::plc_outputs));
  panel_.emplace(node_.bus().reader(topics::panel_request));
  services_.emplace(node_.bus().reader(topics::service_state));
  alarms_.emplace(node_.bus().reader(topics::alarm));
  requests_.emplace(node_.bus().reader(topics::stream_request));
  batches_.emplace(node_.bus(), topics::gantry_batch);
  next_tick_ = service::monotonic_seconds();
  send();
}

// Only positions that are certain are taken: an axis without one has no reference, which an alarm says.
void DriveService::restore() {
  using storage::KeptState;
  auto kept = encoders_.load();
  Memory memory;
  if (!kept.content.empty()) std::memcpy(&memory, kept.content.data(), sizeof memory);
  const auto old = memory_of_format_0(encoders_.path(), core_.memory());
  const bool damaged = !old && kept.state != KeptState::good && kept.state != KeptState::absent;
  if (old)
    core_.restore(*old);
  else if (damaged)
    core_.restore_without_positions(memory);
  else if (kept.state == KeptState::good)
    core_.restore(memory);
  if (!damaged) kept.problem = "it has not been referenced since its position was lost, or is new";
  unreferenced_ = core_.unreferenced();
  for (const auto& axis : unreferenced_)
    node_.alarms().raise(alarm::not_homed, axis.number,
                         "The position of axis " + axis.name + " is not known (" + kept.problem +
                             "): select mode REF, then reference return of the axis",
                         core_.next());
  if (unreferenced_.empty() && damaged)
    service::report_damage(node_.alarms(), 0, encoders_.path(), {kept.state, "", 0, kept.problem},
                           "cycle numbers");
}

void DriveService::restore_kept() {
  const auto now = core_.hardware().kept();
  if (now.empty()) return;
  simulation_.emplace(node_.options().state_directory + "/simulation.bin", "simulation", now.size());
  // A snapshot has it already. Without a file, or with a damaged one, the machine is cold.
  if (const auto kept = simulation_->load(); node_.snapshot() == nullptr && !kept.content.empty())
    core_.hardware().restore_kept(kept.content);
  simulation_->open(core_.hardware().kept());
}

void DriveService::watch_references() {
  if (unreferenced_.empty()) return;
  const auto still = core_.unreferenced();
  std::erase_if(unreferenced_, [&](const machine::AxisInfo& axis) {
    const bool referenced = std::none_of(still.begin(), still.end(),
                                         [&](const auto& other) { return other.number == axis.number; });
    if (referenced) node_.alarms().clear(alarm::not_homed, axis.number);
    return referenced;
  });
}

service::SnapshotAnswer DriveService::snapshot() {
  using idl::service::SnapshotKind;
  if (!core_.configured()) return {SnapshotKind::LATER, "the drive waits for parameters", ""};
  if (!applied_.empty() || core_.rows() > 0) send();
  send_samples();
  bus::Json state = {{"core", core_.explicit_state()}};
  if (state["core"].is_null())
    return {SnapshotKind::LATER, "the hardware of the drive does not give its state", ""};
  state["revision"] = revision_;
  state["have_plc"] = have_plc_;
  state["plc"] = snapshot::written(plc_);
  state["press"] = snapshot::written(press_);
  return {SnapshotKind::GIVEN, "", bus::text_of(state)};
}

void DriveService::continue_from_snapshot() {
  const auto& state = *node_.snapshot();
  configure(*parameters_.find(state.at("revision").get<std::uint64_t>()));
  applied_.clear();  // it had been reported before the snapshot
  core_.continue_from(state.at("core"));
  have_plc_ = state.at("have_plc").get<bool>();
  snapshot::read(state.at("plc"), plc_);
  snapshot::read(state.at("press"), press_);
  running_time_.advance(service::monotonic_seconds());
  plc_seen_ = test_seen_ = running_time_.now();
}

// To start with: any set, or the one that a snapshot was made with.
bool DriveService::parameters_are_here() {
  parameters_.poll();
  if (node_.snapshot() != nullptr)
    return parameters_.find(node_.snapshot()->at("revision").get<std::uint64_t>()) != nullptr;
  return parameters_.newest() != nullptr;
}

void DriveService::configure(const machine::Parameters& parameters) {
  core_.configure(parameters, node_.options().virtual_time);
  revision_ = parameters.revision;
  applied(idl::stream::Input::PARAMETER_SET, revision_);
}

void DriveService::applied(idl::stream::Input input, std::uint64_t identity) {
  if (applied_.size() == most_applied) send();
  applied_.push_back({input, core_.tick(), identity});
}

void DriveService::drain() {
  using idl::stream::Input;
  if (parameters_.poll() && core_.configured() && !core_.any_active()) configure(*parameters_.newest());
  const double now = running_time_.now();
  while (batches_->take(batch_)) {
    ++messages_in_;
    // The revision of the batches that move it is the one the drive runs with.
    if (batch_.revision != revision_) {
      if (const auto p = parameters_.find(batch_.revision)) {
        configure(*p);
      } else {
        node_.alarms().raise(alarm::revision_unknown, batch_.channel,
                             "Batches are made with parameter revision " + std::to_string(batch_.revision) +
                                 ", which has not arrived",
                             batch_.first);
        node_.alarms().release(alarm::revision_unknown, batch_.channel);  // until the next such batch
        continue;
      }
    }
    applied(Input::GANTRY_BATCH, identity(*batches_));
    if (!core_.put(batch_)) {
      stream::raise_difference(node_.alarms(), *core_.first_arrival(batch_), batch_);
      core_.stop();
    }
  }
  idl::stream::StreamRequest request;
  while (requests_->take(request)) {
    applied(Input::STREAM_REQUEST, identity(*requests_));
    core_.request(request);
    changed_ = true;
  }
  idl::servo::TestRequest test;
  while (test_requests_->take(test)) {
    applied(Input::SERVO_TEST_REQUEST, identity(*test_requests_));
    // The requests of other clients are no sign of the one whose test is running.
    if (request_test(test)) test_seen_ = now;
  }
  if (auto* tester = core_.hardware().tester();
      tester != nullptr && tester->running() && now - test_seen_ > servo_test_timeout)
    tester->end(idl::servo::TestPhase::ENDED_BY_STOP);
  while (outputs_->take(plc_)) {
    applied(Input::PLC_OUTPUTS, identity(*outputs_));
    have_plc_ = true;
    plc_seen_ = now;
    press_.release(plc_);
    core_.set_enables(plc_.axis_enable, plc_.emergency_stop || press_.held());
    core_.set_spindle_speed(plc_.spindle_speed);
    core_.set_surface_speeds(plc_.surface_speeds);
    core_.set_spindle_gears(plc_.spindle_gear);
    core_.set_spindle_orientation(plc_.spindle_orient, plc_.spindle_angle);
    core_.set_spindle_couplings(plc_.spindle_couplings);
    core_.set_probe(plc_.probe_on);
    changed_ = true;
  }
  idl::plc::PanelRequest panel;
  while (panel_->take(panel)) {
    if (panel.kind != idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP) continue;
    applied(Input::PANEL_REQUEST, identity(*panel_));
    press_.press({panel.client, panel.number}, plc_);
    if (press_.held()) core_.set_enables(plc_.axis_enable, true);
    changed_ = true;
  }
  idl::service::ServiceState state;
  while (services_->take(state))
    if (state.service == machine::service::plc.name) plc_seen_ = now;
  idl::service::Alarm alarm;
  while (alarms_->take(alarm))
    if (alarm.active && alarm.reaction == idl::service::Reaction::AXIS_STOP &&
        alarm.instance != node_.options().instance) {
      applied(Input::ALARM, identity(*alarms_));
      core_.stop();
    }
  // An emergency stop is also the drive's own reaction to the silence of the PLC that could demand it.
  if (have_plc_ && now - plc_seen_ > plc_timeout) {
    char text[120];
    std::snprintf(text, sizeof text, "No sign of the PLC for %.1f s: see why it does not run, then reset",
                  plc_timeout);
    node_.alarms().raise(alarm::plc_absent, 0, text, core_.next());
    core_.set_enables({}, true);
    have_plc_ = false;
    changed_ = true;
  } else if (have_plc_) {
    node_.alarms().release(alarm::plc_absent, 0);
  }
}

void DriveService::send() {
  core_.fill(feedback_);
  feedback_.press_client = press_.which().client, feedback_.press_number = press_.which().number;
  feedback_.applied.swap(applied_);
  applied_.clear();
  // Stored before it is published: a drive that continued from less than the channels know would use cycles
  // again.
  const auto memory = core_.memory();
  encoders_.save(bytes_of(memory));
  if (simulation_) simulation_->save(core_.hardware().kept());
  writer_->write(feedback_);
  ++messages_out_;
  last_sent_ = service::monotonic_seconds();
  changed_ = false;
}

bool DriveService::request_test(const idl::servo::TestRequest& request) {
  auto reason = core_.request_test(request);
  if (reason.empty()) return true;
  samples_ = {};
  samples_.client = request.client, samples_.number = request.number;
  samples_.phase = idl::servo::TestPhase::REFUSED;
  samples_.reason = text::shortened(std::move(reason), 240);
  samples_writer_->write(samples_);
  return false;
}

void DriveService::send_samples() {
  auto* tester = core_.hardware().tester();
  if (tester == nullptr || !tester->ready()) return;
  tester->fill(samples_);
  samples_writer_->write(samples_);
}

// Nothing moves: time passes as far as the PLC asked for its timers and the spindle.
bool DriveService::time_passes() const {
  return !core_.any_active() && have_plc_ && core_.tick() < plc_.run_until_tick;
}

void DriveService::run_virtual() {
  bool give_up = false;
  if (core_.waiting()) {
    const double now = running_time_.now();
    if (waiting_since_ == 0) waiting_since_ = now;
    give_up = now - waiting_since_ > missing_setpoint_timeout;
  } else {
    waiting_since_ = 0;
  }
  unfinished_ = false;
  for (int drained = 0; core_.can_step(give_up);) {
    core_.step();
    waiting_since_ = 0;
    send_samples();
    if (core_.rows() >= batch_cycles_) send();
    // An emergency stop is not kept waiting by a long return to the path. The periods in which the servos
    // settle are few, and a start within them would make their number a matter of time.
    if (core_.tick() % periods_between_inputs != 0 ||
        (!core_.any_active() && core_.mode() == Mode::FOLLOWING && !core_.needs_time()))
      continue;
    // A return from far away takes hours: between two calls the process shows that it lives.
    if (unfinished_ = ++drained == most_drained; unfinished_) break;
    drain();
  }
  for (int i = 0; i < most_idle_steps && time_passes(); ++i) {
    core_.step();
    changed_ = true;
    // The PLC itself has asked for this time: its silence counts when that is over.
    plc_seen_ = running_time_.now();
  }
  if (core_.rows() > 0) send();
}

void DriveService::run_real() {
  const double now = service::monotonic_seconds();
  // Suspended: time that this process did not live through is not made up.
  if (now - next_tick_ > 0.5) next_tick_ = now;
  const auto due = [&] {
    if (core_.hardware().is_clock()) return core_.hardware().period_due();
    return next_tick_ <= now;
  };
  while (due()) {
    core_.step();
    next_tick_ += core_.period();
    send_samples();
    if (core_.rows() >= batch_cycles_) send();
  }
}

void DriveService::pump() {
  running_time_.advance(service::monotonic_seconds());
  if (!core_.configured()) {
    if (parameters_are_here()) start();
    return;
  }
  drain();
  const auto mode = core_.mode();
  if (node_.options().virtual_time)
    run_virtual();
  else
    run_real();
  if (core_.take_resumed()) node_.alarms().clear(alarm::setpoint_missing, 0);
  for (const auto& event : core_.take_events()) {
    node_.alarms().raise(*event.alarm, event.part, event.text, core_.next());
    const bool unreferenced = event.alarm->number == alarm::not_homed.number &&
                              std::any_of(unreferenced_.begin(), unreferenced_.end(),
                                          [&](const auto& axis) { return axis.number == event.part; });
    if (!unreferenced) node_.alarms().release(*event.alarm, event.part);
  }
  watch_references();
  send_samples();
  if (changed_ || mode != core_.mode() || service::monotonic_seconds() - last_sent_ > idle_feedback) send();
}

double DriveService::period() const {
  if (core_.configured() && node_.options().virtual_time && (unfinished_ || time_passes())) return 0;
  if (!core_.configured() || node_.options().virtual_time) return 0.02;
  if (core_.hardware().is_clock()) return core_.period();
  return std::max(0.0, next_tick_ - service::monotonic_seconds());
}

service::Health DriveService::health() const {
  using idl::service::Lifecycle;
  service::Health health;
  health.lifecycle = !core_.configured() ? Lifecycle::UNCONFIGURED
                     : have_plc_         ? Lifecycle::ACTIVE
                                         : Lifecycle::INACTIVE;
  health.detail = !core_.configured() ? "waiting for parameters" : !have_plc_ ? "waiting for the PLC" : "";
  health.messages_in = messages_in_;
  health.messages_out = messages_out_;
  health.revision = revision_;
  return health;
}

}  // namespace trunnion::drive
