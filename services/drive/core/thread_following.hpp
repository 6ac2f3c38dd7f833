// SPDX-License-Identifier: Apache-2.0
// Where on its path a thread is. Its setpoints belong to angles of the spindle that the channel has
// predicted; the axes go to the place that belongs to the angle that is measured. A shift is how many cycles
// of the stream that place is before (positive) or behind the setpoint of the cycle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace trunnion::drive {

/// What is measured: rev, turns counted.
struct ThreadSpindle {
  double angle = 0;    ///< at the end of the newest period that was measured
  double speed = 0;    ///< rev, mean of that period
  double periods = 1;  ///< from there to the end of the period whose setpoints are wanted
};

/// rev: what the setpoints belong to.
struct ThreadAngles {
  std::span<const double>
      next;                ///< of the cycle that is passed and those behind it, as far as the thread goes
  std::size_t ahead = 0;   ///< the largest shift
  std::uint64_t left = 0;  ///< cycles of the stream behind the one that is passed
};

/// So that every axis stays within its speed, and needs at most its acceleration on top of that of the path:
/// cycles in a period, and the change of that from one period to the next.
struct ThreadLimits {
  double rate = 0.5, change = 0.5;
};

class ThreadFollowing {
 public:
  /// Setpoints that are kept behind the cycle that is passed, and cycles that a shift reaches before it.
  static constexpr std::size_t back = 2, most_ahead = 8;
  static constexpr std::size_t most_columns = 32;
  /// The largest shift with a `lead`: the setpoints before the place must be at hand.
  static std::uint64_t ahead(std::uint64_t lead) { return std::min<std::uint64_t>(most_ahead, lead / 4); }

  /// Axes are shifted, or will be.
  bool active() const { return active_; }
  /// Columns are those of the batch.
  double shift(std::size_t column) const { return shifts_[column].cycles; }
  /// Periods since the thread began in which the place was farther from the setpoint than a shift reaches.
  std::uint64_t beyond() const { return beyond_; }

  /// One period of a thread, before its cycle is passed. `lags`, of every column: periods by which the axis
  /// is behind its setpoint.
  void follow(const ThreadSpindle& spindle, const ThreadAngles& angles, std::span<const double> lags,
              const ThreadLimits& limits);
  /// A cycle while the drive brakes or resumes: the shifts of the first `columns` stay.
  void hold(std::size_t columns, const ThreadLimits& limits);
  /// A cycle behind the thread: the shifts end.
  void fade(std::size_t columns, const ThreadLimits& limits);
  void clear() { *this = {}; }

  /// Keeps the setpoints of `cycle`, which was passed. `angle`: to which they belong, or null.
  void keep(std::uint64_t cycle, std::span<const double> setpoints, const double* angle);
  /// Setpoints of `cycle`, or the oldest there are; null when it was not passed.
  const double* kept(std::uint64_t cycle) const;

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit("active", self.active_), visit("shifts", self.shifts_);
    visit("rows", self.rows_), visit("rows_kept", self.rows_kept_), visit("next", self.next_);
    visit("angles", self.angles_), visit("angles_kept", self.angles_kept_);
    visit("speed", self.speed_), visit("speed_known", self.speed_known_), visit("beyond", self.beyond_);
  }

 private:
  struct Shift {
    double cycles = 0, rate = 0;  // rate: of the newest period
    double place = 0;             // what it follows

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit("cycles", self.cycles), visit("rate", self.rate), visit("place", self.place);
    }
  };
  static void move(Shift& shift, double place, const ThreadLimits& limits);

  bool active_ = false;
  std::array<Shift, most_columns> shifts_{};
  // Of the newest cycles that were passed, the newest first; `next_` is the one behind it.
  std::array<std::array<double, most_columns>, back> rows_{};
  std::array<double, back> angles_{};
  std::size_t rows_kept_ = 0, angles_kept_ = 0;
  std::uint64_t next_ = 0;
  double speed_ = 0;  // of the spindle in the period before
  bool speed_known_ = false;
  std::uint64_t beyond_ = 0;
};

}  // namespace trunnion::drive
