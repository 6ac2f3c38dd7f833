// SPDX-License-Identifier: Apache-2.0
// A machine behind LinuxCNC's HAL: setpoint rows go through HAL's streamer, encoders and switches come back
// through its samplers, HAL's servo thread is the clock. docs/hal.md describes the columns and what the .hal
// file must do.
#pragma once

#include <array>
#include <chrono>
#include <memory>

#include "columns.hpp"
#include "drive_hardware.hpp"
#include "hal_session.hpp"
#include "hal_streams.hpp"
#include "storage/retained_pair.hpp"

namespace trunnion::drive {

class HalHardware : public DriveHardware {
 public:
  /// `queue`: rows kept in HAL's FIFO. `state_directory` keeps the references of the axes.
  HalHardware(const HalSession::Options& session, std::uint32_t queue, const std::string& state_directory);

  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                 const std::vector<machine::AxisInfo>& spindles, double period) override;
  void restore(std::span<const double>, std::span<const std::uint8_t>) override {}
  void status(DriveStatus& out) const override;
  bool enabled() const override;
  void reset_faults() override { fault_reset_rows_ = 100; }
  void set_reference(std::size_t axis, double shift) override;
  void exchange(const SetpointRow& row, DriveStatus& status, EncoderRowSink& rows) override;
  std::uint64_t read(DriveStatus& status, EncoderRowSink& rows) override;
  bool is_clock() const override { return true; }
  bool period_due() override;
  void end() override;

 private:
  static constexpr std::size_t kept_rows = 1024;  // above every queue and what the samplers hold behind it
  /// What must survive this process: it is true of one HAL session only.
  struct Memory {
    std::array<char, 32> session{};
    std::uint32_t axes = 0;
    std::array<std::uint8_t, 32> homed{};
    std::array<double, 32> shift{};  ///< machine position less HAL's
  };
  struct Axis {
    bool needs_homing = false;
    AxisStatus status;
    std::array<double, kept_rows> setpoint{};  // by number
  };

  void attach();
  void take_references();
  void first_sample();
  void check_period();
  [[noreturn]] void give_up(const char* what);
  void write(const SetpointRow& row);
  void take(const HalSample& sample);
  void report_skip_edges(const HalSample& sample, EncoderRowSink& rows);
  std::uint64_t number_of(std::uint32_t in_hal) const;
  double shift(std::size_t axis) const { return memory_.shift[axis]; }

  HalSession session_;
  std::uint32_t queue_;
  storage::RetainedPair file_;
  Memory memory_;
  std::unique_ptr<HalStreams> streams_;
  SetpointColumns setpoint_columns_;
  SampleColumns sample_columns_;
  double period_ = 0.001;
  std::vector<Axis> axes_;
  std::vector<SpindleStatus> spindles_;
  HalRow row_{};
  HalSample sample_;
  std::vector<double> position_, angle_;  // of the sample
  std::array<bool, most_skip_inputs> skip_inputs_{};
  unsigned last_period_ = 0;

  std::uint32_t first_number_ = 0;  // in HAL, of row 0 of this process
  std::uint64_t newest_ = 0;        // row handed over
  std::uint64_t in_force_ = 0;      // row of the newest sample, 0: not one of this process
  std::uint64_t enabled_from_ = 0;  // row from which on `enable` is given; 0: it is not
  int fault_reset_rows_ = 0;
  bool controlled_ = false;
  std::chrono::steady_clock::time_point sampled_;
};

}  // namespace trunnion::drive
