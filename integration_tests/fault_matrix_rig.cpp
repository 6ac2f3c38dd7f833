// SPDX-License-Identifier: Apache-2.0
#include "fault_matrix_rig.hpp"

#include <sys/wait.h>

#include <cstdio>

#include "recording/file_stream.hpp"
#include "recording/mcap_reader.hpp"

namespace trunnion::integration {
namespace {

constexpr double ready_timeout = 40;  // s; on a busy machine a process takes some seconds to come up
constexpr double run_timeout = 120;   // s; a run takes two, but on a computer that others have nearly all of
constexpr double suspension = 2;      // s
constexpr int kept_tool = 77;
constexpr unsigned kept_number = 500;
constexpr double kept_value = 7.25;
const std::string kept_program = "keep.nc", kept_text = "(kept)\nG0 X1\nM30\n";
const std::string part_name = "part.nc";

}  // namespace

std::string part_program(int rounds) {
  std::string text = "#501=#501+1\nG21 G17 G90 G54\nG0 X0 Y0 A0 C0\nS1000 M3\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  // No way is gone twice, so that a place on the path is one time of the run.
  char line[128];
  for (int i = 0; i < rounds; ++i) {
    std::snprintf(line, sizeof line, "X%.2f Y%.2f A%.2f C40 F3000\nX%.2f Y%.2f A%.2f C-20\n", 60 - 0.5 * i,
                  30 - 1.1 * i, 20 - 0.3 * i, -60 + 0.4 * i, -30 + 0.7 * i, -10 + 0.2 * i);
    text += line;
  }
  return text + "X0 Y0 A0 C0\nG49\nM5\nG53 G0 Z0\nG53 G0 X0 Y0 A0 C0\n#502=#501*2\nM30\n";
}

FaultRig::FaultRig(const std::string& layout, bool gateway, std::optional<std::uint32_t> domain, Time time)
    : cluster_("ac-table", time, layout, gateway, domain),
      recording_(std::filesystem::temp_directory_path() /
                 ("trunnion-faults-" + std::to_string(getpid()) + ".mcap")) {
  auto& bus = cluster_.client().bus();
  every_state_.emplace(bus.backend().reader(bus::describe(topics::channel_state), {true, 0}, &bus.signal()));
  cluster_.keep_rows = true;
}

FaultRig::~FaultRig() { drop_recorder(); }

void FaultRig::watch() {
  idl::channel::ChannelState state;
  while (every_state_->take(state))
    if (state.state == RunState::HOLDING && !hold_began_) hold_began_ = state.cycle;
}

// Two states that were published after the order was taken: the first may have been on its way before.
void FaultRig::wait_for_news(const std::function<void()>& order) {
  order();
  cluster_.drain();
  const auto before = cluster_.state_count[0];
  EXPECT_TRUE(cluster_.until([&] { return cluster_.state_count[0] >= before + 2; }));
}

void FaultRig::store_keepsakes(int rounds) {
  part_ = part_program(rounds);
  auto& client = cluster_.client();
  using idl::parameters::Operation;
  idl::parameters::ParameterRequest request;
  request.role = 2;  // a builder's
  request.who = "fault matrix";
  request.operation = Operation::SET;
  // 040950 is active at once, 010049 waits for a restart of the cluster: it must go on waiting.
  request.values = {{40950, 2.5, ""}, {10049, 31, ""}};
  client.parameter(request);
  request.operation = Operation::SET_TOOL;
  request.tools = {{kept_tool, 33.25, 0.5, 4, 0.125, "keepsake"}};
  client.parameter(request);
  request.operation = Operation::SET_WORK_OFFSET;
  request.offsets = {{0, 1, {12.5, -3, -400, 0, 0, 0, 0, 0, 0}}};
  client.parameter(request);
  client.upload(kept_program, kept_text);
  client.upload(part_name, part_);
  mdi("#" + std::to_string(kept_number) + "=" + std::to_string(kept_value));
  cluster_.until([] { return false; }, 0.1);  // what was published last arrives
  parameters_ = client.newest(topics::parameter_set);
  tools_ = client.newest(topics::tool_table);
  offsets_ = client.newest(topics::work_offsets);
  EXPECT_FALSE(parameters_.pending.empty());
  EXPECT_EQ(kept_variable(kept_number), kept_value);
}

void FaultRig::check_keepsakes() {
  auto& client = cluster_.client();
  EXPECT_TRUE(client.newest(topics::parameter_set) == parameters_) << "parameters";
  EXPECT_TRUE(client.newest(topics::tool_table) == tools_) << "tools";
  EXPECT_TRUE(client.newest(topics::work_offsets) == offsets_) << "work offsets";
  EXPECT_EQ(client.download(kept_program), kept_text);
  EXPECT_EQ(client.download(part_name), part_);
  EXPECT_EQ(kept_variable(kept_number), kept_value);
}

std::optional<double> FaultRig::kept_variable(unsigned number) const {
  std::ifstream in(cluster_.running().state_directory + "/channel-0.variables");
  const std::string key = "#" + std::to_string(number) + ": ";
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) return std::stod(line.substr(key.size()));
  return std::nullopt;
}

