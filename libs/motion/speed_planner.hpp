// The speed stage: how far along the path each cycle goes.
#pragma once

#include "motion/corner_limits.hpp"
#include "motion/planned_segment.hpp"

namespace trunnion::motion {

/// Overrides of one cycle: 1 is as programmed. Values are clamped to 0..1.5 (rapid: 0..1); 0 holds.
struct Overrides {
  double feed = 1;
  double rapid = 1;
  bool hold = false;  ///< brake to a standstill on the path and stay there
};

/// Plans and steps the speed along a chain of segments. A segment is planned once the path behind its end is
/// known for half a smoothing window of travel, or ends; motion never enters a segment that is not planned,
/// and always can stop at the end of the last planned one. Steady state allocates nothing.
class SpeedPlanner {
 public:
  /// Most segments looked ahead.
  static constexpr std::uint64_t look_ahead = 2560;

  SpeedPlanner(const CornerRules& rules, double cycle_seconds);

  /// Forgets everything; the next segment starts from a standstill.
  void clear();

  /// clear() with other rules.
  void restart(const CornerRules& rules);

  bool can_accept() const;

  /// Appends a segment that begins where the last one ended. `stop_before`: the smoothing is flushed first.
  /// `wait_cycles`: then stand still that long. A segment without length only waits.
  void push(const PlannedSegment& segment, bool stop_before, int wait_cycles);

  /// Nothing follows: the path ends with a full stop behind the last segment.
  void finish();

  /// Brakes on the path; when standing, everything left is dropped.
  void abort();

  /// Moves on by one cycle.
  void step(const Overrides& overrides);

  bool empty() const { return ring_.size() == 0; }
  /// Every segment pushed is done (or dropped).
  bool done() const;
  /// The segment the path point is on. Only when not empty().
  const PlannedSegment& current() const { return ring_[current_]; }
  /// The first segment has been entered.
  bool started() const { return entered_; }
  /// Path length within current().
  double travelled() const { return travelled_; }
  double speed() const { return speed_; }
  bool aborting() const { return aborting_; }
  bool waiting() const { return wait_ > 0; }

 private:
  void plan();
  bool rate_corner(std::uint64_t index);
  bool limit_around(std::uint64_t corner, double speed);
  void release();
  double soft_limit(const PlannedSegment& segment) const;
  double braking(double distance, double end, double acceleration, double before) const;
  double start_speed(std::uint64_t index) const;
  void reach_back(std::uint64_t from);
  double feasible(double speed) const;
  double crossing_acceleration(double distance) const;
  void enter(std::uint64_t index);
  void advance(double distance);

  CornerRules rules_;
  double cycle_;
  SegmentRing ring_;
  std::uint64_t rated_ = 0;     // corners before this one have their contour limit
  std::uint64_t released_ = 0;  // segments before this one are planned
  std::uint64_t current_ = 0;
  double travelled_ = 0;
  double speed_ = 0;
  int wait_ = 0;
  bool entered_ = false;
  bool finished_ = false;
  bool stop_next_ = true;
  bool aborting_ = false;
  double feed_override_ = 1;
  double rapid_override_ = 1;
};

}  // namespace trunnion::motion
