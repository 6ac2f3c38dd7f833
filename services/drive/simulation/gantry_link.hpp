// SPDX-License-Identifier: Apache-2.0
// The sides of a gantry act on each other: by the beam between them, and by what their drives exchange.
//
// Beam: force = k (a - misalignment) + c a', where a is the motion of the slave's load ahead of the master's,
// k = J w^2, c = 2 D J w, J the inertia of the slave and w its frequency while the master is held.
// Drives: HNC-8 PB64 .. PB66. Compensation adds PB66 / 100 1/s times the difference of the position errors to
// the speed setpoint of the slave; in torque follow the slave has the torque of its master.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compensation/error_model.hpp"
#include "machine/gantry_pairs.hpp"
#include "simulated_axis.hpp"

namespace trunnion::drive {

class ServoTest;

/// A master and its slaves, where anything acts between them.
class GantryLink {
 public:
  struct Slave {
    machine::GantryPair pair;
    double stiffness = 0, damping = 0, misalignment = 0;  // of the nominal inertia, 1/s2 and 1/s; mm
    double compensation = 0;                              // 1/s
    bool torque_follow = false;
    double torque_sign = 1;
    bool common_stop = false;
    bool active() const { return stiffness > 0 || compensation > 0 || torque_follow; }
  };

  /// Every gantry of the machine; `beam`: that of channel 0 in truth.yaml.
  static std::vector<GantryLink> of(const machine::Parameters& parameters,
                                    const std::optional<volumetric::BeamErrors>& beam);

  bool active() const;
  bool has(std::size_t column) const;
  const std::vector<Slave>& slaves() const { return slaves_; }
  std::size_t master() const { return master_; }

  /// One period of all axes of the gantry under control.
  void step(std::vector<SimulatedAxis>& axes, std::span<const AxisSetpoint> setpoints, double dt,
            ServoTest& test);
  /// One period without control, each in its way until it is at rest.
  void run_out(std::vector<SimulatedAxis>& axes, std::span<const RunOut> ways, double dt);
  /// Axes at rest, whose brakes hold them: their drives begin with the torque that the beam needs.
  void hold(std::vector<SimulatedAxis>& axes) const;

 private:
  /// On the master, in its direction; on the slave it has the opposite sign.
  double force(const Slave& slave, const std::vector<SimulatedAxis>& axes, double ahead) const;
  double forces(const std::vector<SimulatedAxis>& axes, double ahead, std::vector<double>& each) const;

  std::size_t master_ = 0;
  std::vector<Slave> slaves_;
  std::vector<double> scratch_;
};

}  // namespace trunnion::drive
