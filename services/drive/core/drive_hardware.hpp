// SPDX-License-Identifier: Apache-2.0
// What the executor of setpoints needs of the machine: axes, spindles, switches and probes. The
// implementations are simulation/ (servo loops and mechanics in this process) and hal/ (LinuxCNC's HAL). A
// more exact model of a machine (masses, encoders, measuring instruments) is one more implementation.
//
// One thread calls everything here. Positions are machine coordinates: mm or deg, velocities mm/s or deg/s,
// accelerations mm/s2 or deg/s2; spindle speeds 1/min, spindle angles revolutions, clockwise positive, turns
// counted. Nothing here is safety-rated.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "bus/json_type.hpp"
#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "machine/parameters.hpp"
#include "servo_tester.hpp"

namespace trunnion::drive {

/// What an axis is to do in one period: reach `position` at its end. The other two are feed-forward.
struct AxisSetpoint {
  double position = 0, velocity = 0, acceleration = 0;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("position", self.position), visit("velocity", self.velocity);
    visit("acceleration", self.acceleration);
  }
};

struct SpindleSetpoint {
  double speed = 0;      ///< reference of the speed; not in force while coupled
  bool coupled = false;  ///< the spindle follows `angle` (tapping, orientation)
  double angle = 0;
  std::uint8_t gear = 0;  ///< in force, from 1; 0 = the spindle has no gears

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("speed", self.speed), visit("coupled", self.coupled), visit("angle", self.angle);
    if (!std::is_const_v<Self> || self.gear != 0) visit("gear", self.gear);
  }
};

/// One period of every axis and spindle.
struct SetpointRow {
  std::uint64_t number = 0;  ///< counts the periods of this process from 1 on
  bool enable = false;       ///< the drives shall be switched on; false: braked or held by the hardware
  /// The axes follow the row. When false its positions are without effect, and the spindles run down unless
  /// they are controlled alone.
  bool controlled = false;
  /// The axes do not follow the row, but the spindles do: synchronized ones run down together. `enable` stays
  /// on meanwhile, and the axes are held where they are.
  bool spindles_controlled = false;
  bool moving = false;  ///< a channel has the axes
  std::vector<AxisSetpoint> axes;
  std::vector<SpindleSetpoint> spindles;
  bool probe_on = false;  ///< the touch probe is switched on

  bool controls_spindles() const { return controlled || spindles_controlled; }

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("number", self.number), visit("enable", self.enable), visit("controlled", self.controlled);
    visit("moving", self.moving);
    visit("axes", self.axes), visit("spindles", self.spindles), visit("probe_on", self.probe_on);
    if (!std::is_const_v<Self> || self.spindles_controlled)
      visit("spindles_controlled", self.spindles_controlled);
  }
};

struct AxisStatus {
  double position = 0;         ///< of the encoder
  double following_error = 0;  ///< setpoint that was in force less `position`
  /// Setpoint that leaves the axis where it is: the newest one while the axis is controlled, its place
  /// otherwise.
  double hold_position = 0;
  double velocity = 0;
  double torque = 0;    ///< share of the rated torque; 0 where it is not measured
  bool enabled = true;  ///< the drive of the axis is switched on
  bool fault = false;   ///< the drive of the axis reports an error, cleared by reset_faults()
  bool homed = true;    ///< the position has its reference
  /// Of motor and load since the start, mm or deg; 0 where there is one encoder.
  double encoder_difference = 0;
  bool home_switch = false;  ///< state of the home switch
  double home_latch = 0;     ///< position at the newest rising edge of the home switch
  std::uint64_t marks = 0;   ///< index marks that were passed
  double mark_latch = 0;     ///< position at the newest one
  /// A scale with distance-coded marks: two were passed, and it reads `scale_shift` more than `position`.
  bool scale_known = false;
  double scale_shift = 0;
  const char* fault_text = "";  ///< what the drive reports with `fault`
  bool partner_fault = false;   ///< the drive has stopped because that of its gantry partner has a fault
};

struct SpindleStatus {
  double speed = 0, angle = 0;
  /// The index mark was passed since the start: `angle` is whole at it. Until then it counts from where the
  /// spindle was, and it steps when the spindle is homed, but never while the spindle is coupled.
  bool homed = true;
  double torque = 0;  ///< share of what the motor can at this speed, without sign; 0 = not known
};

