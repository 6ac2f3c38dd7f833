// SPDX-License-Identifier: Apache-2.0
#include "test/fake_cluster.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bus/contract.hpp"
#include "storage/crc32.hpp"

namespace trunnion::gateway {
namespace {

constexpr std::size_t axes = 5;
constexpr std::uint32_t channel_instance = 1;

std::uint32_t lines_of(const std::vector<std::uint8_t>& text) {
  return static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
}

idl::program::ProgramEntry entry_of(const std::string& name, const std::vector<std::uint8_t>& text) {
  return {name, 1, text.size(), storage::crc32(0, text), lines_of(text), 1};
}

std::vector<std::uint8_t> circle_program() {
  std::string text =
      "%1\n(Circle with a tilting table)\nG54 G90 G17\nT3 M6\nS8000 M3\nG43.4 H3\nG0 X50 Y0 Z20\n";
  for (int i = 0; i <= 360; i += 2) {
    char line[96];
    std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f Z%.3f A%.3f C%d F1800\n", 50 * std::cos(i * M_PI / 180),
                  50 * std::sin(i * M_PI / 180), 5 * std::sin(i * M_PI / 60), -20.0, i);
    text += line;
  }
  text += "G49\nM30\n";
  return {text.begin(), text.end()};
}

}  // namespace

FakeCluster::FakeCluster(const bus::NetworkSettings& network)
    : bus_(bus::Vendor::cyclonedds, network),
      channel_server_(bus_, topics::channel_request, topics::channel_reply),
      panel_server_(bus_, topics::panel_request, topics::panel_reply),
      parameter_server_(bus_, topics::parameter_request, topics::parameter_reply),
      program_server_(bus_, topics::program_request, topics::program_reply),
      alarm_reset_(bus_.reader(topics::alarm_reset)),
      announcement_(bus_.writer(topics::announcement)),
      service_state_(bus_.writer(topics::service_state)),
      alarm_(bus_.writer(topics::alarm)),
      cluster_(bus_.writer(topics::cluster)),
      channel_state_(bus_.writer(topics::channel_state)),
      feedback_(bus_.writer(topics::feedback)),
      outputs_(bus_.writer(topics::plc_outputs)),
      image_(bus_.writer(topics::plc_image)),
      parameter_set_(bus_.writer(topics::parameter_set)),
      tool_table_(bus_.writer(topics::tool_table)),
      work_offsets_(bus_.writer(topics::work_offsets)),
      program_list_(bus_.writer(topics::program_list)),
      measurement_state_(bus_.writer(topics::measurement_state)),
      measurement_result_(bus_.writer(topics::measurement_result)) {
  programs["CIRCLE.NC"] = circle_program();
  publish_once();
  publish_programs();
  started_ = last_motion_ = service::monotonic_seconds();
}

