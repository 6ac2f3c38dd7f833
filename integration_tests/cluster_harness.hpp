// SPDX-License-Identifier: Apache-2.0
// A real cluster for a test: its own domain, its own state, nothing left behind.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

#include "cluster/client.hpp"
#include "cluster/cluster.hpp"
#include "cluster/machine_session.hpp"
#include "http_client/client.hpp"

namespace trunnion::integration {

using idl::channel::CommandKind;
using idl::channel::Mode;
using idl::channel::RunState;
using idl::stream::DriveMode;

enum class Time { real, virtual_ };

using Rows = std::vector<std::vector<double>>;

/// Where two runs differ first, or empty: the message of a test. Rows that one of them has not seen are
/// empty: a test that gets no processor loses some of a stream that runs as fast as it can.
inline std::string first_difference(const Rows& rows, const Rows& expected) {
  for (std::size_t i = 0; i < std::min(rows.size(), expected.size()); ++i)
    for (std::size_t k = 0; k < std::min(rows[i].size(), expected[i].size()); ++k)
      if (rows[i][k] != expected[i][k]) {
        char text[160];
        std::snprintf(text, sizeof text, "row %zu, column %zu: %.17g instead of %.17g", i, k, rows[i][k],
                      expected[i][k]);
        return text;
      }
  const auto seen = std::count_if(rows.begin(), rows.end(), [](const auto& row) { return !row.empty(); });
  if (rows.size() != expected.size()) return "the number of rows";
  // A stream in virtual time waits for nobody, so a reader that got no processor misses some.
  if (static_cast<std::size_t>(seen) * 4 >= rows.size()) return "";
  return "only " + std::to_string(seen) + " of " + std::to_string(rows.size()) +
         " rows were seen, too few to tell";
}

class Cluster {
 public:
  explicit Cluster(const std::string& machine, Time time = Time::virtual_, const std::string& vendor = "",
                   bool gateway = false, std::optional<std::uint32_t> domain = std::nullopt,
                   const std::string& state_directory = "temporary") {
    cluster::UpOptions up;
    up.machine = machine;
    up.vendor = vendor;
    up.state_directory = state_directory;
    up.own_domain = !domain;
    up.domain = domain;
    up.virtual_time = time == Time::virtual_;
    up.with_gateway = gateway;
    up.port = http_client::free_port();
    cluster_ = cluster::start_cluster(up);
    join(cluster_.network);
  }
  /// Takes part in a cluster that somebody else starts and stops.
  explicit Cluster(const bus::NetworkSettings& network) : owned_(false) { join(network); }
  ~Cluster() {
    states_.reset(), alarms_.reset(), feedback_.reset(), clusters_.reset(), resets_.reset();
    progress_.reset(), client_.reset();
    if (!owned_) return;
    try {
      cluster::stop_cluster(cluster_.run);
    } catch (const std::exception& e) {
      ADD_FAILURE() << e.what();
    }
    EXPECT_FALSE(std::filesystem::exists(cluster_.run.path())) << "files of the cluster are left";
    for (const auto& service : list_.services)
      EXPECT_FALSE(is_of_this_cluster(service.pid)) << service.service << " is left";
  }

  cluster::Client& client() { return *client_; }
  const cluster::RunningCluster& running() const { return cluster_; }

  void drain() {
    idl::channel::ChannelState state;
    while (states_->take(state)) {
      channels[state.channel] = state;
      ++state_count[state.channel];
    }
    idl::service::Alarm alarm;
    while (alarms_->take(alarm)) {
      alarms[{alarm.instance, alarm.number, alarm.part}] = alarm;
      history.push_back(alarm);
    }
    idl::stream::Feedback batch;
    while (feedback_->take(batch)) {
      if (batch.count > 0) {
        if (expected_cycle != 0 && batch.first != expected_cycle) {
          ++lost_batches;
          if (keep_rows && batch.first > expected_cycle)
            rows.resize(rows.size() + (batch.first - expected_cycle));
        }
        expected_cycle = batch.first + batch.count;
      }
      feedback = batch;
      ++feedback_messages_;
      report_progress();
      if (on_batch) on_batch(batch);
      for (std::uint32_t i = 0; i < batch.count && keep_rows; ++i)
        rows.emplace_back(batch.commanded.begin() + i * batch.axis_count,
                          batch.commanded.begin() + (i + 1) * batch.axis_count);
    }
    while (clusters_->take(list_)) have_cluster_ = true;
  }
  /// The limit only ends a hang: nothing may depend on it.
  bool until(const std::function<bool()>& condition, double seconds = 60) {
    const double end = service::monotonic_seconds() + seconds;
    while (service::monotonic_seconds() < end) {
      drain();
      if (condition()) return true;
      client_->bus().signal().wait(0.01);
    }
    return false;
  }
  const idl::service::ClusterService* service(const std::string& name, unsigned replica = 0) const {
    for (const auto& s : list_.services)
      if (s.service == name && s.replica == replica) return &s;
    return nullptr;
  }
  const idl::service::Cluster& list() const { return list_; }
  bool ready() const { return list_.ready; }
  RunState state(std::uint16_t channel = 0) { return channels[channel].state; }
  bool has_alarm(std::uint32_t number, const std::string& text = "") const {
    for (const auto& [key, alarm] : alarms)
      if (alarm.active && alarm.number == number && alarm.text.find(text) != std::string::npos) return true;
    return false;
  }
  std::string active_alarms() const {
    std::string all;
    for (const auto& [key, alarm] : alarms)
      if (alarm.active) all += std::to_string(alarm.number) + " " + alarm.source + ": " + alarm.text + "; ";
    return all;
  }
  /// Everything that was raised and released, for the message of a test that fails: the alarm of a stop may
  /// arrive after the state that shows it.
  std::string told() {
    until([] { return false; }, 0.3);
    std::string all = std::string("state ") + bus::to_string(state()) + ", alarms:";
    for (const auto& alarm : history)
      all += "\n  " + std::string(alarm.active ? "raised " : "ended ") + std::to_string(alarm.number) + " " +
             alarm.source + ": " + alarm.text;
    return all;
  }

