// SPDX-License-Identifier: Apache-2.0
// Alarms of the simulated drives, and how their axes stop. At an emergency alarm the axis coasts, at a
// general one it stops as 10a941 (PB45) says; the other side of a gantry likewise where 10a943 (PB65) joins
// them, with alarm 483. All other axes brake. Source: HNC-8 2.7.4.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "gantry_link.hpp"

namespace trunnion::drive {

class DriveFaults {
 public:
  /// `faults`: of each axis, where truth.yaml has one.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                 const std::vector<const truth::DriveTruth*>& truths);
  /// The loads before a period under control, and after it.
  void before(const std::vector<SimulatedAxis>& axes);
  void after(const std::vector<SimulatedAxis>& axes, const std::vector<GantryLink>& links);

  bool any() const { return any_; }
  /// Axes move although the drives are off.
  bool running() const;
  const std::vector<RunOut>& ways() const { return ways_; }
  /// After a period without control: axes at rest are held from now on.
  void settle(const std::vector<SimulatedAxis>& axes);
  /// The operator resets alarms; without effect while an axis moves.
  void reset();
  void status(std::vector<AxisStatus>& out) const;

  /// No field, configure() sets it: axes_. No field, before() sets it in every period: before_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("any", self.any_), visit("periods", self.periods_), visit("faulty", self.faulty_);
    visit("partner", self.partner_), visit("ways", self.ways_);
  }

 private:
  struct Axis {
    std::optional<truth::DriveFaultTruth> fault;
    bool coasts = false;  // PB45
  };
  void stop(std::size_t column, const std::vector<GantryLink>& links);
  RunOut way(std::size_t column, bool emergency) const {
    return emergency || axes_[column].coasts ? RunOut::coasts : RunOut::brakes;
  }

  std::vector<Axis> axes_;
  std::vector<double> before_;
  std::vector<std::uint8_t> faulty_, partner_;
  std::vector<RunOut> ways_;
  bool any_ = false;
  std::uint32_t periods_ = 0;  // without control
};

}  // namespace trunnion::drive
