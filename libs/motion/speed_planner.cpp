#include "motion/speed_planner.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

// Highest speed for the coming cycle from which `target` is reached within `distance` with `a` afterwards:
// v^2 = target^2 + 2 a (distance - v dt), or target itself when the point is passed in this cycle.
double approach(double distance, double target, double a, double dt) {
  const double change = a * dt;
  return std::max(target, std::sqrt(change * change + target * target + 2 * a * distance) - change);
}

}  // namespace

SpeedPlanner::SpeedPlanner(const CornerRules& rules, double cycle_seconds)
    : rules_(rules), cycle_(cycle_seconds) {}

void SpeedPlanner::clear() {
  ring_.clear();
  rated_ = released_ = current_ = 0;
  travelled_ = speed_ = 0;
  wait_ = 0;
  entered_ = finished_ = aborting_ = false;
  stop_next_ = true;
}

void SpeedPlanner::restart(const CornerRules& rules) {
  rules_ = rules;
  clear();
}

bool SpeedPlanner::can_accept() const { return !aborting_ && ring_.size() - current_ < look_ahead; }

void SpeedPlanner::push(const PlannedSegment& segment, bool stop_before, int wait_cycles) {
  const bool first = ring_.size() == 0;
  const PlannedSegment* before = first ? nullptr : &ring_[ring_.size() - 1];
  PlannedSegment& entry = ring_.append();
  entry = segment;
  entry.at = before != nullptr ? before->end() : 0;
  entry.full_stop = stop_before || stop_next_ || before == nullptr ||
                    before->path.unit() != segment.path.unit() || before->path.length() <= 0 ||
                    segment.path.length() <= 0;
  // The landing on the corner counts as one of the N equal positions that flush the smoothing.
  const bool moved = before != nullptr && before->path.length() > 0;
  const int flush = entry.full_stop && moved ? rules_.limits.smoothing_cycles : 0;
  entry.wait_cycles = flush + wait_cycles;
  rate_segment(entry, entry.full_stop ? nullptr : before, rules_);
  stop_next_ = false;
  finished_ = false;
  plan();
}

void SpeedPlanner::finish() {
  finished_ = true;
  stop_next_ = true;
  plan();
}

void SpeedPlanner::abort() {
  if (!done()) aborting_ = true;
}

bool SpeedPlanner::done() const {
  return ring_.size() == 0 || (current_ + 1 == ring_.size() && entered_ && wait_ == 0 &&
                               travelled_ >= ring_[current_].path.length());
}

void SpeedPlanner::plan() {
  while (rated_ < ring_.size() && rate_corner(rated_)) ++rated_;
  while (released_ < rated_) {
    const PlannedSegment& segment = ring_[released_];
    const double needed = segment.end() + segment.limit * rules_.contour_window / 2;
    const bool ends = (released_ + 1 < ring_.size() && ring_[released_ + 1].full_stop);
    const bool all_rated = rated_ == ring_.size() && finished_;
    const bool far_enough = rated_ < ring_.size() && rated_ > released_ + 1 && ring_[rated_].at >= needed;
    if (!ends && !all_rated && !far_enough) break;
    release();
  }
}

// False when the path behind the corner is not known far enough yet.
bool SpeedPlanner::rate_corner(std::uint64_t index) {
  PlannedSegment& segment = ring_[index];
  if (segment.full_stop) return true;
  const double highest = std::max(segment.limit, ring_[index - 1].limit);
  const double known = ring_[ring_.size() - 1].end() - segment.at;
  const bool enough = finished_ || (index + 1 < ring_.size() && known >= highest * rules_.contour_window / 2);
  if (!enough) return false;
  const double speed = contour_speed(ring_, index, highest, rules_);
  if (speed < highest && !limit_around(index, speed)) {
    segment.full_stop = true;
    segment.wait_cycles += rules_.limits.smoothing_cycles;
  }
  return true;
}

