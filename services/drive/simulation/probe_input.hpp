// SPDX-License-Identifier: Apache-2.0
// The touch probe of truth.yaml on skip input 1: the true place of its ball by the loads of the axes.
#pragma once

#include <array>
#include <vector>

#include "drive_hardware.hpp"
#include "simulated_axis.hpp"
#include "simulated_spindle.hpp"
#include "touch_probe/probe_orientation.hpp"
#include "touch_probe/touch_probe.hpp"

namespace trunnion::drive {

/// What truth.yaml says of the probe and of what it touches.
struct ProbeSetup {
  geometry::ChainParameters design;  ///< of the machine as it was delivered
  truth::TrueGeometry geometry;
  touch_probe::TouchProbeTruth probe;
  std::vector<touch_probe::Solid> solids;
};

/// What a restart of the drive's process does not change.
struct ProbeMemory {
  truth::Temperatures temperatures{};
  touch_probe::TouchMemory touches;
};

class ProbeInput {
 public:
  explicit ProbeInput(const ProbeSetup& setup);

  /// The geometry is that of channel 0; `axes` are the columns of the servos.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes);
  /// The period of `row`, `period` s, is over. Within it the ball is taken to have moved evenly. No
  /// allocation but at an edge. A probe that is switched on in contact has no edge.
  void step(const SetpointRow& row, double period, const std::vector<SimulatedAxis>& servos,
            const std::vector<SimulatedSpindle>& spindles, EncoderRowSink& rows);
  ProbeMemory memory() const { return {warm_up_.temperatures(), probe_.memory()}; }
  void restore(const ProbeMemory& memory) {
    warm_up_ = truth::WarmUp(memory.temperatures);
    probe_.restore(memory.touches);
  }
  /// The signal of the probe.
  bool on() const { return probe_.signal(); }

  /// No fields, the constructor and configure() set them: geometry_, orientation_, lobes_, warms_,
  /// columns_, slave_column_, slave_sign_, slave_zero_, length_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("probe", self.probe_), visit("warm_up", self.warm_up_), visit("switched_on", self.switched_on_);
    visit("approach", self.approach_), visit("encoder", self.encoder_);
  }

 private:
  touch_probe::ProbePose pose(const std::vector<SimulatedAxis>& servos) const;

  truth::TrueGeometry geometry_;
  touch_probe::ProbeOrientation orientation_;
  bool lobes_ = false, warms_ = false;
  std::array<int, truth::axis_count> columns_;  // of X Y Z A .. W; -1: none
  int slave_column_ = -1;                       // of the beam's slave, with its sign and zero
  double slave_sign_ = 1, slave_zero_ = 0;
  double length_ = 0;
  touch_probe::TouchProbe probe_;
  truth::WarmUp warm_up_;
  bool switched_on_ = false;
  std::array<int, truth::axis_count> approach_{};
  std::vector<double> encoder_;  // at the end of the period before
};

}  // namespace trunnion::drive
