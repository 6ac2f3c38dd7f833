// SPDX-License-Identifier: Apache-2.0
#include "service.hpp"

#include <algorithm>
#include <fstream>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/service_constants.hpp"
#include "snapshot/fields.hpp"
#include "stream/stage_service.hpp"

namespace trunnion::channel {
namespace {
constexpr auto most_batches = stream::BatchWindow<idl::stream::PathBatch>::slots;  // more than may be ahead
constexpr double history_pause = 1.0;   // without feedback: longer than a drive that lives is ever silent
constexpr double cycle_timeout = 3.0;   // of the service of a cycle, to say that it has the call
constexpr double text_timeout = 0.5;    // without the text that motion waits for, before the alarm
constexpr double longest_read = 0.004;  // of a loop without motion, and then a pause as long
}  // namespace

ChannelService::ChannelService(service::Node& node)
    : node_(node),
      parameters_(node.bus()),
      core_(static_cast<std::uint16_t>(node.options().channel), node.options().virtual_time),
      requests_(node.bus(), topics::channel_request, topics::channel_reply),
      program_client_(node.bus(), topics::program_request, topics::program_reply),
      print_client_(node.bus(), topics::program_request, topics::program_reply),
      table_client_(node.bus(), topics::parameter_request, topics::parameter_reply),
      tools_(node.bus().reader(topics::tool_table)),
      offsets_(node.bus().reader(topics::work_offsets)),
      programs_(node.bus().reader(topics::program_list)),
      done_(node.bus().reader(topics::auxiliary_done)),
      signals_(node.bus().reader(topics::macro_signal)),
      cycle_replies_(node.bus().reader(topics::cycle_reply)),
      outputs_(node.bus().reader(topics::plc_outputs)),
      alarm_reader_(node.bus().reader(topics::alarm)),
      cluster_reader_(node.bus().reader(topics::cluster)),
      state_writer_(node.bus().writer(topics::channel_state)),
      variables_writer_(node.bus().writer(topics::variables)),
      auxiliary_writer_(node.bus().writer(topics::auxiliary_request)),
      cycle_writer_(node.bus().writer(topics::cycle_request)),
      stream_writer_(node.bus().writer(topics::stream_request)),
      hand_over_file_(node.options().state_directory + "/channel-" + std::to_string(node.options().channel) +
                      ".handover"),
      variables_file_(node.options().state_directory + "/channel-" + std::to_string(node.options().channel) +
                      ".variables"),
      record_file_(node.options().state_directory + "/channel-" + std::to_string(node.options().channel) +
                   ".program"),
      record_(record_file_) {
  const auto& services = node.options().machine.services;
  core_.set_cycle_service(std::any_of(services.begin(), services.end(), [](const auto& s) {
    return s.service == machine::service::measurement.name;
  }));
  replicas_ = stream::ReplicaWatch(node.options().machine.services, service::monotonic_seconds());
  if (!replicas_.replicas().empty()) progress_reader_.emplace(node.bus().reader(topics::stage_progress));
  if (node.options().virtual_time) recording_reader_.emplace(node.bus().reader(topics::recording_progress));
  std::ifstream boot(node.options().state_directory + "/cluster.boot");
  std::getline(boot, boot_);
  read_bodies();
  read_variables();
  read_record();
  read_hand_over();
}

void ChannelService::read_bodies() {
  const auto& directory = node_.options().machine.directory;
  const auto mode = machine::load_collision_mode(directory);
  if (mode != machine::CollisionMode::off) core_.guard(mode, collision_guard::load_bodies_text(directory));
}

void ChannelService::watch_text() {
  const auto channel = static_cast<std::uint32_t>(node_.options().channel);
  const double now = service::monotonic_seconds();
  if (!core_.waits_for_text()) {
    if (text_missing_since_ < 0) node_.alarms().clear(alarm::text_late, channel);
    text_missing_since_ = 0;
  } else if (text_missing_since_ == 0) {
    text_missing_since_ = now;
  } else if (text_missing_since_ > 0 && now - text_missing_since_ > text_timeout) {
    node_.alarms().raise(alarm::text_late, channel,
                         "The program's text does not arrive: see the program service");
    text_missing_since_ = -1;  // the alarm is raised
  }
}

void ChannelService::change_tables() {
  if (auto reply = table_client_.poll()) core_.on_table_changed(reply->accepted ? "" : reply->reason);
  if (auto request = core_.take_table_request()) table_client_.send(std::move(*request));
}

void ChannelService::print_lines() {
  if (const auto reply = print_client_.poll()) core_.on_printed(*reply);
  if (auto request = core_.take_print_request()) print_client_.send(std::move(*request));
}

void ChannelService::watch_cycle() {
  const double now = service::monotonic_seconds();
  if (!core_.cycle_unheard()) {
    cycle_unheard_since_ = -1;
  } else if (cycle_unheard_since_ < 0) {
    cycle_unheard_since_ = now;
  } else if (now - cycle_unheard_since_ > cycle_timeout) {
    core_.give_up_cycle();
    cycle_unheard_since_ = -1;
  }
}

void ChannelService::start_stream() {
  node_.bus().set_depth({stream::stream_depth(core_.machine().stream(node_.options().virtual_time), 1)});
  batch_writer_.emplace(node_.bus().writer(topics::path_batch));
  present_reader_.emplace(stream::present_reader(node_.bus(), topics::feedback));
  feedback_reader_.emplace(node_.bus(), topics::feedback);
}

void ChannelService::tell_unreferenced() {
  std::set<std::uint16_t> axes;
  for (const auto& [instance, number, axis] : unreferenced_) axes.insert(static_cast<std::uint16_t>(axis));
  core_.set_unreferenced(std::move(axes));
}

void ChannelService::watch_alarms() {
  idl::service::Alarm alarm;
  bool news = false;
  while (alarm_reader_.take(alarm)) {
    const AlarmKey key{alarm.instance, alarm.number, alarm.part};
    if (alarm.active && alarm.number == alarm::not_homed.number)
      unreferenced_.insert(key);
    else
      unreferenced_.erase(key);
    const bool holds = alarm.active && alarm.reaction != idl::service::Reaction::SHOW;
    if (holds)
      holding_alarms_[key] = "Alarm " + std::to_string(alarm.number) + ": " + alarm.text;
    else
      holding_alarms_.erase(key);
    news = true;
  }
  idl::plc::Outputs outputs;
  while (outputs_.take(outputs)) {
    take_outputs(outputs);
    news = true;
  }
  if (!news) return;
  tell_unreferenced();
  set_holds();
}

// Cycle start continues behind missing setpoints, and the drive ends the alarm when it goes on. It stops all
// axes by itself: no channel need hold them.
void ChannelService::set_holds() {
  std::string hold, stopped;
  for (const auto& [key, text] : holding_alarms_) {
    auto& why = key[1] == alarm::setpoint_missing.number ? stopped : hold;
    if (why.empty()) why = text;
  }
  if (hold.empty() && plc_hold_) hold = "Feed hold of the PLC";
  core_.set_drive_stopped(stopped);
  core_.set_hold(hold);
}

// A recording must tell at which cycle it took effect, as of a request: the answer is that of a client that
// no other process has, and the number is the tick of the outputs.
void ChannelService::take_outputs(const idl::plc::Outputs& outputs) {
  const auto channel = static_cast<std::size_t>(node_.options().channel);
  const auto control =
      channel < outputs.channels.size() ? outputs.channels[channel] : idl::plc::ChannelControl{};
  if (plc_hold_ == outputs.feed_hold && core_.control() == control) return;
  plc_hold_ = outputs.feed_hold;
  core_.set_control(control);
  idl::channel::ChannelRequest own;
  own.client = 1 + channel;
  own.number = outputs.tick;
  requests_.reply(own, {0, 0, true, 0, "", core_.link().next()});
  changed_ = true;
}

// Replicas: a start waits for both; in virtual time neither is left farther behind than twice what may be
// written ahead.
void ChannelService::watch_replicas() {
  if (!progress_reader_) return;
  const double now = service::monotonic_seconds();
  idl::stream::StageProgress progress;
  while (progress_reader_->take(progress))
    if (progress.channel == node_.options().channel) replicas_.update(progress, now);
  const auto ahead = core_.machine().stream(node_.options().virtual_time).ahead;
  for (const auto& change : replicas_.evaluate(ahead, now)) {
    const auto part = stream::replica_part(change.stage, change.number);
    if (change.lost)
      node_.alarms().raise(alarm::redundancy_lost, part,
                           "Replica " + std::to_string(change.number) + " of " +
                               stream::stage_name(change.stage) + " was dropped: no progress for 0.1 s",
                           core_.link().executed());
    else
      node_.alarms().clear(alarm::redundancy_lost, part);
  }
  core_.set_replicas(replicas_.may_start(now),
                     node_.options().virtual_time ? replicas_.floor() : stream::ReplicaWatch::everywhere);
}

// Virtual time has no clock to keep up with, so a recording of it is complete on any computer.
void ChannelService::watch_recorders() {
  if (!recording_reader_) return;
  idl::stream::RecordingProgress progress;
  while (recording_reader_->take(progress)) recorders_.update(progress);
  const auto next = core_.link().next() + core_.machine().stream(true).batch;
  auto limit = recorders_.limit(next, service::monotonic_seconds());
  if (next > limit && recording_reader_->matched() == 0) {  // the last recorder has ended
    recorders_ = {};
    limit = RecorderWatch::everywhere;
  }
  core_.set_limit(limit);
}

// Who has the reply finds no older state; a recording finds the reply before the cycles it acts on.
void ChannelService::answer_requests() {
  idl::channel::ChannelRequest request;
  std::vector<std::pair<idl::channel::ChannelRequest, idl::channel::ChannelReply>> answers;
  while (requests_.take(request)) {
    if (request.channel != node_.options().channel) continue;
    const bool interrupted = core_.states().in<Interrupted>();
    const auto answer = core_.unusable() ? UnusableParameters::handle(core_, request) : core_.handle(request);
    if (interrupted && !core_.states().in<Interrupted>())
      node_.alarms().clear(alarm::interrupted, static_cast<std::uint32_t>(node_.options().channel));
    answers.push_back(
        {request, {0, 0, answer.accepted, answer.alarm, answer.reason.substr(0, 256), core_.link().next()}});
  }
  if (answers.empty()) return;
  changed_ = true;
  publish();
  for (auto& [asked, reply] : answers) requests_.reply(asked, std::move(reply));
}

void ChannelService::fetch_text() {
  if (auto reply = program_client_.poll()) {
    if (reply->accepted)
      core_.deliver(wanted_.name, wanted_.offset, std::move(reply->data));
    else
      core_.chunk_failed(wanted_.name);
  }
  if (program_client_.busy()) return;
  const auto chunk = core_.wanted();
  if (!chunk) return;
  wanted_ = {};
  wanted_.operation = idl::program::Operation::READ;
  wanted_.name = chunk->name;
  wanted_.revision = chunk->revision;
  wanted_.offset = chunk->offset;
  wanted_.length = ProgramText::chunk_size;
  program_client_.send(wanted_);
}

void ChannelService::drain() {
  if (parameters_.poll()) {
    core_.set_parameters(parameters_.newest());
    unusable_.show(core_, node_.options().channel, node_.alarms());
  }
  idl::parameters::ToolTable tools;
  while (tools_.take(tools)) core_.set_tools(tools), have_tools_ = true;
  idl::parameters::WorkOffsets offsets;
  while (offsets_.take(offsets)) core_.set_offsets(offsets), have_offsets_ = true;
  idl::program::ProgramList list;
  while (programs_.take(list)) core_.set_programs(list), have_programs_ = true;
  idl::plc::AuxiliaryDone done;
  while (done_.take(done))
    if (done.channel == node_.options().channel) core_.on_auxiliary_done(done);
  idl::plc::MacroSignal signal;
  while (signals_.take(signal))
    if (signal.channel == node_.options().channel) core_.on_macro_signal(signal);
  CycleReply cycle;
  while (cycle_replies_.take(cycle)) core_.on_cycle_reply(cycle);
  idl::service::Cluster cluster;
  while (cluster_reader_.take(cluster)) core_.set_ready(cluster.ready), have_cluster_ = true;
  watch_alarms();
}

// The history of the drive's feedback arrives before its newest sample, on a busy computer much before it. To
// continue from an older cut would execute a part of the path twice. A reader without history gets the
// newest.
void ChannelService::recover() {
  if (core_.recovered() || !core_.link().has_feedback()) return;
  if (!have_present_) have_present_ = present_reader_->take(present_);
  const bool caught_up = have_present_ && feedback_.tick >= present_.tick &&
                         feedback_.first + feedback_.count >= present_.first + present_.count;
  if (!caught_up && (have_present_ || service::monotonic_seconds() - last_feedback_ < history_pause)) return;
  if (hand_over_) core_.take_over(*hand_over_);
  hand_over_.reset();
  core_.recover();
  if (core_.recovered()) present_reader_.reset();
}

service::SnapshotAnswer ChannelService::snapshot() {
  using idl::service::SnapshotKind;
  service::SnapshotAnswer answer{SnapshotKind::LATER, "", ""};
  bus::Json state = {{"core", core_.explicit_state(answer.detail)}};
  if (!answer.detail.empty()) return answer;
  state["holding_alarms"] = snapshot::written(holding_alarms_);
  state["not_homed"] = unreferenced_;
  state["plc_hold"] = plc_hold_;
  return {SnapshotKind::GIVEN, "", bus::text_of(state)};
}

void ChannelService::continue_from_snapshot() {
  const auto& state = *node_.snapshot();
  core_.continue_from(state.at("core"));
  snapshot::read(state.at("holding_alarms"), holding_alarms_);
  unreferenced_ = state.value("not_homed", std::set<AlarmKey>());
  tell_unreferenced();
  plc_hold_ = state.at("plc_hold").get<bool>();
  present_reader_.reset();
}

void ChannelService::pump() {
  drain();
  if (core_.unusable()) answer_requests();
  if (!core_.configured() || !have_tools_ || !have_offsets_ || !have_programs_) return publish();
  if (!batch_writer_) {
    start_stream();
    if (node_.snapshot() != nullptr) continue_from_snapshot();
  }
  while (feedback_reader_->take(feedback_)) {
    ++messages_in_;
    last_feedback_ = service::monotonic_seconds();
    core_.on_feedback(feedback_);
  }
  recover();
  watch_replicas();
  watch_recorders();
  answer_requests();
  fetch_text();
  core_.advance();
  read_on();
  if (const auto request = core_.take_stream_request()) stream_writer_.write(*request);
  // Feedback that is ahead of the drive must not let a whole program be computed without a sign of life.
  for (std::size_t n = 0; n < most_batches && core_.produce(batch_); ++n) {
    batch_writer_->write(batch_);
    ++messages_out_;
  }
  if (const auto auxiliary = core_.take_auxiliary()) auxiliary_writer_.write(*auxiliary);
  if (const auto cycle = core_.take_cycle_request()) cycle_writer_.write(*cycle);
  change_tables();
  print_lines();
  save_variables();
  if (core_.recovered()) keep_record();
  watch_text();
  watch_cycle();
  report_events();
  publish();
}

void ChannelService::read_on() {
  const double began = service::monotonic_seconds();
  if (began < read_on_at_) return;
  double now = began;
  while (now - began < longest_read && core_.read_on()) now = service::monotonic_seconds();
  read_on_at_ = now + (now - began);
}

void ChannelService::report_events() {
  const auto channel = static_cast<std::uint32_t>(node_.options().channel);
  for (const auto& event : core_.take_events())
    node_.alarms().report(*event.alarm, channel, event.text, core_.link().executed());
  if (!core_.held_at_line()) node_.alarms().clear(alarm::search_done, channel);
}

void ChannelService::publish() {
  const double now = service::monotonic_seconds();
  if (!changed_ && last_run_ == core_.run_state() && now - last_state_ < 0.05) return;
  state_writer_.write(core_.state());
  last_state_ = now;
  last_run_ = core_.run_state();
  changed_ = false;
}

service::Health ChannelService::health() const {
  using idl::service::Lifecycle;
  service::Health health;
  const bool tables = have_tools_ && have_offsets_ && have_programs_;
  health.lifecycle = core_.unusable()                 ? Lifecycle::FAULT
                     : !core_.configured() || !tables ? Lifecycle::UNCONFIGURED
                     : !core_.recovered()             ? Lifecycle::INACTIVE
                     : have_cluster_                  ? Lifecycle::ACTIVE
                                                      : Lifecycle::INACTIVE;
  health.detail = core_.unusable()      ? core_.unusable()->text
                  : !core_.configured() ? "waiting for parameters"
                  : !tables             ? "waiting for tools, offsets and programs"
                  : !core_.recovered()  ? "waiting for the drive"
                  : !have_cluster_      ? "waiting for the launcher"
                                        : "";
  health.messages_in = messages_in_;
  health.messages_out = messages_out_;
  health.revision = core_.machine().revision();
  return health;
}

}  // namespace trunnion::channel
