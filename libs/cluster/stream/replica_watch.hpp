// SPDX-License-Identifier: Apache-2.0
// The status of the replicas of each stage, from their progress: joining, in step or dropped.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "contracts/types.hpp"
#include "machine/machine.hpp"
#include "stream/stage_names.hpp"

namespace trunnion::stream {

/// The part of the alarm redundancy_lost when it is a channel's, so that `status` can name the replica.
inline std::uint32_t replica_part(Stage stage, std::uint8_t number) {
  return static_cast<std::uint32_t>(stage) * 256u + number;
}

/// For one channel. Times are seconds of a monotonic clock.
class ReplicaWatch {
 public:
  static constexpr double progress_timeout = 0.1;  ///< s without progress until a replica is dropped
  static constexpr double report_timeout = 0.5;    ///< s without a report until it lags
  static constexpr double start_timeout = 2.0;     ///< s for which a start waits for a replica
  static constexpr std::uint64_t everywhere = std::numeric_limits<std::uint64_t>::max();

  enum class Status { joining, in_step, dropped };
  struct Replica {
    Stage stage{};
    std::uint8_t number = 0;
    Status status = Status::joining;
    std::uint32_t epoch = 0;
    std::uint64_t next = 0;
    bool reports_in_step = false;
    double last_report = 0;    ///< 0 = never
    double lagging_since = 0;  ///< 0 = it does not lag
    bool lags() const { return lagging_since != 0; }
  };
  struct Change {
    Stage stage{};
    std::uint8_t number = 0;
    bool lost = false;  ///< dropped; false: in step again
  };

  ReplicaWatch() = default;
  /// Follows the replicas of every stage of `services` that has more than one.
  ReplicaWatch(const std::vector<machine::ServiceEntry>& services, double now);

  void update(const idl::stream::StageProgress& progress, double now);
  /// Evaluates the status again; call it at least every 20 ms. A dropped replica is in step again within 2 *
  /// `ahead` cycles of the other one. Returns the replicas dropped or in step again since the last call.
  std::vector<Change> evaluate(std::uint64_t ahead, double now);

  /// Every replica is in step, or has been late for longer than a start waits.
  bool may_start(double now) const;
  /// The cycle that the slowest replica in step computes next, `everywhere` without one.
  std::uint64_t floor() const;
  const std::vector<Replica>& replicas() const { return replicas_; }

 private:
  bool behind(const Replica& replica) const;
  bool far_behind(const Replica& replica, std::uint64_t distance) const;
  std::vector<Replica> replicas_;
};

}  // namespace trunnion::stream
