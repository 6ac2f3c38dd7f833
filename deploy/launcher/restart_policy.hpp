// SPDX-License-Identifier: Apache-2.0
// When a process that ended is started again, and what its silence means. No clock: the caller gives the
// time.
#pragma once

namespace trunnion::launcher {

enum class Pulse {
  beating,
  silent,  ///< it cannot be relied on; it may still come back by itself
  hung     ///< it will not come back: to be killed
};

/// Of one process of the cluster. All times in seconds of one monotonic clock.
class RestartPolicy {
 public:
  static constexpr double short_life = 10;    ///< a process that lived longer ended for a new reason
  static constexpr double first_delay = 0.1;  ///< after the first short life, doubled by every further one
  static constexpr double longest_delay = 2;
  static constexpr int most_short_lives = 5;   ///< in a row; then it does not stay up
  static constexpr double rare_delay = 30;     ///< between two tries of what does not stay up
  static constexpr double silent_after = 1.5;  ///< six beats
  static constexpr double hung_after = 4;
  static constexpr double first_beat_within = 7.5;  ///< of the start; loading takes its time

  void started(double now);
  void beat(double now);
  /// Its silence so far does not count.
  void wait(double now) { heard_ = now; }
  /// Between started() and ended().
  Pulse pulse(double now) const;
  void ended(double now);
  /// After ended(): the time for a new start has come.
  bool due(double now) const { return now >= start_at_; }
  /// Too many short lives in a row: an alarm, and rare tries.
  bool gave_up() const { return short_lives_ >= most_short_lives; }
  int short_lives() const { return short_lives_; }
  /// The operator has seen to it: what was given up is started at once and has all its tries again.
  void retry();

 private:
  double started_ = 0, heard_ = 0, start_at_ = 0;
  bool beaten_ = false;
  int short_lives_ = 0;
};

}  // namespace trunnion::launcher
