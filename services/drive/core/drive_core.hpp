// SPDX-License-Identifier: Apache-2.0
// The end of the stream: executes setpoints cycle by cycle, brakes along the path when one is missing,
// continues where it stopped. No clock: the caller says when a period has passed. What moves is behind
// DriveHardware.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "axis_limits.hpp"
#include "axis_supervision.hpp"
#include "channel_streams.hpp"
#include "contracts/types.hpp"
#include "drive_enable.hpp"
#include "drive_event.hpp"
#include "drive_hardware.hpp"
#include "drive_memory.hpp"
#include "executed_rows.hpp"
#include "gantry_slaves.hpp"
#include "homing_group.hpp"
#include "machine/axes.hpp"
#include "path_rate.hpp"
#include "probe_watch.hpp"
#include "return_move.hpp"
#include "spindles.hpp"

namespace trunnion::drive {

using Mode = idl::stream::DriveMode;

class DriveCore {
 public:
  explicit DriveCore(std::unique_ptr<DriveHardware> hardware) : hardware_(std::move(hardware)) {}

  void configure(const machine::Parameters& parameters, bool virtual_time);
  bool configured() const { return !axes_.empty(); }
  /// Continues from what an earlier process left. An axis that `memory` does not have is not homed. Call
  /// after the first configure().
  void restore(const Memory& memory);
  /// Continues with its cycles, and no axis of hardware that does not know its positions itself is homed.
  void restore_without_positions(Memory memory);
  /// Axes without a reference. Not cyclic.
  std::vector<machine::AxisInfo> unreferenced() const;
  Memory memory() const;
  /// Everything that determines what follows besides the parameters; null when the hardware cannot give it.
  /// Call it when fill() and take_events() have taken everything.
  bus::Json explicit_state() const;
  /// Call after the first configure(). Throws nlohmann::json::exception when `state` is of another shape.
  void continue_from(const bus::Json& state);

  /// A batch of the gantry stage; swapped away. False when a replica differs from what is here.
  bool put(idl::stream::AxisBatch& batch) { return streams_.put(batch); }
  /// What is here of the same channel, epoch and first cycle; null when nothing is.
  const idl::stream::AxisBatch* first_arrival(const idl::stream::AxisBatch& batch) {
    const auto* channel = streams_.find(batch.channel);
    return channel == nullptr ? nullptr : channel->window.first_arrival(batch);
  }
  void request(const idl::stream::StreamRequest& request);
  void set_enables(const std::vector<std::uint8_t>& enable, bool emergency_stop);
  void set_spindle_speed(const std::vector<double>& speed) { spindles_.demand_speeds(speed); }
  /// Spindles with a constant surface speed in place of that: all that the PLC orders now.
  void set_surface_speeds(const std::vector<idl::plc::SurfaceSpeed>& speeds) {
    spindles_.demand_surface_speeds(speeds);
  }
  /// Spindles that turn to their orientation angle and are held there; not while they are coupled. `angle`
  /// deg: below 0 or missing = that of the parameters.
  void set_spindle_orientation(const std::vector<std::uint8_t>& orient,
                               const std::vector<double>& angle = {}) {
    spindles_.demand_orientations(orient, angle);
  }
  /// Gears that are engaged, from 1; 0 or missing = the spindle has none.
  void set_spindle_gears(const std::vector<std::uint8_t>& gear) { spindles_.engage_gears(gear); }
  /// Spindles that follow others: all that the PLC requests now.
  void set_spindle_couplings(const std::vector<idl::plc::SpindleCoupling>& couplings) {
    spindles_.couple(couplings);
  }

  /// With the probe on, a rising edge of skip input 1 outside a skip move stops the axes and is an alarm.
  void set_probe(bool on) { row_.probe_on = on; }

  /// Begins a test of servo loops, or ends one. Returns why it is refused, else an empty text.
  std::string request_test(const idl::servo::TestRequest& request);

  /// True when a tick would execute, brake, return or settle; false when there is nothing to do but wait.
  /// `give_up`: the setpoints that are missing have been waited for long enough.
  bool can_step(bool give_up) const;
  /// One period. In virtual time call it only when can_step().
  void step();

  /// Rows executed since the last call and the state now; empty rows when nothing was executed.
  void fill(idl::stream::Feedback& out);
  /// Executed rows that fill() will report.
  std::uint32_t rows() const { return rows_.count(); }
  std::vector<DriveEvent> take_events();
  /// A stop on the path has been left for good since the last call.
  bool take_resumed() { return std::exchange(resumed_, false); }
  /// Stops along the path and holds.
  void stop();
  /// Alarms about to be reset: supervision may fire again.
  void acknowledge();

