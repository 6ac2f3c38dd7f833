// A segment with everything the speed stage knows about it, and the ring that holds them.
#pragma once

#include <cstdint>
#include <vector>

#include "motion/axis_rates.hpp"
#include "motion/path_segment.hpp"

namespace trunnion::motion {

/// Speeds are along the path of the segment: mm/s, or deg/s for purely rotary segments. "Start" is its
/// junction with the segment before it.
struct PlannedSegment {
  PathSegment path;
  AxisRates rates;
  std::uint32_t line = 0, sequence = 0;
  double fraction_offset = 0;  ///< part of the command that lay before this segment, 0..1
  bool rapid = false;
  double feed = 0;                         ///< programmed speed at override 1
  double limit = 0;                        ///< never exceeded, whatever the override
  double acceleration = 0;                 ///< tangential
  double at = 0;                           ///< path coordinate of the start
  bool full_stop = false;                  ///< the axes stand and the smoothing is flushed at the start
  int wait_cycles = 0;                     ///< standstill before the segment starts
  double turn = 0;                         ///< change of direction at the start by the tolerance, 1/length
  double bend = 0;                         ///< curvature by the tolerance, 1/length^2
  double start_limit = 0;                  ///< highest speed at the start
  double entry_zone = 0, entry_limit = 0;  ///< slower part behind the start: length, speed
  double exit_zone = 0, exit_limit = 0;    ///< slower part before the end
  double reach = 0;  ///< speed at the start from which everything known ahead is feasible

  double end() const { return at + path.length(); }
};

/// Ring of planned segments addressed by a counter that never wraps; entries stay readable after execution
/// because windows of the smoothing look back.
class SegmentRing {
 public:
  static constexpr std::uint64_t capacity = 4096;

  SegmentRing() : storage_(capacity) {}
  PlannedSegment& operator[](std::uint64_t index) { return storage_[index % capacity]; }
  const PlannedSegment& operator[](std::uint64_t index) const { return storage_[index % capacity]; }
  std::uint64_t size() const { return pushed_; }
  std::uint64_t oldest() const { return pushed_ > capacity ? pushed_ - capacity : 0; }
  void clear() { pushed_ = 0; }
  PlannedSegment& append() {
    PlannedSegment& entry = (*this)[pushed_++];
    entry = PlannedSegment{};
    return entry;
  }

 private:
  std::vector<PlannedSegment> storage_;
  std::uint64_t pushed_ = 0;
};

}  // namespace trunnion::motion
