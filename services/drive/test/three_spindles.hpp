// SPDX-License-Identifier: Apache-2.0
// Three spindles, and machines that turn as these tell them, for the tests of synchronized spindles.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "drive_hardware.hpp"
#include "machine/axes.hpp"
#include "machine/parameters.hpp"
#include "simulated_spindle.hpp"
#include "spindles.hpp"
#include "synchronized_spindles.hpp"

namespace trunnion::drive::synchronized_spindles_test {

using idl::plc::IntegralAction;

inline constexpr double period = 0.001;

// Spindles S1, S2, S3 are the logical axes 5, 6, 7, with 20000 deg/s2: 3333.3 1/min in a second.
inline machine::Parameters three_spindles() {
  machine::Parameters p;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t axis = 105000 + k * 1000;
    p.values[axis] = {0, "S" + std::to_string(k + 1)};
    p.values[axis + 1] = {machine::axis_type_spindle, ""};
    p.values[axis + 36] = {20000, ""};
  }
  return p;
}

inline idl::plc::SpindleCoupling following(std::uint8_t slave, std::uint8_t master, bool reverse = false,
                                           double angle = 0) {
  return {slave, master, reverse, angle, IntegralAction::INTEGRAL_ACTIVE};
}

// The spindles and machines that turn exactly as they are told within their acceleration.
struct Shop {
  explicit Shop(const machine::Parameters& p = three_spindles()) {
    spindles.configure(p, period);
    machines.resize(spindles.size()), status.resize(spindles.size()), row.resize(spindles.size());
    for (auto& machine : machines) machine.configure(200000, period);
  }
  void run(int periods, bool in_control = true) {
    controlled = in_control;
    for (int i = 0; i < periods; ++i) {
      spindles.step(status, controlled, row);
      for (const auto& finding : spindles.synchronization().findings()) found.push_back(finding);
      for (std::size_t k = 0; k < machines.size(); ++k) {
        machines[k].step(row[k], controlled);
        status[k].speed = machines[k].speed(), status[k].angle = machines[k].angle();
      }
    }
  }
  idl::stream::SpindleState state(std::size_t spindle) const {
    idl::stream::Feedback feedback;
    spindles.fill(status, row, controlled, feedback);
    return feedback.spindles[spindle];
  }
  /// deg of the slave from its angle at the master, with `sign` -1 for the other way round.
  double beside(std::size_t slave, std::size_t master, double sign = 1) const {
    return 360 * std::remainder(status[slave].angle - sign * status[master].angle, 1.0);
  }

  Spindles spindles;
  std::vector<SimulatedSpindle> machines;
  std::vector<SpindleStatus> status;
  std::vector<SpindleSetpoint> row;
  std::vector<SynchronizationFinding> found;
  bool controlled = true;
};

}  // namespace trunnion::drive::synchronized_spindles_test
