// SPDX-License-Identifier: Apache-2.0
// The AC trunnion machine of examples/calibration with its measurement service, and what a test does to it.
#pragma once

#include <signal.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cluster_harness.hpp"

namespace trunnion::integration {

using idl::measurement::MeasurementReply;
using idl::measurement::MeasurementRequest;
using idl::measurement::MeasurementResult;
using idl::measurement::MeasurementState;
using idl::measurement::Operation;
using idl::measurement::Phase;

class MeasurementRig {
 public:
  static constexpr const char* good_probe = "ball_radius_mm: 3, length_mm: 60, pre_travel_um: 8, delay_ms: 1";
  /// Five poses: the initial one, A at -60 and 60, C at 120 and 240. Ways at ten times the delivered feed of
  /// the rotary axes: their 420 degrees would last 70 s.
  static constexpr const char* inputs =
      "mode: correct\naxes:\n  A: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}\n"
      "  C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}\n"
      "settings: {rotary_feed_deg_per_min: 3600}\n";
  static constexpr unsigned poses = 5;

  MeasurementRig() {
    if (mkdtemp(directory_.data()) == nullptr) throw std::runtime_error("mkdtemp");
    std::filesystem::copy(TRUNNION_MACHINES "/ac-table", machine(), std::filesystem::copy_options::recursive);
  }
  ~MeasurementRig() {
    stop();
    std::filesystem::remove_all(directory_);
  }

  /// A cluster whose truth has this probe; the state directory stays from start to start.
  void start(const std::string& probe) {
    std::ifstream example(TRUNNION_EXAMPLES "/calibration/truth.yaml");
    std::ofstream truth(machine() + "/truth.yaml");
    for (std::string line; std::getline(example, line);)
      truth << (line.starts_with("probe:") ? "probe: {" + probe + "}" : line) << "\n";
    truth.close();
    cluster.emplace(machine(), Time::virtual_, "", false, std::nullopt, directory_ + "/state");
    auto& bus = cluster->client().bus();
    requests_.emplace(bus, topics::measurement_request, topics::measurement_reply);
    states_.emplace(bus.reader(topics::measurement_state));
    sets_.emplace(bus.reader(topics::parameter_set));
    ASSERT_TRUE(until([&] { return heard_ && set.revision > 0; })) << cluster->told();
  }
  void stop() {
    requests_.reset(), states_.reset(), sets_.reset();
    cluster.reset();
    heard_ = false;
    set = {};
  }

  bool until(const std::function<bool()>& condition, double seconds = 60) {
    return cluster->until(
        [&] {
          MeasurementState newer;
          while (states_->take(newer)) {
            state = newer, heard_ = true;
            if (seen.empty() || seen.back() != newer.phase) seen.push_back(newer.phase);
          }
          sets_->take_newest(set);
          return condition();
        },
        seconds);
  }
  MeasurementReply order(MeasurementRequest request) {
    request.who = "test";
    const auto reply = requests_->call(std::move(request), 10);
    return reply.value_or(MeasurementReply{});
  }
  MeasurementReply order(Operation operation) {
    MeasurementRequest request;
    request.operation = operation;
    return order(std::move(request));
  }
  MeasurementReply measure(const std::string& text = inputs) {
    MeasurementRequest request;
    request.operation = Operation::START;
    request.inputs = text;
    return order(std::move(request));
  }
  /// Cleared alarms, an idle channel, the probe off the sphere.
  bool clear_machine() {
    auto& client = cluster->client();
    return until(
        [&] {
          try {
            client.panel(idl::plc::PanelRequestKind::RELEASE_EMERGENCY_STOP);
            client.panel(idl::plc::PanelRequestKind::RESET_EMERGENCY_STOP);
            client.channel(0, CommandKind::RESET);
            client.reset_alarms();
            if (!cluster->until([&] { return cluster->ready() && cluster->state() == RunState::IDLE; }, 2))
              return false;
            client.set_mode(0, Mode::MDI);
            client.mdi(0, "G53 G1 Z0 F3000");
            return cluster->newer_state() &&
                   cluster->until([&] { return at_top() && cluster->state() == RunState::IDLE; }, 5) &&
                   cluster->active_alarms().empty();
          } catch (const std::exception&) {
            return false;
          }
        },
        40);
  }
  bool at_top() {
    return cluster->channels[0].machine.size() > 2 && std::abs(cluster->channels[0].machine[2]) < 1e-3;
  }
  void kill(const std::string& service) {
    const auto* process = cluster->service(service);
    ASSERT_NE(process, nullptr);
    const auto pid = process->pid;
    ::kill(pid, SIGKILL);
    ASSERT_TRUE(until([&] {
      const auto* now = cluster->service(service);
      return cluster->ready() && now->pid != 0 && now->pid != pid;
    })) << service
        << " does not come back";
  }
  bool changed() const {
    return std::any_of(set.values.begin(), set.values.end(), is_offset) ||
           std::any_of(set.pending.begin(), set.pending.end(), is_offset);
  }
  double pending(std::uint32_t number) const {
    for (const auto& value : set.pending)
      if (value.number == number) return value.value;
    return std::nan("");
  }
  MeasurementResult result() { return cluster->client().newest(topics::measurement_result); }
  std::string told() {
    const auto published = cluster->client().newest(topics::parameter_set);
    const auto shown = [](const idl::parameters::ParameterSet& one) {
      return "revision " + std::to_string(one.revision) + " with " + std::to_string(one.values.size()) +
             " values, " + std::to_string(one.pending.size()) + " wait for a reset";
    };
    return cluster->told() + "\nphase " + bus::to_string(state.phase) + ", " +
           std::to_string(state.complete) + " poses, " + state.error + "\nparameters: " + shown(set) +
           "; published: " + shown(published);
  }

  std::optional<Cluster> cluster;
  MeasurementState state;
  std::vector<Phase> seen;  ///< phases, without the ones that passed too fast to be seen
  idl::parameters::ParameterSet set;

 private:
  std::string machine() const { return directory_ + "/mill"; }
  // Offsets of the table axes, which are 0 before, and a value that only the measurement writes.
  static bool is_offset(const idl::parameters::Parameter& value) {
    return value.number == 40432 || value.number == 40433 || value.number == 40435 || value.number == 40436;
  }

  std::string directory_ = std::filesystem::temp_directory_path() / "measurement_XXXXXX";
  std::optional<service::RequestClient<MeasurementRequest, MeasurementReply>> requests_;
  std::optional<bus::Reader<MeasurementState>> states_;
  std::optional<bus::Reader<idl::parameters::ParameterSet>> sets_;
  bool heard_ = false;
};

}  // namespace trunnion::integration