void FakeCluster::publish_once() {
  announcement_.write(
      {channel_instance, "channel", "cyclonedds", "localhost", getpid(), bus::contract_of("channel"), "0"});
  beat_.instance = channel_instance;
  beat_.service = "channel";
  beat_.vendor = "cyclonedds";
  beat_.pid = getpid();
  beat_.lifecycle = idl::service::Lifecycle::ACTIVE;
  beat_.detail = "ready";

  idl::service::Cluster cluster{};
  cluster.machine = "Test mill 5X";
  cluster.ready = true;
  cluster.lead = 32;
  cluster.services.push_back({channel_instance, "channel", 0, "cyclonedds", getpid(), 0, true});
  cluster.services.push_back({7, "compensation", 1, "fastdds", 0, 3, false});
  cluster_.write(cluster);

  warning_.instance = channel_instance;
  warning_.number = 102;
  warning_.active = true;
  warning_.severity = idl::service::Severity::WARNING;
  warning_.source = "channel";
  warning_.text = "Redundancy lost: compensation runs without its second replica";
  warning_.occurrences = 1;
  alarm_.write(warning_);

  idl::measurement::MeasurementResult result;
  result.measurement = 1;
  result.poses.push_back({{-60, 0, 0, 0, 0, 0}, {}, {60, 40, -300}, {0, 0.02, 0}, {0.001, 0, -0.002}, 25});
  result.valid = true;
  measurement_result_.write(result);
  idl::measurement::MeasurementState measurement;
  measurement.measurement = 1;
  measurement.phase = idl::measurement::Phase::WAITING;
  measurement.poses = measurement.complete = 1;
  measurement.may_confirm = true;
  measurement_state_.write(measurement);

  channel.name = "Mill";
  channel.mode = idl::channel::Mode::AUTO;
  channel.program = "CIRCLE.NC";
  channel.program_revision = 1;
  channel.lines_total = lines_of(programs["CIRCLE.NC"]);
  channel.modal = {"G1", "G17", "G90", "G21", "G40", "G54", "G94", "G43.4"};
  channel.programmed_feed = 1800;
  channel.spindle_programmed = 8000;
  channel.feed_override = channel.rapid_override = channel.spindle_override = 1;
  channel.tool = channel.length_offset = 3;
  channel.tool_length = 112.25;
  channel.rtcp = channel.homed = true;
  channel.axes = {0, 1, 2, 4, 6};
  channel.letters = "XYZAC";
  channel.machine = channel.workpiece = channel.distance_to_go = std::vector<double>(axes, 0.0);
  channel.handwheel_offset = channel.machine;
  channel.locked.assign(axes, 0);

  parameters_.revision = 1;
  const char* const letters[] = {"X", "Y", "Z", "", "A", "", "C"};
  for (std::uint32_t a = 0; a < 7; ++a)
    if (*letters[a] != 0) {
      parameters_.values.push_back({100000 + 1000 * a, 0, letters[a]});
      if (a > 2) parameters_.values.push_back({100001 + 1000 * a, 3, ""});  // rotary
    }
  parameter_set_.write(parameters_);
  tool_table_.write({0, 1, {{3, 112.25, 0, 5, 0, "Ball nose 10"}, {4, 98.5, -0.02, 8, 0.01, "End mill 16"}}});
  offsets_.revision = 1;
  offsets_.offsets.push_back({0, 0, {-250, -180, -320.5, 0, 0, 0, 0, 0, 0}});
  work_offsets_.write(offsets_);
  plc_.axis_enable.assign(7, 1);
  outputs_.write(plc_);
  idl::plc::Image image{};
  image.scan = 1;
  image.x.assign(512, 0);
  image.y = image.r = image.x;
  image.x[3] = 0x81;
  image.f.assign(512, 7);
  image.g.assign(512, 0);
  image.b.assign(512, -1);
  image_.write(image);
}

void FakeCluster::publish_programs() {
  idl::program::ProgramList list{};
  list.revision = ++programs_revision_;
  for (const auto& [name, text] : programs) list.programs.push_back(entry_of(name, text));
  program_list_.write(list);
}

