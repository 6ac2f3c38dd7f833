// SPDX-License-Identifier: Apache-2.0
// The servo test of synchronized spindles.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"
#include "machine_tests/servo_test_parts.hpp"
#include "machine_tests/spindle_sync_samples.hpp"
#include "machine_tests/spindle_sync_speeds.hpp"

namespace trunnion::machine_tests {

using servo_analysis::SpindleSyncSettings;

namespace {

constexpr int most_recordings = 4;         // of one speed, when cycles are lost
constexpr double longest_run_down = 60;    // s of wall time
constexpr double longest_discovery = 30;   // s
constexpr double speed_of_standstill = 1;  // 1/min

struct CoupledRun {
  SpindleSyncSamples samples;
  std::optional<idl::plc::SpindleCoupling> coupling;  // that the PLC has ordered
};

bool spindle_turns(ServoSession& session) {
  const auto feedback = session.client().newest(topics::feedback);
  return std::any_of(feedback.spindle_speed.begin(), feedback.spindle_speed.end(),
                     [](double speed) { return std::abs(speed) > speed_of_standstill; });
}

void await_standstill(ServoSession& session) {
  const double until = service::monotonic_seconds() + longest_run_down;
  while (spindle_turns(session))
    if (service::monotonic_seconds() > until) throw std::runtime_error("the spindles do not come to rest");
}

CoupledRun run_coupled(ServoSession& session, const std::string& program, double interval) {
  CoupledRun run{SpindleSyncSamples(interval), {}};
  auto feedback = session.client().reader_from_now(topics::feedback);
  auto outputs = session.client().reader_from_now(topics::plc_outputs);
  const double until = service::monotonic_seconds() + longest_discovery;
  while (feedback.matched() == 0 && service::monotonic_seconds() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto take = [&] {
    for (idl::stream::Feedback rows; feedback.take(rows);) run.samples.add(rows);
    for (idl::plc::Outputs ordered; outputs.take(ordered);)
      if (!ordered.spindle_couplings.empty()) run.coupling = ordered.spindle_couplings.front();
  };
  session.watch(program, take);
  take();
  await_standstill(session);
  return run;
}

// Leaves the spindles as they were found: at rest and not coupled.
void end_coupling(ServoSession& session, const SpindleSyncOrders& orders) {
  const auto outputs = session.client().newest(topics::plc_outputs);
  if (session.idle() && outputs.spindle_couplings.empty() && !spindle_turns(session)) return;
  session.recover(spindle_stop_program(orders));
  await_standstill(session);
}

CoupledRun run_and_end(ServoSession& session, const SpindleSyncOptions& test, const std::string& program,
                       double interval) {
  std::string problem;
  try {
    auto run = run_coupled(session, program, interval);
    if (session.client().newest(topics::plc_outputs).spindle_couplings.empty()) return run;
    problem = test.off + " does not end the coupling: name the M function of the machine's PLC with --off";
  } catch (const std::exception& e) {
    problem = e.what();
  }
  try {
    end_coupling(session, test);
  } catch (const std::exception& e) {
    problem += fmt::format("; the spindles could not be stopped ({}): order {} and {}", e.what(), test.stop,
                           test.off);
  }
  throw std::runtime_error(problem);
}

CoupledRun record_speed(ServoSession& session, const SpindleSyncOptions& test, double speed, double next) {
  const double interval = session.parameters().get(parameter::interpolation_cycle) * 1e-6;
  const auto program = spindle_sync_program(test, speed, next, test.settling, test.record);
  for (int runs = 0; runs < most_recordings; ++runs) {
    auto run = run_and_end(session, test, program, interval);
    if (!run.coupling)
      throw std::runtime_error(test.on +
                               " couples no spindles: name the M function of the machine's PLC with --on");
    if (!run.samples.lost()) return run;
  }
  throw SamplesLost();
}

SpindleSyncSettings settings_of(const machine::Parameters& parameters, const machine::AxisInfo& slave,
                                const idl::plc::SpindleCoupling& coupling, const SpindleSyncOptions& test) {
  SpindleSyncSettings settings;
  settings.reverse = coupling.reverse;
  settings.angle = coupling.angle;
  settings.window = parameters.get(parameter::synchronization_window, slave.number);
  settings.gain = parameters.get(parameter::synchronization_gain, slave.number);
  settings.settling = test.settling, settings.record = test.record;
  return settings;
}

std::string heading(const SpindleSyncSettings& settings, const machine::AxisInfo& master,
                    const machine::AxisInfo& slave, const SpindleSyncOptions& test) {
  return fmt::format(
      "spindle {} follows {}{}, angle {:g} deg, ordered by {}; window {:g} deg ({}), gain {:g} 1/min/rev "
      "({}); {:g} s recorded after {:g} s",
      slave.name, master.name, settings.reverse ? " the other way round" : "", settings.angle, test.on,
      settings.window, machine::number_text(parameter::synchronization_window.number(slave.number)),
      settings.gain, machine::number_text(parameter::synchronization_gain.number(slave.number)), test.record,
      test.settling);
}

// Of those that were named, or else chosen. Throws std::runtime_error when one of them cannot be tested.
std::vector<double> tested_speeds(const SpindleSyncSpeeds& possible, const std::vector<double>& named) {
  if (named.empty()) return possible.choice();
  for (const double speed : named)
    if (const auto why = possible.refusal(speed); !why.empty()) throw std::runtime_error(why);
  return named;
}

std::string speeds_note(const SpindleSyncSpeeds& possible, const std::vector<double>& speeds, bool chosen) {
  std::string list;
  for (const double speed : speeds) list += (list.empty() ? "" : ", ") + fmt::format("{:g}", speed);
  return fmt::format("speeds {} 1/min, {} {}", list, chosen ? "chosen from" : "of", possible.text());
}

}  // namespace

TestReport test_spindle_sync(ServoSession& session, const TestOptions& o) {
  const auto& test = o.spindle_sync;
  const auto spindles = machine::spindles(session.parameters());
  const auto feedback = session.client().newest(topics::feedback);
  const auto obstacle =
      spindle_sync_obstacle(spindles, feedback, session.client().newest(topics::plc_outputs));
  if (!obstacle.empty()) throw std::runtime_error(obstacle);
  const SpindleSyncSpeeds possible(session.parameters(), spindles, feedback);
  const auto speeds = tested_speeds(possible, test.speeds);
  auto r = report_of("spindle-sync", {});
  servo_analysis::Diagram diagram{"s since the coupling", "deg", {}};
  double longest = 0, window = 0;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    const double speed = speeds[i], next = i + 1 < speeds.size() ? speeds[i + 1] : 0;
    const auto run = record_speed(session, test, speed, next);
    const auto& coupling = *run.coupling;
    if (std::max(coupling.master, coupling.slave) >= spindles.size())
      throw std::runtime_error("the PLC couples a spindle that the machine does not have");
    const auto &master = spindles[coupling.master], &slave = spindles[coupling.slave];
    const auto settings = settings_of(session.parameters(), slave, coupling, test);
    const auto figures =
        servo_analysis::spindle_sync_figures(run.samples.record(coupling.master, coupling.slave), settings);
    auto found = servo_analysis::spindle_sync_findings(speed, next, figures, settings);
    if (i == 0) {
      r.notes.push_back(heading(settings, master, slave, test));
      r.notes.push_back(speeds_note(possible, speeds, test.speeds.empty()));
      r.notes.push_back(
          "limits: the window for the largest error, half of it for the drift and 1.5 for the growth of an "
          "oscillation (our choice), 180 deg for a change of the speed (alarm 184)");
      r.details = {{"master", master.name},
                   {"slave", slave.name},
                   {"reverse", settings.reverse},
                   {"angle_deg", settings.angle},
                   {"window_deg", settings.window},
                   {"gain_per_min_per_rev", settings.gain},
                   {"settling_s", test.settling},
                   {"record_s", test.record},
                   {"lowest_per_min", possible.lowest()}};
      if (std::isfinite(possible.highest())) r.details["highest_per_min"] = possible.highest();
    }
    r.figures.insert(r.figures.end(), found.figures.begin(), found.figures.end());
    r.notes.insert(r.notes.end(), found.notes.begin(), found.notes.end());
    if (!figures.course.empty()) longest = std::max(longest, figures.course.back().x);
    window = settings.window;
    diagram.curves.push_back({fmt::format("S{:g}", speed), figures.course});
  }
  diagram.curves.push_back(servo_analysis::window_curve(window, longest));
  r.picture = {session.machine() + ": error of synchronized spindles", std::move(diagram)};
  return r;
}

}  // namespace trunnion::machine_tests
