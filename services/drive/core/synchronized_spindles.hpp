// SPDX-License-Identifier: Apache-2.0
// Which spindles follow which: requests of the PLC, what refuses or ends them, and the speed of the masters
// (docs/spindles.md).
#pragma once

#include <cstddef>
#include <cstdint>
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
  lost              ///< more than half a turn off; the slave continues to follow
};

/// Spindles are named by their numbers from 0, the columns of the machine's spindles.
struct SynchronizationFinding {
  SynchronizationProblem problem = SynchronizationProblem::none;
  std::size_t slave = 0, master = 0;
  std::size_t cause = 0;  ///< the spindle that is not homed, follows a path or is in another synchronization
  double error = 0;       ///< rev
};
/// The alarm of it (183 or 184). Not cyclic.
DriveEvent event_of(const SynchronizationFinding& finding, const std::vector<machine::AxisInfo>& spindles);

/// A request that was refused, or was ended by a path, is refused until the PLC withdraws it.
class SynchronizedSpindles {
 public:
  /// `period` s. Not cyclic.
  void configure(const machine::Parameters& parameters, const std::vector<machine::AxisInfo>& spindles,
                 double period);
  /// All that the PLC requests now. Of two requests for one slave the first counts.
  void couple(const std::vector<idl::plc::SpindleCoupling>& couplings);
  /// Something is requested.
  bool any() const;
  /// The masters slow down to a standstill whatever they are ordered, and their slaves with them.
  void run_down(bool on) { run_down_ = on; }

  /// One period, first: begins and ends synchronizations. Without control of the drives there are none.
  void judge(const std::vector<SpindleCoupling>& streams, const std::vector<SpindleStatus>& status,
             bool controlled);
  /// The spindle follows a master; its own orders are without effect.
  bool follows(std::size_t spindle) const;
  /// The spindle is the master of one that follows.
  bool leads(std::size_t spindle) const;
  /// deg/s2 at `speed` (1/min): of the slowest of the spindle and those that follow it.
  double lowest_acceleration(std::size_t spindle, double speed) const;
  /// Then: the setpoints of masters and slaves in place of their own in `out`.
  void step(const std::vector<SpindleStatus>& status, std::vector<SpindleSetpoint>& out);

  /// Of this period.
  const std::vector<SynchronizationFinding>& findings() const { return findings_; }
  /// Master, error and correction; of a slave its condition and reference, too.
  void fill(idl::stream::SpindleState& out, std::size_t spindle) const;

  /// No fields, configure() sets them: count_, period_, ramps_.
  /// No fields, every period begins with others: run_down_, findings_.
  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("slaves", self.slaves_), visit("masters", self.masters_);
  }

 private:
  struct Slave {
    bool ordered = false, refused = false;
    idl::plc::SpindleCoupling order;
    SpindleSynchronization control;

    std::size_t master() const { return order.master; }
    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("ordered", self.ordered), visit("refused", self.refused), visit("order", self.order);
      visit("control", self.control);
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
  double change(std::size_t master, double speed) const;
  void step_master(std::size_t spindle, const SpindleStatus& status, SpindleSetpoint& out);

  std::size_t count_ = 0;  // of spindles that exist
  double period_ = 0.001;
  std::vector<RampSettings> ramps_;
  std::vector<Slave> slaves_;    // by number; also of numbers that no spindle has, to refuse them once
  std::vector<Master> masters_;  // by number
  bool run_down_ = false;
  std::vector<SynchronizationFinding> findings_;
};

}  // namespace trunnion::drive