idl::channel::ChannelReply FakeCluster::apply(const idl::channel::ChannelRequest& request) {
  using idl::channel::CommandKind;
  using idl::channel::RunState;
  idl::channel::ChannelReply reply{};
  reply.accepted = true;
  reply.cycle = cycle_;
  switch (request.command) {
    case CommandKind::SET_MODE:
      channel.mode = request.mode;
      break;
    case CommandKind::CYCLE_START:
      channel.state = RunState::RUNNING;
      break;
    case CommandKind::FEED_HOLD:
      if (channel.state == RunState::RUNNING) channel.state = RunState::HELD;
      break;
    case CommandKind::RESET:
      channel.state = RunState::IDLE;
      break;
    case CommandKind::FEED_OVERRIDE:
      channel.feed_override = request.fraction;
      break;
    case CommandKind::RAPID_OVERRIDE:
      channel.rapid_override = request.fraction;
      break;
    case CommandKind::SPINDLE_OVERRIDE:
      channel.spindle_override = request.fraction;
      break;
    case CommandKind::FEED_OVERRIDE_STEP:
      channel.feed_override += request.fraction;
      break;
    case CommandKind::SINGLE_BLOCK:
      channel.single_block = request.on;
      break;
    case CommandKind::OPTIONAL_STOP:
      channel.optional_stop = request.on;
      break;
    case CommandKind::DRY_RUN:
      channel.dry_run = request.on;
      break;
    case CommandKind::AUXILIARY_LOCK:
      channel.auxiliary_lock = request.on;
      break;
    case CommandKind::AXIS_LOCK:
      for (std::size_t i = 0; i < channel.locked.size(); ++i)
        channel.locked[i] = (request.axes >> i & 1u) != 0 ? 1 : 0;
      break;
    case CommandKind::BLOCK_SKIP:
      channel.block_skip = request.levels;
      break;
    case CommandKind::HANDWHEEL_OFFSET:
      channel.handwheel_offset_on = request.on;
      break;
    case CommandKind::HANDWHEEL:
      channel.handwheel_offset.at(request.axis) += request.counts * request.increment;
      break;
    case CommandKind::START_FROM_LINE:
      channel.state = RunState::HELD;
      channel.line = request.line;
      channel.detail = "cycle start: S1000 M3, approach Z20.0000, then X25.0000";
      break;
    case CommandKind::MDI_LINE:
      if (std::strchr("GXYZMTSFN", request.block[0]) == nullptr)
        return {0, 0, false, 1001, "unknown word in '" + request.block + "'", cycle_};
      break;
    case CommandKind::SELECT_PROGRAM:
      if (!programs.contains(request.program))
        return {0, 0, false, 141, "no program " + request.program, cycle_};
      channel.program = request.program;
      channel.lines_total = lines_of(programs[request.program]);
      break;
    default:
      break;
  }
  return reply;
}

void FakeCluster::answer_channel() {
  if (channel_hangs) return;
  idl::channel::ChannelRequest request;
  while (channel_server_.take(request)) {
    channel_requests.push_back(request);
    if (channel_is_silent) continue;
    const auto reply = apply(request);
    channel_state_.write(channel);
    channel_server_.reply(request, reply);
  }
}

void FakeCluster::answer_program() {
  using idl::program::Operation;
  idl::program::ProgramRequest request;
  while (program_server_.take(request)) {
    idl::program::ProgramReply reply{};
    reply.accepted = true;
    const auto stored = programs.find(request.name);
    auto& upload = uploads_[request.client];
    switch (request.operation) {
      case Operation::READ:
        reply.accepted = stored != programs.end();
        if (!reply.accepted) break;
        reply.entry = {request.name, 1, stored->second.size(), 0, 0};
        reply.offset = request.offset;
        if (request.offset < stored->second.size()) {
          const auto from = stored->second.begin() + static_cast<std::ptrdiff_t>(request.offset);
          const auto left = stored->second.size() - request.offset;
          reply.data.assign(from,
                            from + static_cast<std::ptrdiff_t>(std::min<std::size_t>(left, request.length)));
        }
        break;
      case Operation::RESOLVE:
        reply.accepted = stored != programs.end();
        if (reply.accepted) reply.entry = entry_of(request.name, stored->second);
        break;
      case Operation::BEGIN_UPLOAD:
        upload.clear();
        break;
      case Operation::WRITE:
        reply.accepted = request.offset == upload.size();
        if (request.offset + request.data.size() > largest_program) reply.accepted = false, reply.alarm = 150;
        largest_write = std::max<std::uint64_t>(largest_write, request.data.size());
        upload.insert(upload.end(), request.data.begin(), request.data.end());
        break;
      case Operation::COMMIT_UPLOAD:
        reply.entry = entry_of(request.name, upload);
        reply.accepted = reply.entry.crc32 == request.crc32 && reply.entry.size == request.size;
        if (reply.accepted) {
          programs[request.name] = upload;
          stored_by[request.name] = request.role;
          publish_programs();
        }
        uploads_.erase(request.client);
        break;
      case Operation::REMOVE:
        reply.accepted = programs.erase(request.name) == 1;
        publish_programs();
        break;
      default:
        uploads_.erase(request.client);
        break;
    }
    if (!reply.accepted) {
      if (reply.alarm == 0) reply.alarm = 141;
      reply.reason = "not possible with " + request.name;
    }
    program_server_.reply(request, reply);
  }
}

