// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "channel_setup/channel_setup.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/service_constants.hpp"
#include "program_files.hpp"
#include "service/damage_alarm.hpp"
#include "snapshot/fields.hpp"

namespace trunnion::plc {
namespace {

constexpr std::size_t most_applied = 256;  // inputs that one message of the log can name
constexpr double outputs_period = 0.2;     // s between two messages to the drive
constexpr double longest_input = 0.05;     // s of taking the drive's feedback without anything else
// s of virtual time that the drive is asked for at once. It lives through hours in a moment, and the programs
// must see what it does to their outputs before their own times have passed.
constexpr double longest_ahead = 0.1;
constexpr double log_period = 0.02;     // s between two progress messages
constexpr double image_period = 0.1;    // s, fastest publication of the image
constexpr double drive_timeout = 0.15;  // s for which PLC time continues by the clock without feedback
constexpr double standstill_timeout =
    0.5;  // s for which a request waits for the drive's confirmation of the standstill

std::string in_directory(const std::string& directory, const char* name) {
  std::filesystem::create_directories(directory);
  return directory + "/" + name;
}

bool usable_by_every_channel(const machine::Parameters& parameters, const machine::MachineConfig& machine) {
  try {
    for (const auto& entry : machine.services)
      if (entry.service == machine::service::channel.name)
        channel_setup::ChannelSetup(static_cast<std::uint16_t>(entry.channel)).configure(parameters);
  } catch (const std::runtime_error&) {
    return false;  // the channel says why
  }
  return true;
}

}  // namespace

PlcService::PlcService(service::Node& node)
    : node_(node),
      boot_(boot_of(node)),
      parameters_(node.bus()),
      round_writer_(node.options().state_directory + rounds_file),
      online_(node, core_, rounds_, boot_,
              [this](std::int64_t time) { applied(idl::stream::Input::ONLINE_REQUEST, time); }),
      feedback_(node.bus(), topics::feedback),
      channels_(node.bus().reader(topics::channel_state)),
      requests_(node.bus().reader(topics::auxiliary_request)),
      alarms_(node.bus().reader(topics::alarm)),
      outputs_(node.bus().writer(topics::plc_outputs)),
      done_(node.bus().writer(topics::auxiliary_done)),
      signals_(node.bus().writer(topics::macro_signal)),
      image_(node.bus().writer(topics::plc_image)),
      log_(node.bus().writer(topics::plc_input_log)),
      resets_(node.bus().writer(topics::alarm_reset)),
      panel_(node.bus(), topics::panel_request, topics::panel_reply),
      modbus_(node),
      orders_(node, core_) {
  try {
    auto programs = online_.start();
    for (const auto& warning : programs.warnings) std::cerr << warning << "\n";
    core_.load(std::move(programs));
  } catch (const std::runtime_error& e) {
    fault_ = e.what();
    std::cerr << fault_ << "\n";
    node_.alarms().raise(alarm::plc_program, 0, fault_.substr(0, fault_.find('\n')));
  }
  load_state();
  try {
    online_.set_modbus(modbus_of(online_.sources().files, online_.sources().directory));
    modbus_.change(online_.modbus());
  } catch (const std::runtime_error& e) {
    std::cerr << e.what() << "\n";
    node_.alarms().raise(alarm::plc_modbus, 0, std::string(e.what()) + "; no Modbus connection is made");
  }
}

void PlcService::load_state() {
  const auto path = in_directory(node_.options().state_directory, "plc.image");
  const auto found = RetainedMemory(path, core_.memory().program.cells).load();
  service::report_damage(node_.alarms(), 0, path, {found.state, "", 0, found.problem},
                         "retained registers of the PLC");
  if (const auto& kept = found.kept) {
    // Only within one run of the cluster may a spindle keep turning without a new command of the program.
    const bool same_run = !boot_.empty() && kept->boot == boot_;
    const bool other = fault_.empty() && !core_.accepts(kept->memory.program);
    const bool continues = other && online_.continue_from(kept->memory, same_run);
    if (other && !continues && kept->memory.program.cells > 0)
      std::cerr << "the variables of the PLC programs have changed: they begin with their initial values\n";
    if (continues)
      ;
    else if (same_run)
      core_.restore(kept->memory);
    else
      core_.power_up(kept->memory);
  }
  retained_.emplace(path, core_.memory().program.cells);
  tick_ = core_.memory().tick;
}

void PlcService::programs_changed() {
  retained_->resize(core_.memory().program.cells, boot_, core_.memory());
  fault_.clear();
  stopped_ = false;
  node_.alarms().clear(alarm::plc_program, 0);
  node_.alarms().clear(alarm::plc_modbus, 0);
  modbus_.change(online_.modbus());
  orders_.programs_changed();
}

service::SnapshotAnswer PlcService::snapshot() {
  using idl::service::SnapshotKind;
  if (!core_.configured()) return {SnapshotKind::LATER, "the PLC waits for parameters", ""};
  if (online_.is_loading()) return {SnapshotKind::LATER, "new PLC programs are being loaded", ""};
  const auto core = core_.state();
  bus::Json state = {{"core", snapshot::written(core)}};
  if (const auto& program = core.memory.program; program.cells > 0) {
    const std::vector<std::uint64_t> values(program.values.begin(), program.values.begin() + program.cells);
    state["variables"] = {{"layout", program.layout},
                          {"fault", snapshot::written(program.fault)},
                          {"main", snapshot::written(program.main)},
                          {"values", values}};
  }
  if (const auto* sources = online_.loaded_sources()) {
    auto& files = state["sources"] = bus::Json::array();
    for (const auto& file : *sources) files.push_back({{"name", file.name}, {"text", file.text}});
  }
  auto& alarms = state["active_alarms"] = bus::Json::array();
  for (const auto& [key, alarm] : active_alarms_) alarms.push_back(snapshot::written(alarm));
  return {SnapshotKind::GIVEN, "", bus::text_of(state)};
}

// After the first parameters, which would count as a changed input.
void PlcService::continue_from_snapshot() {
  const auto& state = *node_.snapshot();
  auto core = core_.state();
  snapshot::read(state.at("core"), core);
  if (const auto found = state.find("variables"); found != state.end()) {
    auto& program = core.memory.program;
    std::vector<std::uint64_t> values;
    snapshot::read(found->at("values"), values);
    if (found->at("layout") == program.layout && values.size() == program.cells) {
      std::copy(values.begin(), values.end(), program.values.begin());
      snapshot::read(found->at("fault"), program.fault);
      if (const auto main = found->find("main"); main != found->end()) snapshot::read(*main, program.main);
    }
  }
  core_.adopt(core);
  tick_ = core_.memory().tick;
  std::vector<idl::service::Alarm> alarms;
  snapshot::read(state.at("active_alarms"), alarms);
  for (const auto& alarm : alarms) active_alarms_[{alarm.instance, alarm.number, alarm.part}] = alarm;
  first_ = false;  // what is finished was published before
  online_.forces_are_published();
}

void PlcService::configure() {
  online_.each([&](PlcCore& core) { core.configure(*parameters_.newest(), node_.options().virtual_time); });
  rounds_.record(StepKind::PARAMETERS, parameters_.newest()->revision);
  usable_ = usable_ || usable_by_every_channel(*parameters_.newest(), node_.options().machine);
  orders_.configure(*parameters_.newest());
  period_ = parameters_.newest()->integer(parameter::interpolation_cycle) * 1e-6;
  if (node_.snapshot() == nullptr || continued_) return;
  continue_from_snapshot();
  continued_ = true;
}

void PlcService::begin_round() {
  if (!core_.configured()) return;
  const auto generation = round_writer_.wanted(service::monotonic_seconds());
  if (!rounds_.begin_round(generation, core_, parameters_.newest()->revision)) return;
  bus::encode(rounds_.first_round(), round_bytes_);
  round_writer_.write(round_bytes_);
}

void PlcService::end_round(const std::vector<idl::plc::AuxiliaryDone>& done) {
  if (!rounds_.on()) return;
  bus::encode(rounds_.end_round(core_, done), round_bytes_);
  round_writer_.write(round_bytes_);
}

void PlcService::advance(std::uint64_t tick) {
  online_.each([&](PlcCore& core) { core.advance(tick); });
  rounds_.record(StepKind::ADVANCE, tick);
}

void PlcService::applied(idl::stream::Input input, std::int64_t source_time) {
  inputs_.applied.push_back({input, core_.memory().tick, static_cast<std::uint64_t>(source_time)});
  if (inputs_.applied.size() == most_applied) publish_inputs(service::monotonic_seconds());
}

void PlcService::publish_inputs(double now) {
  const bool further = core_.memory().tick != inputs_.tick;
  if (inputs_.applied.empty() && (!further || now - log_written_ < log_period)) return;
  inputs_.instance = node_.options().instance;
  inputs_.tick = core_.memory().tick;
  log_.write(inputs_);
  log_written_ = now;
  inputs_.applied.clear();
}

void PlcService::take_inputs() {
  using idl::stream::Input;
  // Virtual time may run faster than the programs: the process shows that it lives in between.
  const double began = service::monotonic_seconds();
  while (service::monotonic_seconds() - began < longest_input && feedback_.take(batch_)) {
    ++messages_in_;
    online_.each([&](PlcCore& core) { core.set_feedback(batch_); });
    rounds_.record(batch_);
    // One message at a time, so that the result does not depend on how many have arrived.
    advance(node_.options().virtual_time ? batch_.tick : std::max(batch_.tick, core_.memory().tick));
    if (batch_.tick != tick_) {
      tick_ = batch_.tick;
      tick_seen_ = service::monotonic_seconds();
    }
  }
  idl::channel::ChannelState state;
  while (channels_.take(state)) {
    applied(Input::CHANNEL_STATE, channels_.info().source_timestamp);
    online_.each([&](PlcCore& core) { core.set_channel(state); });
    orders_.set_channel(state);
    rounds_.record(StepKind::CHANNEL_STATE, state);
  }
  idl::channel::AuxiliaryRequest request;
  while (requests_.take(request)) {
    applied(Input::AUXILIARY_REQUEST, requests_.info().source_timestamp);
    online_.each([&](PlcCore& core) { core.set_request(request); });
    rounds_.record(StepKind::AUXILIARY_REQUEST, request);
  }
  idl::service::Alarm alarm;
  while (alarms_.take(alarm)) {
    applied(Input::ALARM, alarms_.info().source_timestamp);
    const auto key = std::make_tuple(alarm.instance, alarm.number, alarm.part);
    if (alarm.active)
      active_alarms_[key] = alarm;
    else
      active_alarms_.erase(key);
  }
  const bool any = !active_alarms_.empty();
  const bool stops = std::any_of(active_alarms_.begin(), active_alarms_.end(), [](const auto& entry) {
    return entry.second.reaction != idl::service::Reaction::SHOW;
  });
  online_.each([&](PlcCore& core) { core.set_alarms(any, stops); });
  rounds_.record(StepKind::ALARMS, (any ? 1u : 0u) | (stops ? 2u : 0u));
  idl::plc::PanelRequest panel;
  while (panel_.take(panel)) {
    applied(Input::PANEL_REQUEST, panel_.info().source_timestamp);
    idl::plc::PanelReply reply;
    online_.each([&](PlcCore& core) { reply.reason = core.panel(panel); });
    reply.accepted = reply.reason.empty();
    rounds_.record(StepKind::PANEL_REQUEST, panel);
    panel_.reply(panel, reply);
  }
  online_.pump(service::monotonic_seconds());
}

/// In real time the ticks between two batches of the drive follow the clock, for at most drive_timeout.
std::uint64_t PlcService::tick_now(double now) const {
  if (node_.options().virtual_time || tick_seen_ == 0) return tick_;
  const double ahead = std::clamp(now - tick_seen_, 0.0, drive_timeout) / period_;
  return std::max(tick_ + static_cast<std::uint64_t>(ahead), core_.memory().tick);
}

void PlcService::pump() {
  begin_round();
  if (parameters_.poll()) configure();
  // A state that is continued must be there before the first input.
  if (node_.snapshot() != nullptr && !continued_) return;
  take_inputs();
  if (online_.has_taken_over()) programs_changed();
  if (!core_.configured()) return;
  const double now = service::monotonic_seconds();
  if (!core_.waits_for_standstill()) {
    waiting_since_ = 0;
  } else if (waiting_since_ == 0) {
    waiting_since_ = now;
  } else if (now - waiting_since_ > standstill_timeout) {
    online_.each([](PlcCore& core) { core.give_up_waiting(); });
    rounds_.record(StepKind::GIVE_UP_WAITING);
  }
  advance(tick_now(now));
  publish_inputs(now);
  retained_->save(boot_, core_.memory());
  modbus_.pump(core_, now);
  orders_.pump(now);
  publish(now);
}

void PlcService::answer(const idl::plc::AuxiliaryDone& done) {
  if (const auto signal = core_.signal_read(done))
    signals_.write(*signal);
  else
    done_.write(done);
}

void PlcService::publish(double now) {
  auto outputs = core_.outputs();
  const auto ahead = static_cast<std::uint64_t>(longest_ahead / period_);
  outputs.run_until_tick = std::min(outputs.run_until_tick, outputs.tick + ahead);
  // A channel could not move them, and may describe another machine: the drives stay off.
  if (!usable_) outputs.axis_enable.assign(outputs.axis_enable.size(), 0);
  auto same = last_outputs_;
  same.tick = outputs.tick;
  if (!node_.options().virtual_time) same.run_until_tick = outputs.run_until_tick;
  // A run_until_tick in the past requests nothing.
  if (same.run_until_tick <= outputs.tick && outputs.run_until_tick <= outputs.tick)
    same.run_until_tick = outputs.run_until_tick;
  if (first_ || same != outputs || now - outputs_written_ >= outputs_period) {
    outputs_.write(outputs);
    ++messages_out_;
    last_outputs_ = outputs;
    outputs_written_ = now;
  }
  if (first_)
    for (const auto& done : core_.all_done()) answer(done);
  const auto finished = core_.take_done();
  end_round(finished);
  online_.compare(finished);
  for (const auto& done : finished) {
    if (done.failed)
      node_.alarms().raise(
          alarm::auxiliary_refused, done.channel,
          "An auxiliary function of channel " + std::to_string(done.channel) +
              " was not executed: the PLC program reports a failure. Check the machine, then "
              "reset the alarms",
          core_.memory().handshakes[done.channel].cycle);
    node_.alarms().release(alarm::auxiliary_refused, done.channel);
    answer(done);
  }
  reset_alarms();
  first_ = false;
  if (fault_.empty()) {
    if (core_.has_program_fault() != stopped_) {
      stopped_ = core_.has_program_fault();
      if (stopped_)
        node_.alarms().raise(alarm::plc_program, 0, core_.program_fault(), core_.executed());
      else
        node_.alarms().clear(alarm::plc_program, 0);
    }
    if (core_.emergency_stop())
      node_.alarms().raise(alarm::emergency_stop, 0,
                           "Emergency stop is active: release the button, reset the emergency stop, then the "
                           "alarms and the channel",
                           core_.executed());
    else
      node_.alarms().clear(alarm::emergency_stop, 0);
  }
  online_.publish(now);
  if (now - image_written_ >= image_period) {
    auto image = core_.image();
    last_image_.scan = image.scan;
    if (image != last_image_ || image_written_ == 0) image_.write(image);
    last_image_ = std::move(image);
    image_written_ = now;
  }
}

// At the rising edge. In a verification the recording has the reset already.
void PlcService::reset_alarms() {
  const bool now = core_.external_reset();
  if (now && !external_reset_ && !first_ && node_.snapshot() == nullptr) {
    reset_sent_ = service::monotonic_seconds();
    resets_.write({client_, ++resets_sent_, service::all_channels});
  }
  external_reset_ = now;
}

service::Health PlcService::health() const {
  using idl::service::Lifecycle;
  service::Health health;
  health.lifecycle = !fault_.empty()       ? Lifecycle::FAULT
                     : !core_.configured() ? Lifecycle::UNCONFIGURED
                                           : Lifecycle::ACTIVE;
  health.detail = !fault_.empty() ? fault_ : !core_.configured() ? "waiting for parameters" : "";
  health.messages_in = messages_in_;
  health.messages_out = messages_out_;
  health.revision = parameters_.newest() ? parameters_.newest()->revision : 0;
  return health;
}

}  // namespace trunnion::plc
