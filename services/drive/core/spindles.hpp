// SPDX-License-Identifier: Apache-2.0
// The spindles of the machine. Each has the speed that the PLC demands, within its limits and by its ramp,
// turns to its orientation angle and is held there, follows an angle of the stream, or another spindle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "drive_event.hpp"
#include "drive_hardware.hpp"
#include "machine/axes.hpp"
#include "spindle_coupling.hpp"
#include "spindle_gear.hpp"
#include "spindle_orientation.hpp"
#include "spindle_ramp.hpp"
#include "surface_speeds.hpp"
#include "synchronized_spindles.hpp"

namespace trunnion::drive {

/// A spindle is named by its column, the place in axes().
class Spindles {
 public:
  /// `period` s. Not cyclic.
  void configure(const machine::Parameters& parameters, double period);
  const std::vector<machine::AxisInfo>& axes() const { return axes_; }
  std::size_t size() const { return couplings_.size(); }

  /// 1/min; 0 for those that `speed` does not have.
  void demand_speeds(const std::vector<double>& speed);
  /// Spindles with a constant surface speed in place of that: all that the PLC orders now.
  void demand_surface_speeds(const std::vector<idl::plc::SurfaceSpeed>& speeds) { surface_.demand(speeds); }
  SurfaceSpeeds& surface_speeds() { return surface_; }
  /// Spindles that are to be oriented; not while they are coupled. `angle` deg: below 0, or of those that it
  /// does not have, that of the parameters.
  void demand_orientations(const std::vector<std::uint8_t>& orient, const std::vector<double>& angle = {});
  /// From 1; 0, or of those that `gear` does not have: none.
  void engage_gears(const std::vector<std::uint8_t>& gear);

  /// Spindles that follow others: all that the PLC requests now.
  void couple(const std::vector<idl::plc::SpindleCoupling>& couplings);
  /// Masters of synchronized spindles slow down to a standstill whatever they are ordered.
  void run_down(bool on) { synchronized_.run_down(on); }
  /// Before the first period under control: synchronizations that are requested now wait until their spindles
  /// are at rest.
  void await_rest() { synchronized_.await_rest(); }
  const SynchronizedSpindles& synchronization() const { return synchronized_; }

  SpindleCoupling& coupling(int column) { return couplings_[static_cast<std::size_t>(column)]; }
  /// Coupled spindles continue at the speed of their last setpoint for `cycles`.
  void lead_on(double cycles);

  /// One period: the setpoint of every spindle. `running_down`: only synchronized spindles are controlled.
  void step(const std::vector<SpindleStatus>& status, bool controlled, std::vector<SpindleSetpoint>& out,
            bool running_down = false);
  /// `row`: of the last step(), and whether it was `controlled` or `running_down`.
  void fill(const std::vector<SpindleStatus>& status, const std::vector<SpindleSetpoint>& row,
            bool controlled, idl::stream::Feedback& out, bool running_down = false) const;

  /// Appends what is wrong with the parameters. Not cyclic.
  void report_parameters(std::vector<DriveEvent>& events) const;
  /// Appends what the last step() has found.
  void report(const std::vector<SpindleStatus>& status, std::vector<DriveEvent>& events) const;
  /// The alarms are reset.
  void acknowledge();

  /// No fields, configure() sets them: axes_, windows_, highest_, period_.
  /// No fields, every step() sets them: permitted_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("spindles", self.couplings_), visit("orientations", self.orientations_);
    // Written where there is something: other recordings have no such state.
    if (!std::is_const_v<Self> || std::any_of(self.ramps_.begin(), self.ramps_.end(), [](const auto& ramp) {
          return ramp.settings().speed_dependent;
        }))
      visit("ramps", self.ramps_);
    if (!std::is_const_v<Self> || std::any_of(self.gears_.begin(), self.gears_.end(),
                                              [](const auto& gear) { return gear.engaged() != 0; }))
      visit("gears", self.gears_);
    if (!std::is_const_v<Self> || self.synchronized_.any()) visit("synchronization", self.synchronized_);
    if (!std::is_const_v<Self> || self.surface_.any()) visit("surface", self.surface_);
  }

 private:
  /// 1/min: by 10a948 and the gear in force; infinite without a limit.
  double highest_speed(std::size_t column) const;
  /// What the PLC demands, within the highest speed of the spindle and of those that follow it, 1/min.
  double commanded_speed(std::size_t column) const;
  idl::stream::SpindleState state(std::size_t column, const SpindleStatus& status, const SpindleSetpoint& row,
                                  bool controlled, bool running_down) const;
  void limit_orientations();

  std::vector<machine::AxisInfo> axes_;
  std::vector<SpindleCoupling> couplings_;
  std::vector<SpindleOrientation> orientations_;
  std::vector<SpindleRamp> ramps_;
  std::vector<SpindleGear> gears_;
  SynchronizedSpindles synchronized_;
  SurfaceSpeeds surface_;
  std::vector<double> windows_;    // share of the commanded speed
  std::vector<double> highest_;    // 1/min, of 10a948
  std::vector<double> permitted_;  // 1/min, in this period
  double period_ = 0.001;
};

}  // namespace trunnion::drive