void FakeCluster::answer_others() {
  idl::plc::PanelRequest panel;
  while (panel_server_.take(panel)) {
    panel_requests.push_back(panel);
    plc_.emergency_stop = panel.kind == idl::plc::PanelRequestKind::PRESS_EMERGENCY_STOP;
    outputs_.write(plc_);
    if (plc_.emergency_stop) channel.state = idl::channel::RunState::IDLE;
    panel_server_.reply(panel, {0, 0, true, ""});
  }
  idl::parameters::ParameterRequest request;
  while (parameter_server_.take(request)) {
    parameter_requests.push_back(request);
    idl::parameters::ParameterReply reply{};
    reply.accepted = true;
    for (const auto& value : request.values)
      if (std::abs(value.value) > 1000000) {
        reply.accepted = false;
        reply.alarm = 160;
        reply.reason = std::to_string(value.number) + " must be from 1 to 1000000";
      }
    if (reply.accepted) {
      for (const auto& value : request.values) {
        std::erase_if(parameters_.values, [&](const auto& old) { return old.number == value.number; });
        const auto place = std::find_if(parameters_.values.begin(), parameters_.values.end(),
                                        [&](const auto& old) { return old.number > value.number; });
        parameters_.values.insert(place, value);
      }
      parameters_.previous = parameters_.revision++;
      parameter_set_.write(parameters_);
      for (const auto& offset : request.offsets) {
        offsets_.offsets = {offset};
        ++offsets_.revision;
        work_offsets_.write(offsets_);
      }
    }
    reply.revision = parameters_.revision;
    parameter_server_.reply(request, reply);
  }
  idl::service::AlarmReset reset;
  while (alarm_reset_.take(reset)) {
    alarm_resets.push_back(reset);
    warning_.active = false;
    alarm_.write(warning_);
  }
}

std::vector<double> FakeCluster::positions() const {
  return {50 * std::cos(path_), 50 * std::sin(path_), 5 * std::sin(3 * path_), -20, path_ * 180 / M_PI};
}

void FakeCluster::publish_motion(double now) {
  const double elapsed = now - last_motion_;
  last_motion_ = now;
  const bool running = channel.state == idl::channel::RunState::RUNNING;
  channel.feed = running ? 1800 * channel.feed_override : 0;
  idl::stream::Feedback batch{};
  batch.first = cycle_;
  batch.count = at_rest ? 0 : std::min(64u, static_cast<std::uint32_t>(elapsed * 1000) + 1);
  if (at_rest) ++batches_at_rest;
  batch.axis_count = axes;
  for (std::uint32_t i = 0; i < batch.count; ++i) {
    if (running)
      path_ += channel.feed_override * 0.001 * 30 / 50;  // 30 mm/s on a radius of 50 mm, in radians
    const auto position = positions();
    for (std::size_t a = 0; a < axes; ++a) {
      batch.commanded.push_back(position[a]);
      batch.actual.push_back(position[a] -
                             (running ? 0.012 * std::sin(path_ * static_cast<double>(a + 1)) : 0));
    }
    ++cycle_;
  }
  batch.position = positions();
  if (batch.count > 0) batch.position.assign(batch.actual.end() - axes, batch.actual.end());
  batch.enabled.assign(axes, 1);
  batch.spindle_speed = {running ? 7994.0 : 0.0};
  batch.tick = cycle_;
  feedback_.write(batch);

  channel.cycle = cycle_;
  channel.machine = batch.position;
  channel.workpiece = channel.machine;
  channel.workpiece[2] += 320.5;
  channel.distance_to_go = {running ? 0.4 : 0, running ? -0.2 : 0, 0, 0, running ? 1.2 : 0};
  channel.line = 8 + static_cast<std::uint32_t>(std::fmod(path_ / (2 * M_PI), 1) * 181);
  channel_state_.write(channel);
}

void FakeCluster::step() {
  answer_channel();
  answer_program();
  answer_others();
  const double now = service::monotonic_seconds();
  if (now - last_motion_ >= 0.02) publish_motion(now);
  if (now - last_beat_ >= 0.25) {
    last_beat_ = now;
    ++beat_.beats;
    beat_.uptime = now - started_;
    beat_.messages_per_second = 250;
    service_state_.write(beat_);
  }
}

}  // namespace trunnion::gateway
