// SPDX-License-Identifier: Apache-2.0
#include "recorded_runs/recorded_run.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <utility>

#include "cluster/child_process.hpp"
#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/machine_session.hpp"
#include "cluster/stored_program.hpp"
#include "identification/true_machine.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "machine/stream_settings.hpp"
#include "machine_check/machine_check.hpp"
#include "recorded_runs/held_channels.hpp"
#include "recording/file_stream.hpp"
#include "report/capture.hpp"
#include "service/network.hpp"

namespace trunnion::recorded_runs {
namespace fs = std::filesystem;
namespace {

using idl::channel::CommandKind;
using idl::channel::RunState;

constexpr double activation_timeout = 10;  // s from the reset until parameters are active

// Stops what a run has started, however it ends.
class Recorder {
 public:
  Recorder(const std::string& file, const cluster::RunningCluster& cluster)
      : process_(options_for(file, cluster)) {
    if (const auto line = process_.read_line(); !line.starts_with("recording"))
      throw std::runtime_error("the recorder did not start" + (line.empty() ? "" : ": " + line));
  }
  ~Recorder() { stop(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  /// Returns when the file is complete.
  void stop() { process_.stop(longest_write); }

 private:
  static constexpr double longest_write = 60;            // s
  static constexpr const char* needed_megabytes = "20";  // a recording of one program is small

  static cluster::ChildOptions options_for(const std::string& file, const cluster::RunningCluster& cluster) {
    cluster::ChildOptions options;
    options.arguments = {cluster::binary_directory() + "/trunnion-recorder",
                         "--output",
                         file,
                         "--machine",
                         cluster.machine,
                         "--domain",
                         std::to_string(cluster.run.domain),
                         "--parent-bound",
                         "--free-space",
                         needed_megabytes};
    for (auto& argument : service::network_arguments(cluster.network))
      options.arguments.push_back(std::move(argument));
    options.read_from = 1;
    return options;
  }

  cluster::ChildProcess process_;
};

void stop_when_interrupted(const RunNews& news) {
  if (news.interrupted && news.interrupted())
    throw std::runtime_error("interrupted; the cluster of the run was stopped");
}

class ClusterGuard {
 public:
  explicit ClusterGuard(cluster::RunningCluster cluster) : cluster_(std::move(cluster)) {}
  ClusterGuard(ClusterGuard&& other) noexcept
      : cluster_(std::move(other.cluster_)), running_(std::exchange(other.running_, false)) {}
  ~ClusterGuard() { stop(); }
  ClusterGuard(const ClusterGuard&) = delete;
  ClusterGuard& operator=(const ClusterGuard&) = delete;
  const cluster::RunningCluster& get() const { return cluster_; }
  void stop() {
    if (!running_) return;
    running_ = false;
    try {
      cluster::stop_cluster(cluster_.run);
    } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
    }
  }

 private:
  cluster::RunningCluster cluster_;
  bool running_ = true;
};

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ": cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// A file is uploaded; another name must be in the store.
std::string place_program(cluster::Client& client, const machine::MachineConfig& machine,
                          const std::string& program) {
  if (fs::is_regular_file(program)) {
    const auto name = fs::path(program).filename().string();
    client.upload(name, read_file(program));
    return name;
  }
  if (const auto stored = cluster::find_program(client.newest(topics::program_list), program))
    return stored->name;
  throw std::runtime_error("program '" + program + "': no such file, and machine " + machine.name +
                           " has none of this name");
}

// Requests are not kept for late readers: the recorder must know of our writers before the first one, or the
// recording has replies to requests that it does not have.
void await_recorder(cluster::Client& client) {
  const auto programs = client.bus().backend().writer(bus::describe(topics::program_request), {false, 1});
  const auto channels = client.bus().backend().writer(bus::describe(topics::channel_request), {false, 1});
  for (int i = 0; i < 2000 && (programs->matched() < 2 || channels->matched() < 2); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

// Searches the line; the cycle start that follows goes on from there. The program may as well have an alarm.
void search_line(cluster::Client& client, std::uint32_t line, const RunNews& news) {
  client.start_from_line(0, line);
  auto states = client.reader_from_now(topics::channel_state);
  const double until = service::monotonic_seconds() + 60;
  bool failed = false;
  while (service::monotonic_seconds() < until && !failed) {
    stop_when_interrupted(news);
    idl::channel::ChannelState state;
    while (states.take(state)) {
      if (state.channel != 0) continue;
      if (state.state == RunState::HELD) return;
      failed = state.state == RunState::IDLE;
    }
    client.bus().signal().wait(0.02);
  }
  throw std::runtime_error("line " + std::to_string(line) +
                           " was not found: see the alarms of the recording");
}

struct Execution {
  std::string alarm;     // the first one, or empty
  bool starved = false;  // the drive has stopped because setpoints were missing
  bool ended = false;    // every program came to its end
};

// Starts every channel, or continues it, and waits until all are idle again.
Execution execute(cluster::Client& client, std::size_t channels, const RunOptions& options) {
  const double timeout = options.timeout;
  const auto& news = options.news;
  if (options.dry_run)
    for (std::uint16_t c = 0; c < channels; ++c)
      client.channel({.channel = c, .command = CommandKind::DRY_RUN, .on = true});
  if (options.from_line != 0) search_line(client, options.from_line, news);
  auto alarms = client.bus().reader(topics::alarm);
  std::vector<idl::channel::ChannelState> newest(channels);
  std::vector<bool> done(channels);
  HeldChannels held(channels);
  for (std::uint16_t c = 0; c < channels; ++c) client.channel(c, CommandKind::CYCLE_START);
  auto states = client.reader_from_now(topics::channel_state);
  const double began = service::monotonic_seconds();
  double drawn = 0;
  Execution result;
  auto& alarm = result.alarm;
  while (std::find(done.begin(), done.end(), false) != done.end()) {
    client.bus().signal().wait(0.05);
    stop_when_interrupted(news);
    idl::channel::ChannelState state;
    while (states.take(state)) {
      if (state.channel >= channels) continue;
      done[state.channel] = state.state == RunState::IDLE;
      newest[state.channel] = state;
    }
    idl::service::Alarm a;
    while (alarms.take(a)) {
      if (!a.active || a.severity < idl::service::Severity::ERROR) continue;
      result.starved |= a.number == alarm::setpoint_missing.number;
      if (alarm.empty()) alarm = "alarm " + std::to_string(a.number) + " (" + a.source + "): " + a.text;
    }
    if (alarm.empty())
      for (const auto c : held.newly(newest))
        if (news.stopped) news.stopped(newest[c], client.newest(topics::cluster).domain);
    const double now = service::monotonic_seconds();
    if (news.progress && now - drawn > 0.1) {
      news.progress(newest, now - began);
      drawn = now;
    }
    const bool stuck = std::any_of(newest.begin(), newest.end(), [](const auto& s) {
      return s.state == RunState::INTERRUPTED || s.state == RunState::HELD;
    });
    if (stuck && !alarm.empty()) break;
    if (now - began > timeout) {
      alarm = "the program did not end within " + std::to_string(static_cast<int>(timeout)) + " s";
      break;
    }
  }
  result.ended = std::find(done.begin(), done.end(), false) == done.end();
  if (news.progress) news.progress(newest, service::monotonic_seconds() - began);
  if (news.progress_end) news.progress_end();
  return result;
}

// Acknowledges all alarms and waits until none is active that would stop a start.
void acknowledge(cluster::Client& client) {
  client.reset_alarms();
  auto alarms = client.bus().reader(topics::alarm);
  std::set<std::tuple<std::string, std::uint32_t, std::uint32_t>> active;
  const double began = service::monotonic_seconds();
  for (double waited = 0; waited < 2 && (waited < 0.2 || !active.empty());
       waited = service::monotonic_seconds() - began) {
    client.bus().signal().wait(0.05);
    for (idl::service::Alarm a; alarms.take(a);) {
      const std::tuple key(a.source, a.number, a.part);
      if (a.active && a.severity >= idl::service::Severity::ERROR)
        active.insert(key);
      else
        active.erase(key);
    }
  }
}

// As execute(), and goes on where the drive has stopped on the path because setpoints were missing, until
// `until`: the starved periods in the recording say so.
std::string execute_starved(cluster::Client& client, std::size_t channels, const RunOptions& options,
                            double until) {
  auto execution = execute(client, channels, options);
  while (execution.starved && !execution.ended && service::monotonic_seconds() < until) {
    acknowledge(client);
    execution = execute(client, channels, options);
  }
  return execution.starved ? "" : execution.alarm;
}

// A cluster for this run alone, on this computer, whatever hosts machine.yaml names.
cluster::UpOptions up_options(const std::string& directory, const RunOptions& options) {
  cluster::UpOptions up;
  up.machine = directory;
  up.vendor = options.vendor;
  up.executables = options.executables;
  up.state_directory = "temporary";
  up.own_domain = !options.domain;
  up.of_this_process = true;
  up.domain = options.domain;
  up.virtual_time = !options.real_time;
  up.with_gateway = false;
  up.one_host = true;
  return up;
}

// Its cluster is stopped with the guard.
ClusterGuard start_for(const std::string& directory, const RunOptions& options) {
  machine_check::require_good(directory);
  ClusterGuard cluster(cluster::start_cluster(up_options(directory, options)));
  stop_when_interrupted(options.news);
  return cluster;
}

void select_first(cluster::Client& client, const machine::MachineConfig& machine, const RunOptions& options) {
  const auto name = place_program(client, machine, options.programs.at(0));
  cluster::MachineSession(client, 0).select(name);
}

// As an import and a reset do.
void set_parameters(cluster::Client& client, const RunOptions& options) {
  idl::parameters::ParameterRequest request;
  request.operation = idl::parameters::Operation::IMPORT;
  request.who = options.who;
  for (const auto& [number, value] : options.parameters)
    request.values.push_back({number, value.value, value.text});
  client.parameter(std::move(request));
  client.channel(0, CommandKind::RESET);
  const double until = service::monotonic_seconds() + activation_timeout;
  for (;;) {
    const auto set = client.newest(topics::parameter_set);
    if (set.pending.empty()) return;
    if (service::monotonic_seconds() > until)
      throw std::runtime_error("parameter " + machine::number_text(set.pending.front().number) +
                               " is not active after a reset: it needs a restart of the cluster; write it "
                               "into parameters.yaml of the machine");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// Of a machine whose truth.yaml says what it is, else empty. The axes are cold.
report::TrueTip true_tip(const std::string& machine, std::uint16_t channel) {
  if (!fs::exists(machine + "/truth.yaml")) return {};
  const std::shared_ptr<const truth::PoseReport> report =
      identification::load_true_machine(machine, channel, {}).report;
  return [report](const language::AxisValues& loads, const std::array<int, 9>& approach, double tool_length) {
    truth::MachinePose pose;
    pose.positions = loads;
    pose.approach = approach;
    pose.tool_length = tool_length;
    return report->geometry().pose(pose).tip;
  };
}

}  // namespace

RunResult run_programs(const RunOptions& options) {
  const auto directory = cluster::find_machine(options.machine);
  const auto machine = machine::load_machine(directory, options.vendor);
  if (options.programs.size() > machine.channels)
    throw std::runtime_error("machine " + machine.name + " has " + std::to_string(machine.channels) +
                             " channel(s), " + std::to_string(options.programs.size()) +
                             " programs were given");
  RunResult result;
  auto cluster = start_for(directory, options);
  result.start_seconds = cluster.get().start_seconds;
  if (options.news.ready) options.news.ready(machine.name, cluster.get());
  std::vector<std::string> names, texts;
  {
    // The recorder has found the stream's writers before the program is in its place.
    Recorder recorder(options.recording, cluster.get());
    cluster::Client client(cluster.get().run.domain);
    await_recorder(client);
    if (!options.parameters.empty()) set_parameters(client, options);
    for (std::uint16_t c = 0; c < options.programs.size(); ++c) {
      names.push_back(place_program(client, machine, options.programs[c]));
      texts.push_back(client.download(names.back()));
      cluster::MachineSession(client, c).select(names.back());
    }
    const auto channels = options.programs.size();
    result.alarm = options.continue_starved ? execute_starved(client, channels, options,
                                                              service::monotonic_seconds() + options.timeout)
                                            : execute(client, channels, options).alarm;
    std::this_thread::sleep_for(
        std::chrono::milliseconds(100));  // what the stages wrote last is still on its way
    recorder.stop();
  }
  cluster.stop();
  for (std::uint16_t c = 0; c < names.size(); ++c) {
    report::ReportInputs inputs;
    inputs.program_name = names[c];
    inputs.program_text = texts[c];
    inputs.channel = c;
    inputs.true_tip = true_tip(directory, c);
    result.reports.push_back(report::make_report(options.recording, inputs));
    if (result.alarm.empty() && !result.reports.back().problem.empty())
      result.alarm = result.reports.back().problem;
  }
  return result;
}

RecordingCost measure_recording(const RunOptions& options, int rounds) {
  const auto directory = cluster::find_machine(options.machine);
  const auto machine = machine::load_machine(directory, options.vendor);
  auto cluster = start_for(directory, options);
  cluster::Client client(cluster.get().run.domain);
  select_first(client, machine, options);
  RecordingCost cost;
  for (int round = 0; round < 2 * rounds; ++round) {
    // Which of the two is first changes from round to round, as the machine may warm up or be shared.
    const bool record = (round % 2 == 1) != (round / 2 % 2 == 1);
    std::optional<Recorder> recorder;
    if (record) recorder.emplace(options.recording, cluster.get());
    const auto before = client.newest(topics::channel_state, 0).cycle;
    const double began = service::monotonic_seconds();
    if (const auto alarm = execute(client, 1, options).alarm; !alarm.empty()) throw std::runtime_error(alarm);
    const double seconds = service::monotonic_seconds() - began;
    recorder.reset();
    fs::remove(options.recording);
    const auto cycles = static_cast<double>(client.newest(topics::channel_state, 0).cycle - before);
    (record ? cost.with : cost.without).push_back(cycles / seconds);
  }
  return cost;
}

report::StreamTiming measure_real_time(const RunOptions& options, double seconds) {
  const auto directory = cluster::find_machine(options.machine);
  const auto machine = machine::load_machine(directory, options.vendor);
  auto cluster = start_for(directory, options);
  cluster::Client client(cluster.get().run.domain);
  select_first(client, machine, options);
  const auto parameters = machine::parameters_of(client.newest(topics::parameter_set));
  const machine::StreamSettings stream(parameters, false);
  report::StreamTiming timing(stream.lead, parameters.get(parameter::interpolation_cycle) * 1e-6);
  const double until = service::monotonic_seconds() + seconds;
  do {
    {
      Recorder recorder(options.recording, cluster.get());
      if (const auto alarm = execute_starved(client, 1, options, until); !alarm.empty())
        throw std::runtime_error(alarm);
      recorder.stop();
    }
    recording::FileSource source(options.recording);
    timing.add(report::read_capture(source, 0));
    fs::remove(options.recording);
  } while (service::monotonic_seconds() < until);
  return timing;
}

}  // namespace trunnion::recorded_runs