void FaultRig::mdi(const std::string& line) {
  wait_for_news([&] {
    cluster_.client().set_mode(0, Mode::MDI);
    cluster_.client().mdi(0, line);
  });
  EXPECT_TRUE(cluster_.finish()) << line << ": " << cluster_.told();
}

void FaultRig::go_home() {
  mdi("G53 G0 Z0");
  mdi("G53 G0 X0 Y0 A0 C0");
}

// Rows of the last motion arrive; on a busy machine they take their time.
void FaultRig::settle() {
  for (int i = 0; i < 50; ++i) {
    const auto before = cluster_.expected_cycle;
    cluster_.until([] { return false; }, 0.2);
    if (cluster_.expected_cycle == before && before >= cluster_.channels[0].cycle) return;
  }
}

void FaultRig::begin() {
  settle();
  cluster_.rows.clear();
  cluster_.lost_batches = 0;
  cluster_.start(part_name);
}

Judgement FaultRig::judge(const Rows& reference, bool whole) const {
  return integration::judge(cluster_.rows, reference, path_tolerance, whole);
}

Rows FaultRig::undisturbed(double& runs) {
  for (int i = 0; i < 8; ++i) {
    begin(), ++runs;
    EXPECT_TRUE(finish()) << cluster_.told();
    if (lost_rows() == 0) return rows();
  }
  return {};
}

bool FaultRig::finish() {
  // A loss that nobody caused leaves the channel held, and nobody would start it again.
  double held_since = 0;
  cluster_.until(
      [&] {
        const auto state = cluster_.state();
        if (state != RunState::HELD)
          held_since = 0;
        else if (held_since == 0)
          held_since = service::monotonic_seconds();
        return state == RunState::IDLE || state == RunState::INTERRUPTED ||
               (held_since > 0 && service::monotonic_seconds() - held_since > 5);
      },
      run_timeout);
  settle();
  return cluster_.state() == RunState::IDLE;
}

int FaultRig::pid_of(const std::string& service) const {
  if (service == "recorder") return recorder_;
  const auto* entry = cluster_.service(service);
  return entry != nullptr ? entry->pid : 0;
}

bool FaultRig::replaced(const std::string& service) const {
  const auto* entry = cluster_.service(service);
  return entry != nullptr && entry->pid != 0 && entry->pid != pids_.at(service) && entry->ready;
}

void FaultRig::restart_loop(const std::string& service) {
  if (service == "recorder") {
    for (int life = 0; life < 6; ++life) {
      if (life > 0) start_recorder();
      // A second at most stays in memory.
      EXPECT_TRUE(cluster_.until([&] { return watch(), recorded_messages() > 0; }))
          << "what was recorded can be read";
      kill(recorder_, SIGKILL);
      waitpid(std::exchange(recorder_, 0), nullptr, 0);
    }
    return;
  }
  // The first process may have lived long, so it takes five deaths or six.
  for (int i = 0; i < 6 && !cluster_.has_alarm(105, service); ++i) {
    pids_[service] = pid_of(service);
    ASSERT_EQ(kill(pids_[service], SIGKILL), 0);
    ASSERT_TRUE(cluster_.until([&] { return watch(), cluster_.has_alarm(105, service) || replaced(service); },
                               ready_timeout))
        << "comes up again; " << cluster_.active_alarms();
  }
  EXPECT_TRUE(cluster_.has_alarm(105, service)) << "does not stay up; " << cluster_.active_alarms();
  const auto* entry = cluster_.service(service);
  cluster_.until([] { return false; }, 0.6);  // two lists of the launcher
  entry = cluster_.service(service);
  EXPECT_EQ(entry->pid, 0) << "is left alone until somebody has looked";
  cluster_.reset_alarms();
}

void FaultRig::strike(const std::string& service, Fault fault) {
  cluster_.drain();
  for (const auto& s : cluster_.list().services) pids_[s.service] = s.pid, restarts_[s.service] = s.restarts;
  history_ = cluster_.history.size();
  watch();
  hold_began_.reset();
  const int pid = pid_of(service);
  ASSERT_GT(pid, 0) << service;
  switch (fault) {
    case Fault::killed:
      ASSERT_EQ(kill(pid, SIGKILL), 0);
      break;
    case Fault::terminated:
      ASSERT_EQ(kill(pid, SIGTERM), 0);
      break;
    case Fault::suspended:
      ASSERT_EQ(kill(pid, SIGSTOP), 0);
      cluster_.until([&] { return watch(), false; }, suspension);
      ASSERT_EQ(kill(pid, SIGCONT), 0);
      break;
    case Fault::restarts:
      restart_loop(service);
      break;
  }
}

// No setpoint is being executed, and none will be before somebody orders it.
bool FaultRig::stands() {
  const auto state = cluster_.state();
  const bool waits = state == RunState::INTERRUPTED || state == RunState::HELD || state == RunState::IDLE;
  const auto& channels = cluster_.feedback.channels;
  const bool owed = std::any_of(channels.begin(), channels.end(), [](const auto& c) { return c.active; });
  return waits &&
         (!owed || cluster_.feedback.mode == DriveMode::HELD || cluster_.feedback.mode == DriveMode::OFF);
}

