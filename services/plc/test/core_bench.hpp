// SPDX-License-Identifier: Apache-2.0
// The machine's own programs on the core, with a drive that answers.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "plc_core.hpp"
#include "program_files.hpp"

namespace trunnion::plc {

// Axes 0 and 2, spindles 10 and 11.
inline machine::Parameters two_axes_and_spindles() {
  machine::Parameters p;
  p.values[100000] = {0, "X"}, p.values[102000] = {0, "Z"};
  for (const std::uint32_t spindle : {110000u, 111000u})
    p.values[spindle] = {0, "S"}, p.values[spindle + 1] = {10, ""};
  return p;
}

/// The PLC with a drive in virtual time beside it: while nothing moves, time continues to run_until_tick.
struct Bench {
  explicit Bench(const std::string& machine = "two-channel", bool drive_answers = true) {
    core.configure(two_axes_and_spindles(), true);
    load_programs(std::string(TRUNNION_MACHINES) + "/" + machine + "/plc", core);
    if (drive_answers) feedback();
  }

  void feedback() {
    idl::stream::Feedback batch;
    batch.first = executed;
    batch.tick = tick;
    batch.channels.resize(2);
    batch.channels[1].channel = 1;
    batch.channels[0].active = active;
    batch.spindle_speed.assign(speed.begin(), speed.end());
    batch.enabled = {1, 1};
    batch.skip_inputs = skip_inputs;
    const auto outputs = core.outputs();
    for (std::size_t s = 0; s < outputs.spindle_orient.size() && s < 2; ++s)
      batch.spindle_oriented.push_back(
          late_orientation || (outputs.spindle_orient[s] != 0 && speed[s] == 0) ? 1 : 0);
    batch.spindles = spindles;
    core.set_feedback(batch);
    step();
  }
  void step() {
    core.advance(tick);
    for (const auto& done : core.take_done()) finished.push_back(done);
  }
  /// Time continues for as long as the PLC requests it; returns the ticks that passed.
  std::uint64_t run() {
    const auto start = tick;
    for (int i = 0; i < 10000; ++i) {
      const auto outputs = core.outputs();
      if (outputs.run_until_tick <= tick) break;
      for (; tick < outputs.run_until_tick; ++tick)
        for (std::size_t s = 0; s < 2; ++s) {
          const double error = outputs.spindle_speed[s] - speed[s];
          speed[s] += std::clamp(error, -ramp, ramp);
        }
      feedback();
    }
    return tick - start;
  }
  void request(AuxiliaryKind kind, std::uint32_t code, double value = 0, std::uint16_t channel = 0) {
    ++number;
    core.set_request({channel, number, kind, code, value, false, executed});
    step();
  }
  /// An M with an angle in deg.
  void request_angle(std::uint32_t code, double angle) {
    ++number;
    core.set_request({0, number, AuxiliaryKind::M, code, angle, true, executed});
    step();
  }
  /// S with G96: m/min, 1/min, mm.
  void request_surface(double speed, double limit, double radius) {
    ++number;
    core.set_request({0, number, AuxiliaryKind::S, 0, speed, false, executed, true, limit, radius});
    step();
  }
  std::uint16_t g(const char* name, std::size_t index) const {
    return core.memory().registers.g[interface_address(name, index).index];
  }
  bool done() const { return !finished.empty() && finished.back().number == number; }

  PlcCore core;
  std::uint64_t tick = 1000, executed = 500;
  bool active = false;
  std::uint32_t number = 0;
  std::uint8_t skip_inputs = 0;
  std::array<double, 2> speed{};
  std::vector<idl::stream::SpindleState> spindles;  ///< that the drive reports
  bool late_orientation = false;  ///< the drive has not taken the newest outputs: it is oriented as before
  double ramp = 2;                // 1/min in each tick of 1 ms
  std::vector<idl::plc::AuxiliaryDone> finished;
};

}  // namespace trunnion::plc
