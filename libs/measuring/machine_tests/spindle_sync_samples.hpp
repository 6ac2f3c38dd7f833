// SPDX-License-Identifier: Apache-2.0
// The angles of the spindles as the drive has reported them during a program.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contracts/types.hpp"
#include "machine/axes.hpp"
#include "servo_analysis/spindle_sync_evaluation.hpp"

namespace trunnion::machine_tests {

class SpindleSyncSamples {
 public:
  /// `interval` s: interpolation cycle.
  explicit SpindleSyncSamples(double interval) : interval_(interval) {}
  /// In the order in which they were written.
  void add(const idl::stream::Feedback& feedback);
  /// A cycle is missing.
  bool lost() const { return lost_; }
  /// Of two spindles by their numbers, from 0.
  servo_analysis::SpindleSyncRecord record(std::size_t master, std::size_t slave) const;

 private:
  struct Moment {
    double time = 0;  // s
    bool cycle = false;
    std::vector<double> angles;  // rev, of each spindle
  };
  struct Report {
    std::size_t at = 0;
    std::vector<idl::stream::SpindleState> spindles;
  };

  double interval_;
  bool lost_ = false;
  std::uint64_t next_ = 0;  // cycle after the newest row; 0 = none was seen
  std::vector<Moment> moments_;
  std::vector<Report> reports_;
};

/// Why the machine cannot be tested now; empty when it can. `spindles` as of machine::spindles().
std::string spindle_sync_obstacle(const std::vector<machine::AxisInfo>& spindles,
                                  const idl::stream::Feedback& feedback, const idl::plc::Outputs& outputs);

/// How the PLC of the machine is ordered: blocks of a program.
struct SpindleSyncOrders {
  std::string on = "M80", off = "M84";    ///< couple the slave and end it
  std::string start = "M3", stop = "M5";  ///< of the master, whose speed is S
};

struct SpindleSyncOptions : SpindleSyncOrders {
  std::vector<double> speeds;       ///< 1/min, of the master, one after the other; empty: by its gears
  double settling = 2, record = 5;  ///< s of machine time
};

/// With the speed and, when it is above 0, the next one, 1/min. Dwells `settling` and `record` s, and
/// 2 * `settling` after the change of the speed.
std::string spindle_sync_program(const SpindleSyncOrders& orders, double speed, double next, double settling,
                                 double record);
/// Brings the spindles to rest.
std::string spindle_stop_program(const SpindleSyncOrders& orders);

}  // namespace trunnion::machine_tests