Observation FaultRig::await(const std::string& service, Fault fault, bool in_motion) {
  Observation seen;
  if (service != "recorder") {
    const bool new_process = fault != Fault::suspended;
    EXPECT_TRUE(cluster_.until([&] { return watch(), cluster_.has_alarm(100, service); }))
        << "alarm 100 names it";
    EXPECT_TRUE(cluster_.until(
        [&] { return watch(), cluster_.ready() && (!new_process || replaced(service)); }, ready_timeout))
        << "the cluster is ready again; " << cluster_.active_alarms();
    if (in_motion) {
      EXPECT_TRUE(cluster_.until([&] { return watch(), stands(); })) << cluster_.told();
    }
    cluster_.until([&] { return watch(), false; }, 0.2);  // the states of the standstill arrive
    for (const auto& s : cluster_.list().services)
      if (s.service != service) {
        EXPECT_EQ(s.pid, pids_[s.service]) << s.service << " was not restarted";
      } else if (!new_process) {
        EXPECT_EQ(s.pid, pids_[s.service]) << "came back by itself";
      }
  }
  seen.stopped = cluster_.state() == RunState::INTERRUPTED || cluster_.state() == RunState::HELD;
  seen.executed_at_standstill = cluster_.feedback.first + cluster_.feedback.count;
  for (std::size_t i = history_; i < cluster_.history.size(); ++i) {
    const auto& alarm = cluster_.history[i];
    if (!alarm.active) continue;
    seen.alarms.insert(alarm.number);
    unsigned long long missing = 0, at_hand = 0;
    if (alarm.number == 110 && std::sscanf(alarm.text.c_str(), "No setpoint for cycle %llu in time; %llu",
                                           &missing, &at_hand) == 2) {
      seen.cycles_at_hand = static_cast<std::int64_t>(at_hand);
      seen.cycles_of_braking = static_cast<std::int64_t>(seen.executed_at_standstill - (missing - at_hand));
    }
  }
  seen.axes_off = seen.alarms.count(133) != 0;
  if (hold_began_ && cluster_.state() == RunState::HELD)
    seen.cycles_of_hold = static_cast<std::int64_t>(seen.executed_at_standstill - *hold_began_);
  return seen;
}

void FaultRig::reset_alarms() {
  EXPECT_TRUE(cluster_.until(
      [&] {
        cluster_.reset_alarms();
        return std::none_of(cluster_.alarms.begin(), cluster_.alarms.end(),
                            [](const auto& entry) { return entry.second.active; });
      },
      10))
      << "alarms that cannot be reset: " << cluster_.active_alarms();
}

Way FaultRig::go_on() {
  reset_alarms();
  std::string refusal;
  bool begin_again = false;
  const bool accepted = cluster_.until([&] {
    try {
      wait_for_news([&] { cluster_.client().channel(0, CommandKind::CYCLE_START); });
      return true;
    } catch (const std::exception& e) {
      refusal = e.what();
      begin_again = refusal.find("reset the channel") != std::string::npos;
      return begin_again;
    }
  });
  EXPECT_TRUE(accepted) << refusal << "; " << cluster_.active_alarms();
  if (!begin_again) return Way::cycle_start;
  wait_for_news([&] { cluster_.client().channel(0, CommandKind::RESET); });
  EXPECT_TRUE(cluster_.until([&] { return cluster_.state() == RunState::IDLE; })) << cluster_.told();
  reset_alarms();
  return Way::begin_again;
}

void FaultRig::start_recorder() {
  int out[2];
  ASSERT_EQ(pipe(out), 0);
  const auto program = cluster::binary_directory() + "/trunnion-recorder";
  const auto domain = std::to_string(cluster_.running().run.domain);
  recorder_ = fork();
  if (recorder_ == 0) {
    dup2(out[1], 1);
    for (int fd = 3; fd < 256; ++fd) close(fd);
    execl(program.c_str(), program.c_str(), "--output", recording_.c_str(), "--machine", "ac-table",
          "--domain", domain.c_str(), "--parent-bound", nullptr);
    _exit(127);
  }
  close(out[1]);
  std::string line;
  char c = 0;
  while (read(out[0], &c, 1) == 1 && c != '\n') line += c;
  close(out[0]);
  EXPECT_EQ(line.rfind("recording", 0), 0u) << line;
}

std::uint64_t FaultRig::recorded_messages() const {
  recording::FileSource source(recording_);
  recording::Reader reader(source);
  recording::MessageView message;
  std::uint64_t messages = 0;
  while (reader.next(message)) ++messages;
  return messages;
}

void FaultRig::drop_recorder() {
  if (recorder_ > 0) {
    kill(recorder_, SIGKILL);
    waitpid(std::exchange(recorder_, 0), nullptr, 0);
  }
  std::filesystem::remove(recording_);
}

std::uint64_t FaultRig::stop_recorder() {
  if (recorder_ <= 0) return 0;
  kill(recorder_, SIGTERM);
  waitpid(std::exchange(recorder_, 0), nullptr, 0);
  return recorded_messages();
}

}  // namespace trunnion::integration
