// SPDX-License-Identifier: Apache-2.0
// A run without a cluster: the real interpreter, motion and kinematics, and a drive that follows as it is
// told.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "report/programmed_path.hpp"

namespace trunnion::report::test {

/// The trunnion table of configs/machines/ac-table: axes X Y Z A C, both rotary axes through (0, 0, -400),
/// G54 at (0, 0, -380), tool 1 of 100 mm.
MachineTables ac_table();

struct RunOptions {
  std::string file;
  std::string program;
  /// Changes the position the encoders show, mm and deg: axes X Y Z A C of cycle n after the start.
  std::function<void(std::uint64_t n, std::array<double, 5>& axes)> encoder_error;
  /// Changes the setpoints of the axes as compensation does, mm and deg; the encoders follow.
  std::function<void(std::uint64_t n, std::array<double, 5>& axes)> compensation;
  std::array<double, 5> play{};  ///< 10a910 of X Y Z A C, mm and deg
  int skipped_batch = -1;        ///< this gantry batch is left out of the recording
  int late_batches = 0;          ///< the recording begins so many path batches late
  bool replicas = false;         ///< every kinematics batch comes twice
  bool cut_off = false;          ///< the file ends without a summary
};

inline constexpr std::uint64_t first_cycle = 1000, batch_cycles = 8;
inline constexpr std::int64_t start_time = 1'700'000'000'000'000'000;  // ns
inline constexpr std::int64_t batch_interval = 2'000'000;              // ns: four times as fast as real time
inline constexpr std::int64_t stage_latency[] = {10'000, 20'000, 30'000,
                                                 40'000};  // ns, the last to the feedback

/// Writes the recording; returns the number of cycles. Fails the test on an alarm.
std::uint64_t record_run(const RunOptions& options);

}  // namespace trunnion::report::test