/// Encoder positions at the end of the period of row `number`, when its setpoints should be reached; hardware
/// that samples once a period: at its first sample with that row.
struct EncoderRow {
  std::uint64_t number = 0;
  std::span<const double> axes;
  std::span<const double> spindles;
};

/// What comes back of the rows that were handed over, in the order of their numbers.
class EncoderRowSink {
 public:
  virtual ~EncoderRowSink() = default;
  /// A skip input has come on before the row `number` came into force and after the one before. `edge` has
  /// the encoder positions of that moment; its cycle is filled in by the executor.
  virtual void skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) = 0;
  virtual void encoder_row(const EncoderRow& row) = 0;
};

/// The machine after a period.
struct DriveStatus {
  std::vector<AxisStatus> axes;
  std::vector<SpindleStatus> spindles;
  std::uint8_t skip_inputs = 0;  ///< that are on: bit 0 = input 1
};

class DriveHardware {
 public:
  virtual ~DriveHardware() = default;

  /// Not cyclic, while nothing moves or in motion when a parameter revision changes. The first call makes the
  /// axes; those of a simulation are at rest at their reference coordinates then. `period` s. Throws
  /// std::runtime_error.
  virtual void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& axes,
                         const std::vector<machine::AxisInfo>& spindles, double period) = 0;
  /// Not cyclic, after the first configure(): positions an earlier process has left, as absolute encoders
  /// would. An axis with `homed` 0 has no reference until set_reference(). Hardware that knows its positions
  /// itself ignores both.
  virtual void restore(std::span<const double> positions, std::span<const std::uint8_t> homed) = 0;
  /// Everything that determines the next period besides the parameters, for a recording; null when the
  /// hardware cannot give it. Not cyclic.
  virtual bus::Json explicit_state() const;
  /// After the first configure(): continues as the hardware that gave `state`. Not cyclic. Throws
  /// nlohmann::json::exception when it is of another shape.
  virtual void continue_from(const bus::Json& /*state*/) {}
  /// What the machine itself keeps while no process controls it, besides its positions: temperatures of a
  /// simulation. Always as many bytes; empty: nothing. Valid until the next call. Cyclic: no allocation.
  virtual std::span<const std::uint8_t> kept() { return {}; }
  /// After the first configure(): what kept() of an earlier process gave. Not cyclic.
  virtual void restore_kept(std::span<const std::uint8_t> /*kept*/) {}
  /// The machine now, without a period; not cyclic.
  virtual void status(DriveStatus& out) const = 0;

  /// The drives of all axes are switched on and without a fault. Cyclic.
  virtual bool enabled() const = 0;
  /// Axes come to rest although the drives are off. Cyclic.
  virtual bool running_out() const { return false; }
  /// The operator resets alarms. Cyclic.
  virtual void reset_faults() = 0;
  /// From now on the positions of an axis are greater by `shift`, and the axis is homed. Not cyclic, at
  /// standstill.
  virtual void set_reference(std::size_t axis, double shift) = 0;

  /// Before a row is computed: reads what has come from the machine. Returns the periods since the last call
  /// in which the hardware was without a row; it has stopped the axes at the newest one then. Cyclic: no
  /// allocation once vectors have their size, no lock, no waiting. A simulation has nothing to read.
  virtual std::uint64_t read(DriveStatus&, EncoderRowSink&) { return 0; }
  /// One period: hands over the row. Cyclic, as read(). Every row comes back through `rows` once it was in
  /// force, in this call (a simulation) or in a later read() (hardware with a queue). Rows that got lost on
  /// the way are left out.
  virtual void exchange(const SetpointRow& row, DriveStatus& status, EncoderRowSink& rows) = 0;

  /// True: the hardware is the clock, and period_due() says when the next row is wanted. False: the caller
  /// is.
  virtual bool is_clock() const { return false; }
  /// The hardware has room for another row. Cyclic, asked before every exchange() when is_clock(). Throws
  /// std::runtime_error with one line when the hardware does not run any longer.
  virtual bool period_due() { return true; }
  /// Null where the hardware cannot test its servo loops.
  virtual ServoTester* tester() { return nullptr; }
  /// The process is told to end. Not cyclic.
  virtual void end() {}
};

}  // namespace trunnion::drive
