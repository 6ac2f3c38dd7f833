// SPDX-License-Identifier: Apache-2.0
// How far the recorders of the cluster let a channel write in virtual time, so that they lose nothing.
#pragma once

#include <cstdint>
#include <limits>
#include <map>

#include "contracts/types.hpp"

namespace trunnion::channel {

/// Times are seconds of a monotonic clock.
class RecorderWatch {
 public:
  /// s without a report until a recorder is not waited for; the drive waits 1 s for a setpoint.
  static constexpr double report_timeout = 0.7;
  static constexpr std::uint64_t everywhere = std::numeric_limits<std::uint64_t>::max();

  void update(const idl::stream::RecordingProgress& progress);
  /// The cycle up to which every recorder reads in time. `beyond` would be written without them: one that
  /// holds the channel up and reports nothing is given up.
  std::uint64_t limit(std::uint64_t beyond, double now);

 private:
  struct Recorder {
    std::uint64_t until = 0;
    double holds_since = -1;  ///< < 0: it does not hold the channel up
  };
  std::map<std::uint64_t, Recorder> recorders_;
};

}  // namespace trunnion::channel