  void start_text(const std::string& text, std::uint16_t channel = 0) {
    const std::string name = "test" + std::to_string(channel) + ".nc";
    client_->upload(name, text);
    start(name, channel);
  }
  void start(const std::string& name, std::uint16_t channel = 0) {
    cluster::MachineSession(*client_, channel).select(name);
    cycle_start(channel);
  }
  /// As an operator starts behind a fault of the network: an alarm of it may come behind the reset of the
  /// others and refuse the start, and is reset, too.
  bool reset_and_start_text(const std::string& text) {
    return until([&] {
      if (!active_alarms().empty()) {
        reset_alarms();
        return false;
      }
      try {
        start_text(text);
        return true;
      } catch (const std::exception&) {
        if (active_alarms().empty()) throw;
        return false;
      }
    });
  }
  /// Returns when the state is one that was published after the start.
  void cycle_start(std::uint16_t channel = 0) {
    if (sees_every_cycle()) {
      report_progress();
      EXPECT_TRUE(until([&] { return progress_->matched() == static_cast<int>(channels.size()); }));
    }
    // An alarm whose end this process has seen may still be on its way to the channel, which then refuses.
    std::exception_ptr refused;
    until([&] {
      refused = nullptr;
      try {
        client_->channel(channel, CommandKind::CYCLE_START);
      } catch (const std::exception&) {
        refused = std::current_exception();
      }
      return refused == nullptr || !active_alarms().empty();
    });
    if (refused) std::rethrow_exception(refused);
    EXPECT_TRUE(newer_state(channel));
  }
  /// Waits for a state that was published after this call, and says whether it came: the first that arrives
  /// may have been on its way before, the second cannot.
  bool newer_state(std::uint16_t channel = 0) {
    drain();
    const auto before = state_count[channel];
    return until([&] { return state_count[channel] >= before + 2; });
  }
  /// In virtual time: waits until the drive has nothing more to do and the channel has said where it stands.
  /// The drive goes on until the servos have settled, and a message without a cycle says that it has not.
  bool rests(std::uint16_t channel = 0) {
    drain();
    const auto before = feedback_messages_;
    return until([&] {
             return feedback_messages_ >= before + 2 && feedback.count == 0 &&
                    (feedback.mode == DriveMode::HELD ||  // a motion that was interrupted stays active
                     std::none_of(feedback.channels.begin(), feedback.channels.end(),
                                  [](const auto& echo) { return echo.active; }));
           }) &&
           newer_state(channel);
  }
  /// `rows`, of which this process must not have missed one.
  const Rows& every_row() {
    EXPECT_EQ(lost_batches, 0u) << "this process got no processor";
    std::erase_if(rows, [](const auto& row) { return row.empty(); });
    return rows;
  }
  bool finish(std::uint16_t channel = 0, double seconds = 60) {
    const bool ended = until(
        [&] { return state(channel) == RunState::IDLE || state(channel) == RunState::INTERRUPTED; }, seconds);
    // The state may come before the last rows, which are of another topic.
    if (ended && keep_rows) until([&] { return expected_cycle >= channels[channel].cycle; });
    return ended && state(channel) == RunState::IDLE;
  }
  /// After a stop: resets what can be reset and starts again, until the channel runs.
  bool go_on(std::uint16_t channel = 0) {
    return until([&] {
             try {
               reset_alarms();
               client_->channel(channel, CommandKind::CYCLE_START);
               return true;
             } catch (const std::exception&) {
               return false;
             }
           }) &&
           until([&] { return state(channel) == RunState::RUNNING; });
  }
  /// Goes on as an operator does, whenever the channel is stopped, to the end of the program.
  bool finish_going_on(std::uint16_t channel = 0, double seconds = 60) {
    return until(
        [&] {
          if (state(channel) == RunState::HELD || state(channel) == RunState::INTERRUPTED) go_on(channel);
          return state(channel) == RunState::IDLE;
        },
        seconds);
  }
  /// After a kill: resets until nothing is left that could stop another program. The drive owes the channel
  /// no setpoint whose absence it could still report (110).
  bool begin_anew(std::uint16_t channel = 0) {
    client_->channel(channel, CommandKind::RESET);
    return until([&] {
      if (!active_alarms().empty()) reset_alarms();
      return state(channel) == RunState::IDLE && active_alarms().empty() &&
             std::none_of(feedback.channels.begin(), feedback.channels.end(),
                          [](const auto& echo) { return echo.active; });
    });
  }
  void reset_alarms() { resets_->write({1, ++resets_sent_, 65535}); }

