// SPDX-License-Identifier: Apache-2.0
// A simulated machine: servo loops with their mechanics, spindles, skip inputs, and home switches at the
// reference coordinates. Its encoders are absolute, unless truth.yaml says otherwise, and its axes homed
// while their positions are known. A row is executed while it is handed over.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "drive_faults.hpp"
#include "drive_hardware.hpp"
#include "gantry_link.hpp"
#include "probe_input.hpp"
#include "servo_test.hpp"
#include "simulated_axis.hpp"
#include "simulated_spindle.hpp"
#include "skip_inputs.hpp"

namespace trunnion::drive {

class SimulatedHardware : public DriveHardware {
 public:
  /// `truth`: the drives of truth.yaml; the other axes are ServoAxis. `probe`: its touch probe. `beam`: of
  /// the gantry of channel 0. `spindles`: the motors of spindles, by name.
  explicit SimulatedHardware(std::map<std::string, truth::DriveTruth> truth = {},
                             const std::optional<ProbeSetup>& probe = {},
                             const std::optional<volumetric::BeamErrors>& beam = {},
                             std::map<std::string, truth::SpindleTruth> spindles = {})
      : truth_(std::move(truth)), spindle_truth_(std::move(spindles)), beam_(beam) {
    if (probe) probe_.emplace(*probe);
  }

  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                 const std::vector<machine::AxisInfo>& spindles, double period) override;
  void restore(std::span<const double> positions, std::span<const std::uint8_t> homed) override;
  bus::Json explicit_state() const override;
  void continue_from(const bus::Json& state) override;
  std::span<const std::uint8_t> kept() override;
  void restore_kept(std::span<const std::uint8_t> kept) override;
  void status(DriveStatus& out) const override;
  bool enabled() const override { return !faults_.any(); }
  bool running_out() const override { return faults_.running(); }
  void reset_faults() override { faults_.reset(); }
  void set_reference(std::size_t axis, double shift) override;
  ServoTester* tester() override { return &test_; }
  void exchange(const SetpointRow& row, DriveStatus& status, EncoderRowSink& rows) override;

  /// No fields, the constructor and configure() set them: period_, truth_, spindle_truth_, beam_, links_,
  /// linked_. No fields, every use sets them before: kept_, encoder_, angle_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("servos", self.servos_), visit("spindles", self.spindles_);
    visit("home_switches", self.home_switches_), visit("skip_inputs", self.skip_inputs_);
    visit("homed", self.homed_);
    if (!std::is_const_v<Self> || self.test_.running()) visit("test", self.test_);
    if (self.probe_) visit("probe", *self.probe_);
    if (!std::is_const_v<Self> || self.faults_.any()) visit("faults", self.faults_);
  }

 private:
  void step_axes(const SetpointRow& row);
  struct HomeSwitch {
    double position = 0, direction = 0;
    bool on = false;
    double latch = 0;

    /// No fields, configure() sets them: position, direction.
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("on", self.on), visit("latch", self.latch);
    }
  };
  double period_ = 0.001;
  std::vector<HomeSwitch> home_switches_;
  std::vector<SimulatedAxis> servos_;
  std::vector<std::uint8_t> homed_;
  std::map<std::string, truth::DriveTruth> truth_;  // by the name of the axis
  std::map<std::string, truth::SpindleTruth> spindle_truth_;
  std::optional<volumetric::BeamErrors> beam_;
  std::vector<GantryLink> links_;
  std::vector<std::uint8_t> linked_;  // the axis is one of an active link
  DriveFaults faults_;
  std::vector<SimulatedSpindle> spindles_;
  SkipInputs skip_inputs_;
  ServoTest test_;
  std::optional<ProbeInput> probe_;
  ProbeMemory kept_;
  std::vector<double> encoder_, angle_;  // of the row that is handed over
};

}  // namespace trunnion::drive