// Keeps the speed within +-h of the corner. False when that reaches a segment which motion may already be on.
bool SpeedPlanner::limit_around(std::uint64_t corner, double speed) {
  const double h = speed * rules_.contour_window / 2;
  double x = 0;
  for (std::uint64_t i = corner; x < h && i > ring_.oldest() && !ring_[i].full_stop; --i) {
    PlannedSegment& segment = ring_[i - 1];
    const double next = x + segment.path.length();
    if (segment.limit > speed) {
      if (i - 1 < released_) return false;
      if (next <= h) {
        segment.limit = speed;
      } else {
        segment.exit_limit = segment.exit_zone > 0 ? std::min(segment.exit_limit, speed) : speed;
        segment.exit_zone = std::max(segment.exit_zone, h - x);
      }
    }
    x = next;
  }
  x = 0;
  for (std::uint64_t i = corner; x < h && i < ring_.size() && (i == corner || !ring_[i].full_stop); ++i) {
    PlannedSegment& segment = ring_[i];
    const double next = x + segment.path.length();
    if (segment.limit > speed) {
      if (next <= h) {
        segment.limit = speed;
      } else {
        segment.entry_limit = segment.entry_zone > 0 ? std::min(segment.entry_limit, speed) : speed;
        segment.entry_zone = std::max(segment.entry_zone, h - x);
      }
    }
    x = next;
  }
  return true;
}

void SpeedPlanner::release() {
  PlannedSegment& segment = ring_[released_];
  if (segment.entry_zone + segment.exit_zone >= segment.path.length()) {
    if (segment.entry_zone > 0) segment.limit = std::min(segment.limit, segment.entry_limit);
    if (segment.exit_zone > 0) segment.limit = std::min(segment.limit, segment.exit_limit);
    segment.entry_zone = segment.exit_zone = 0;
  }
  segment.acceleration = tangential_acceleration(ring_, released_, rules_);
  segment.start_limit = 0;
  if (!segment.full_stop) {
    const PlannedSegment& before = ring_[released_ - 1];
    double highest = std::min(before.limit, segment.limit);
    if (before.exit_zone > 0) highest = std::min(highest, before.exit_limit);
    if (segment.entry_zone > 0) highest = std::min(highest, segment.entry_limit);
    segment.start_limit = acceleration_speed(ring_, released_, highest, rules_);
  }
  ++released_;
  reach_back(released_);
}

double SpeedPlanner::soft_limit(const PlannedSegment& segment) const {
  return segment.rapid ? segment.limit * rapid_override_
                       : std::min(segment.limit, segment.feed * feed_override_);
}

// A cycle that crosses into this segment may only brake with the acceleration of the segment before it. When
// that is less, the crossing cycle is left out of the braking here, or all of it is done with the lesser
// acceleration.
double SpeedPlanner::braking(double distance, double end, double acceleration, double before) const {
  if (acceleration <= before) return std::sqrt(end * end + 2 * acceleration * distance);
  return std::max(approach(distance, end, acceleration, cycle_),
                  std::sqrt(end * end + 2 * before * distance));
}

double SpeedPlanner::start_speed(std::uint64_t index) const {
  const PlannedSegment& segment = ring_[index];
  if (segment.full_stop) return 0;
  const PlannedSegment& before = ring_[index - 1];
  double end = index + 1 < released_ ? ring_[index + 1].reach : 0;
  double speed = std::min({segment.start_limit, soft_limit(segment), soft_limit(before)});
  const double length = segment.path.length();
  const double a = segment.acceleration;
  if (segment.exit_zone > 0) {
    end = std::min(end, segment.exit_limit);
    speed = std::min(speed, braking(length - segment.exit_zone, segment.exit_limit, a, before.acceleration));
  }
  return std::min(speed, braking(length, end, a, before.acceleration));
}

// Speeds at the starts from the last planned segment backwards; what did not change leaves everything before
// it as it was.
void SpeedPlanner::reach_back(std::uint64_t from) {
  for (std::uint64_t i = from; i-- > current_ + 1;) {
    const double reach = start_speed(i);
    if (i + 1 < from && reach == ring_[i].reach) break;
    ring_[i].reach = reach;
  }
}

