// SPDX-License-Identifier: Apache-2.0
// The spindles of the machine. Each has the speed that the PLC demands, turns to its orientation angle and is
// held there, or follows an angle of the stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "drive_hardware.hpp"
#include "machine/axes.hpp"
#include "spindle_coupling.hpp"
#include "spindle_orientation.hpp"

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
  /// Spindles that are to be oriented; not while they are coupled.
  void demand_orientations(const std::vector<std::uint8_t>& orient);

  SpindleCoupling& coupling(int column) { return couplings_[static_cast<std::size_t>(column)]; }
  /// Coupled spindles continue at the speed of their last setpoint for `cycles`.
  void lead_on(double cycles);

  /// One period: the setpoint of every spindle.
  void step(const std::vector<SpindleStatus>& status, bool controlled, std::vector<SpindleSetpoint>& out);
  void fill(const std::vector<SpindleStatus>& status, idl::stream::Feedback& out) const;

  /// No field, configure() sets it: axes_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("spindles", self.couplings_), visit("orientations", self.orientations_);
  }

 private:
  std::vector<machine::AxisInfo> axes_;
  std::vector<SpindleCoupling> couplings_;
  std::vector<SpindleOrientation> orientations_;
};

}  // namespace trunnion::drive
