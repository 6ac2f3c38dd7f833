// SPDX-License-Identifier: Apache-2.0
// Which spindles follow which: requests of the PLC, what refuses or ends them, and the speed of the masters
// (docs/spindles.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "contracts/types.hpp"
#include "drive_event.hpp"
#include "drive_hardware.hpp"
#include "machine/axes.hpp"
#include "spindle_coupling.hpp"
#include "spindle_synchronization.hpp"

namespace trunnion::drive {

enum class SynchronizationProblem : std::uint8_t {
  none,
  slave_missing,
  master_missing,
  own_master,
  chain,
  not_homed,
  no_acceleration,  ///< parameters that cannot be used (alarm 182)
  follows_path,     ///< the angles of a stream (tapping)
  lost,             ///< more than half a turn off; the slave continues to follow
  separated         ///< both turned when their drives went off, and each runs down by itself
};

/// Spindles are named by their numbers from 0, the columns of the machine's spindles.
struct SynchronizationFinding {
  SynchronizationProblem problem = SynchronizationProblem::none;
  std::size_t slave = 0, master = 0;
  std::size_t cause = 0;  ///< the spindle that is not homed, follows a path or is in another synchronization
  double error = 0;       ///< rev
  double speed = 0, master_speed = 0;  ///< 1/min, when they were separated
  bool kept_at_rest = false;           ///< until the request is withdrawn
};
/// The alarm of it (183 or 184). Not cyclic.
DriveEvent event_of(const SynchronizationFinding& finding, const std::vector<machine::AxisInfo>& spindles);

/// A request that was refused, or was ended by a path, is refused until the PLC withdraws it or the drives
/// come on again. A part may hold spindles that are synchronized: they stay so until they are at rest,
/// whatever stops the machine, as long as their drives are on.
class SynchronizedSpindles {
 public:
  /// `period` s. Not cyclic.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& spindles,
                 double period);
  /// All that the PLC requests now. Of two requests for one slave the first counts. What is in force while
  /// they run down remains so until they are at rest, also when the drives are enabled again before that;
  /// then only the same request continues it, and otherwise the masters continue to slow down.
  void couple(const std::vector<idl::plc::SpindleCoupling>& couplings);
  /// Something is requested.
  bool any() const;
  /// The masters slow down to a standstill whatever they are ordered, and their slaves with them.
  void run_down(bool on) { run_down_ = on; }
  /// Before the first period under control: what is requested now begins when both spindles are at rest. What
  /// was refused is judged again.
  void await_rest();
  /// The spindle is kept at rest until then, or because it is not homed.
  bool waits(std::size_t spindle) const;
  /// Synchronized spindles must be controlled to come to rest together; no longer than the ramp of their
  /// master and spindle_rest_timeout.
  bool must_run_down(const std::vector<SpindleStatus>& status) const;

  /// One period, first: begins and ends synchronizations. Without control of the drives there are none;
  /// while only the spindles are controlled, to run down, those continue that counted turns.
  void judge(const std::vector<SpindleCoupling>& streams, const std::vector<SpindleStatus>& status,
             bool controlled, bool running_down = false);
  /// The spindle follows a master; its own orders are without effect.
  bool follows(std::size_t spindle) const;
  /// The spindle is the master of one that follows.
  bool leads(std::size_t spindle) const;
  /// Of a spindle that follows.
  std::size_t master_of(std::size_t spindle) const { return slaves_[spindle].master(); }
  /// deg/s2 at `speed` (1/min): of the slowest of the spindle and those that follow it.
  double lowest_acceleration(std::size_t spindle, double speed) const;
  /// Then: the setpoints of masters and slaves in place of their own in `out`. `highest`: 1/min that each
  /// spindle may turn at; a master must be ordered no more than its slaves may.
  void step(const std::vector<SpindleStatus>& status, const std::vector<double>& highest,
            std::vector<SpindleSetpoint>& out);

  /// Of this period.
  const std::vector<SynchronizationFinding>& findings() const { return findings_; }
  /// Master, error and correction; of a slave its condition and reference, too.
  void fill(idl::stream::SpindleState& out, std::size_t spindle) const;

  /// No fields, configure() sets them: count_, period_, given_.
  /// No fields, every period begins with others: findings_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("slaves", self.slaves_), visit("masters", self.masters_);
    if (!std::is_const_v<Self> || self.ramps_ != self.given_) visit("ramps", self.ramps_);
    if (!std::is_const_v<Self> || self.run_down_) visit("run_down", self.run_down_);
    if (!std::is_const_v<Self> || self.settling_ != 0) visit("settling", self.settling_);
  }

 private:
  struct Slave {
    bool ordered = false, refused = false;
    idl::plc::SpindleCoupling order;
    SpindleSynchronization control;
    bool waits = false;  // for both spindles to be at rest
    // What the PLC wants instead of the order in force, which stays until both are at rest.
    bool deferred = false, requested = false;
    idl::plc::SpindleCoupling request;

    std::size_t master() const { return order.master; }
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("ordered", self.ordered), visit("refused", self.refused), visit("order", self.order);
      visit("control", self.control);
      if (!std::is_const_v<Self> || self.waits) visit("waits", self.waits);
      if (!std::is_const_v<Self> || self.deferred) {
        visit("deferred", self.deferred), visit("requested", self.requested);
        visit("request", self.request);
      }
    }
  };
  struct Master {
    bool active = false;      // in the period before
    bool positioned = false;  // it was turned to an angle (orientation)
    double reference = 0;     // 1/min
    double angle = 0;         // rev, of the setpoint while positioned

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("active", self.active), visit("positioned", self.positioned);
      visit("reference", self.reference), visit("angle", self.angle);
    }
  };

  SynchronizationFinding obstacle(std::size_t slave, const std::vector<SpindleCoupling>& streams,
                                  const std::vector<SpindleStatus>& status) const;
  /// What the PLC requests now is not what is in force.
  static bool ends(const Slave& slave);
  bool keeps(const Slave& slave) const {
    return slave.control.closed() && (run_down_ || (slave.deferred && ends(slave)));
  }
  void take(Slave& slave);
  bool in_closed(std::size_t spindle) const;
  void take_ramps();
  bool must_rest(std::size_t master) const;
  void forget_masters();
  bool at_rest(std::size_t slave, const std::vector<SpindleStatus>& status) const;
  bool ramps() const;
  double change(std::size_t master, double speed) const;
  void step_master(std::size_t spindle, const SpindleStatus& status, SpindleSetpoint& out);

  std::size_t count_ = 0;  // of spindles that exist
  double period_ = 0.001;
  std::vector<RampSettings> given_;  // of the parameters
  std::vector<RampSettings> ramps_;  // in force
  std::vector<Slave> slaves_;        // by number; also of numbers that no spindle has, to refuse them once
  std::vector<Master> masters_;      // by number
  bool run_down_ = false;
  std::uint32_t settling_ = 0;  // periods behind the ramps in which only the spindles were controlled
  std::vector<SynchronizationFinding> findings_;
};

}  // namespace trunnion::drive