// The highest speed not above `speed` that keeps every limit from here on.
double SpeedPlanner::feasible(double speed) const {
  double ahead = 0;
  double s = travelled_;
  for (std::uint64_t i = current_;; ++i) {
    const PlannedSegment& segment = ring_[i];
    const double a = segment.acceleration;
    speed = std::min(speed, segment.limit);
    if (s < segment.entry_zone) speed = std::min(speed, segment.entry_limit);
    const double rest = segment.path.length() - s;
    if (segment.exit_zone > 0) {
      const double to_zone = std::max(0.0, rest - segment.exit_zone);
      speed = std::min(speed, approach(ahead + to_zone, segment.exit_limit, a, cycle_));
    }
    ahead += rest;
    const double end = i + 1 < released_ ? ring_[i + 1].reach : 0;
    if (end <= 0 && ahead <= a * cycle_ * cycle_ / 2) return std::min(speed, ahead / cycle_);
    speed = std::min(speed, approach(ahead, end, a, cycle_));
    if (end <= 0 || speed * cycle_ < ahead) return speed;
    s = 0;
  }
}

// The least acceleration of the segments that the coming cycle runs over.
double SpeedPlanner::crossing_acceleration(double distance) const {
  double acceleration = ring_[current_].acceleration;
  double rest = ring_[current_].path.length() - travelled_;
  for (std::uint64_t i = current_ + 1; i < released_ && rest < distance; ++i) {
    acceleration = std::min(acceleration, ring_[i].acceleration);
    rest += ring_[i].path.length();
  }
  return acceleration;
}

void SpeedPlanner::enter(std::uint64_t index) {
  current_ = index;
  entered_ = true;
  travelled_ = 0;
  wait_ = ring_[index].wait_cycles;
}

void SpeedPlanner::advance(double distance) {
  // Rounding must not leave a rest in front of a stop.
  const double whole = 1 - 1e-12;
  while (true) {
    const double rest = ring_[current_].path.length() - travelled_;
    if (distance < rest * whole) {
      travelled_ += distance;
      return;
    }
    distance -= rest;
    travelled_ = ring_[current_].path.length();
    if (current_ + 1 >= released_ || ring_[current_ + 1].reach <= 0) {
      return;
    }
    enter(current_ + 1);
    if (distance <= 0) return;
  }
}

void SpeedPlanner::step(const Overrides& overrides) {
  const double feed = std::clamp(overrides.feed, 0.0, highest_override);
  const double rapid = std::clamp(overrides.rapid, 0.0, 1.0);
  if ((feed > 0 && feed != feed_override_) || (rapid > 0 && rapid != rapid_override_)) {
    if (feed > 0) feed_override_ = feed;
    if (rapid > 0) rapid_override_ = rapid;
    for (std::uint64_t i = released_; i-- > current_ + 1;) ring_[i].reach = start_speed(i);
  }
  if (aborting_ && speed_ <= 0) {
    clear();
    return;
  }
  if (ring_.size() == 0) return;
  if (!entered_ || (travelled_ >= ring_[current_].path.length() && wait_ == 0)) {
    const std::uint64_t next = entered_ ? current_ + 1 : current_;
    // A full ring whose segments are all too short to be planned with what is known becomes a path of its
    // own.
    if (next >= released_ && next < ring_.size() && ring_.size() - current_ >= look_ahead) finish();
    speed_ = 0;
    if (next >= released_) return;
    enter(next);
  }
  const PlannedSegment& segment = ring_[current_];
  const bool hold = overrides.hold || aborting_ || (segment.rapid ? rapid <= 0 : feed <= 0);
  if (wait_ > 0) {
    if (!overrides.hold && !aborting_) --wait_;
    speed_ = 0;
    if (wait_ > 0 || segment.path.length() <= 0) return;
  }
  const double change = segment.acceleration * cycle_;
  const double wanted = hold ? 0 : soft_limit(segment);
  double speed = std::clamp(wanted, std::max(0.0, speed_ - change), speed_ + change);
  if (speed > speed_) speed = std::min(speed, speed_ + crossing_acceleration(speed * cycle_) * cycle_);
  if (speed > 0) speed = feasible(speed);
  speed_ = speed;
  if (speed > 0) advance(speed * cycle_);
}

}  // namespace trunnion::motion