  std::map<std::uint16_t, idl::channel::ChannelState> channels;
  std::map<std::uint16_t, std::uint64_t> state_count;
  std::map<std::array<std::uint32_t, 3>, idl::service::Alarm> alarms;
  std::vector<idl::service::Alarm> history;
  idl::stream::Feedback feedback;
  Rows rows;  ///< one for each cycle, empty when this process has not seen it
  bool keep_rows = false;
  std::function<void(const idl::stream::Feedback&)> on_batch;  ///< sees every batch
  /// In virtual time channels wait for this process as they do for a recorder, so that it misses no cycle
  /// while it keeps rows or watches batches. It must drain() without long breaks: after 0.7 s they go on
  /// alone, which is close to the second for which the drive waits for a setpoint.
  bool paces = true;
  std::uint64_t expected_cycle = 0, lost_batches = 0;

 private:
  // Numbers of processes are used again, so the one that has it must name the domain in its command line.
  bool is_of_this_cluster(int pid) const {
    std::ifstream file("/proc/" + std::to_string(pid) + "/cmdline");
    const std::string line{std::istreambuf_iterator<char>(file), {}};
    const std::string domain = "--domain" + std::string(1, '\0') + std::to_string(cluster_.run.domain) + '\0';
    return line.find(domain) != std::string::npos;
  }

  bool sees_every_cycle() const { return paces && list_.virtual_time && (keep_rows || on_batch); }

  /// Half of the 1024 batches that a writer keeps for its readers, of 16 cycles each.
  static constexpr std::uint64_t cycles_ahead = 1024 / 2 * 16;

  void report_progress() {
    if (!sees_every_cycle()) return;
    if (!progress_) progress_.emplace(client_->bus().writer(topics::recording_progress));
    const auto cycles = expected_cycle + cycles_ahead;
    if (cycles < reported_cycles_ + cycles_ahead / 8) return;
    reported_cycles_ = cycles;
    progress_->write({static_cast<std::uint64_t>(getpid()), cycles});
  }

  void join(const bus::NetworkSettings& network) {
    client_ = std::make_unique<cluster::Client>(network);
    states_.emplace(client_->bus().reader(topics::channel_state));
    alarms_.emplace(client_->bus().reader(topics::alarm));
    feedback_.emplace(client_->bus().reader(topics::feedback));
    clusters_.emplace(client_->bus().reader(topics::cluster));
    resets_.emplace(client_->bus().writer(topics::alarm_reset));
    // A drive that does not know of our reader yet would not tell where a motion begins.
    EXPECT_TRUE(until([&] {
      return have_cluster_ && list_.ready && !channels.empty() && feedback.axis_count > 0;
    })) << told();
  }

  bool owned_ = true;
  cluster::RunningCluster cluster_;
  std::unique_ptr<cluster::Client> client_;
  std::optional<bus::Reader<idl::channel::ChannelState>> states_;
  std::optional<bus::Reader<idl::service::Alarm>> alarms_;
  std::optional<bus::Reader<idl::stream::Feedback>> feedback_;
  std::optional<bus::Reader<idl::service::Cluster>> clusters_;
  std::optional<bus::Writer<idl::service::AlarmReset>> resets_;
  std::optional<bus::Writer<idl::stream::RecordingProgress>> progress_;
  std::uint64_t reported_cycles_ = 0, feedback_messages_ = 0;
  std::uint64_t resets_sent_ = 0;
  idl::service::Cluster list_;
  bool have_cluster_ = false;
};

}  // namespace trunnion::integration