  Mode mode() const { return mode_; }
  std::uint64_t next() const { return next_; }
  std::uint64_t tick() const { return tick_; }
  std::uint64_t starved() const { return starved_; }
  bool any_active() const { return streams_.any_active(); }
  /// A channel owes setpoints that are not here while the axes move or must begin.
  bool waiting() const;
  double period() const { return dt_; }
  std::size_t axes() const { return axes_.size(); }
  const std::vector<double>& commands() const { return command_; }
  DriveHardware& hardware() { return *hardware_; }
  const DriveHardware& hardware() const { return *hardware_; }
  /// A test of servo loops runs whose time passes at rest.
  bool needs_time() const { return hardware_->tester() != nullptr && hardware_->tester()->needs_time(); }

  /// For libs/cluster/snapshot.
  /// No fields, configure() sets them: dt_, virtual_time_, lead_, prefill_, revision_, axes_, limits_.
  /// No fields, the hardware has a state of its own and gives its status: hardware_, status_.
  /// No fields, every use sets them before: scratch_, before_.
  /// No fields, the service has taken them: resumed_, events_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    ChannelStreams::fields(self.streams_, visit);
    visit("row", self.row_), visit("rows", self.rows_);
    ProbeWatch::fields(self.probe_, visit);
    visit("mode", self.mode_);
    DriveEnable::fields(self.enable_, visit);
    visit("next", self.next_), visit("tick", self.tick_), visit("starved", self.starved_);
    visit("command", self.command_), visit("target", self.target_), visit("velocity", self.velocity_);
    PathRate::fields(self.rate_, visit);
    visit("off_path", self.off_path_), visit("reserve", self.reserve_);
    visit("settle", self.settle_);
    HomingGroup::fields(self.homing_, visit);
    ReturnMove::fields(self.return_, visit);
    Spindles::fields(self.spindles_, visit);
    AxisSupervision::fields(self.supervision_, visit);
    GantrySlaves::fields(self.slaves_, visit);
    if (!std::is_const_v<Self> || self.after_alignment_ != Mode::OFF)
      visit("after_alignment", self.after_alignment_);
  }

 private:
  StreamSupply supply() const { return streams_.supply(next_, lead_); }
  void target_of(std::uint64_t cycle, std::vector<double>& out);
  double stop_periods(std::uint64_t cycles);
  bool enough(const StreamSupply& supply) const;
  bool prefilled(const StreamSupply& supply) const;
  void start(ChannelStream& channel, const idl::stream::StreamRequest& request);
  bool all_homed();
  void home(ChannelStream& channel, const idl::stream::StreamRequest& request);
  void begin_waiting_search();
  void reference(std::size_t column, double shift);
  void reference_members();
  void step_homing();
  void note_search(HomingCycle::State state);
  void follow_supply();
  void begin_braking();
  bool pass_cycle();
  void advance(double cycles);
  bool approach_needed();
  void follow();
  void brake();
  void resume();
  void step_return();
  void plan_return(const std::vector<double>& target);
  void exchange();
  void place_at_hardware();
  void switch_on();
  void await_drives();
  void lose_control(std::string text);
  void switch_off();
  void stop_at_newest_row(std::uint64_t starved);
  void supervise();
  void supervise_spindles();
  bool spindles_run_down() const;
  bool testing() const { return hardware_->tester() != nullptr && hardware_->tester()->running(); }
  void watch_probe();
  void align_slaves();
  void end_alignment();
  void report_misalignment(const GantrySlave& slave, double error);
  bool all_aligned();
  void couple_slaves();
  void stopped();
  double rate_step();
  void leave(ChannelStream& channel);
  void raise(const machine::AlarmDefinition& alarm, std::uint32_t part, std::string text);

  double dt_ = 0.001;
  bool virtual_time_ = false;
  std::uint64_t lead_ = 32;
  std::uint64_t prefill_ = 23;  // cycles at hand to begin with
  std::uint64_t revision_ = 0;
  std::vector<machine::AxisInfo> axes_;
  std::vector<AxisLimits> limits_;
  std::unique_ptr<DriveHardware> hardware_;
  SetpointRow row_;
  DriveStatus status_;
  ChannelStreams streams_;

  Mode mode_ = Mode::OFF;
  DriveEnable enable_;
  ProbeWatch probe_;
  std::uint64_t next_ = 0, tick_ = 0, starved_ = 0;
  std::vector<double> command_;   // setpoint of this period
  std::vector<double> target_;    // setpoint of cycle next_ - 1: a point of the path
  std::vector<double> velocity_;  // of the path at target_, per cycle
  std::vector<double> scratch_, before_;

  PathRate rate_;
  bool off_path_ = false;  // braking continued along the tangent, so the axes are not on the path
  bool resumed_ = false;
  std::uint64_t reserve_ = 0;  // cycles it takes to stop within the axes' limits
  std::uint32_t settle_ = 0;   // periods until the servos are at rest, in virtual time
  HomingGroup homing_;
  GantrySlaves slaves_;
  Mode after_alignment_ = Mode::OFF;  // while slaves are aligned: what follows
  ReturnMove return_;

  Spindles spindles_;

  std::vector<DriveEvent> events_;
  ExecutedRows rows_;
  AxisSupervision supervision_;
};

}  // namespace trunnion::drive
