// SPDX-License-Identifier: Apache-2.0
// The geometry stage: programmed segments joined into a curve that axes can follow.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "motion/path_segment.hpp"

namespace trunnion::motion {

/// The permitted deviations at a join.
struct BlendRules {
  double contour_tolerance = 0.01;      ///< mm; 0: exact
  double orientation_tolerance = 0.05;  ///< degrees of the rotary axes together
  bool operator==(const BlendRules&) const = default;
};

/// Size of a change by the tolerances, linear and rotary axes apart: the larger share.
double weigh(const AxisValues& change, const BlendRules& rules);

/// One programmed segment, or a piece of one, and the join at its start. Lengths are in the unit of its
/// PathSegment.
struct PathBlock {
  PathSegment path;
  BlendRules rules;        ///< of the join at the start; others follow only behind a stop
  std::uint8_t mode = 0;   ///< machining mode
  double at = 0;           ///< path coordinate of the start
  AxisValues turn{};       ///< jump of the first derivative at the start
  AxisValues bend{};       ///< jump of the second
  double weight = 0;       ///< size of turn by the tolerances: a reach of 6 / weight uses the tolerance up
  double bend_weight = 0;  ///< size of bend by the tolerances
  double widest = 0;       ///< reach the tolerance would allow here alone
  double reach = 0;        ///< half length of the rounding
  double strayed = 0;      ///< share of the tolerance by which a curve may leave the programmed lines
  bool smooth = false;     ///< continues the curve of the block before: there is no join
  bool stop = true;        ///< motion stops at the start: no rounding across it
  bool overlap = false;    ///< the stop may be rounded in time instead
  int wait_cycles = 0;     ///< standstill before the segment starts
  bool position_check = false;  ///< the standstill ends as soon as the axes are in position
  std::uint32_t line = 0, sequence = 0;
  double fraction_offset = 0;  ///< part of the command that lay before this segment, 0..1
  double fraction_end = 1;     ///< and that is done at its end
  double line_length = 0;      ///< of the line a curve's piece is of; 0: the segment is whole
  bool rapid = false;
  double feed = 0;  ///< programmed speed at override 1, unit/s

  double end() const { return at + path.length(); }
  /// Direction or curvature jump at the start.
  bool is_join() const { return weight > 0 || bend_weight > 0; }
  /// Length of the programmed move.
  double move_length() const { return line_length > 0 ? line_length : path.length(); }
};

/// A ring of blocks with their joins. Blocks are pushed, get their reach as soon as enough of the path behind
/// them is known, and stay readable for a while after they have been executed.
class BlendedPath {
 public:
  static constexpr std::uint64_t capacity = 16384;
  /// No join reaches farther than this, mm or degrees, or over more than this number of joins.
  static constexpr double longest_reach = 5;
  static constexpr int most_joins = 24;

  BlendedPath() : blocks_(capacity) {}

  void clear();

  /// Appends a block that begins where the last one ended, within rounding. The caller has decided on `stop`.
  void push(PathBlock block);

  /// Size of a join by the tolerances, to decide whether it is a stop.
  void rate_join(PathBlock& block) const;

  /// Works out the reach of joins that are known well enough, all of them when the path `ends`. Over
  /// `smooth_ahead` mm behind the last block there will be no join.
  void update(bool ends, double smooth_ahead = 0);

  std::uint64_t size() const { return pushed_; }
  std::uint64_t oldest() const { return pushed_ > capacity ? pushed_ - capacity : 0; }
  const PathBlock& operator[](std::uint64_t index) const { return blocks_[index % capacity]; }
  PathBlock& operator[](std::uint64_t index) { return blocks_[index % capacity]; }
  double end() const { return pushed_ == 0 ? 0 : (*this)[pushed_ - 1].end(); }

  /// Blocks up to this number will not change any more.
  std::uint64_t settled_blocks() const { return settled_blocks_; }

  /// Position at the path coordinate s on block `index` (which contains it).
  AxisValues position(std::uint64_t index, double s) const;

  /// First to third derivative at s, taken from the side of the path where `inside` lies, a coordinate on the
  /// same section between two ends of roundings.
  std::array<AxisValues, 3> derivatives(std::uint64_t index, double s, double inside) const;

  /// Shortest reach of the jumps of curvature that are rounded at s, 0: there is none. With one the curve is
  /// no polynomial of the third degree.
  double bend_reach(std::uint64_t index, double s) const;

  /// The next place behind `s` on block `index` where a rounding begins, turns or ends; at most the block's
  /// end.
  double next_knot(std::uint64_t index, double s) const;

 private:
  template <typename Visit>
  void for_joins(std::uint64_t index, double s, Visit visit) const;
  double usage(std::uint64_t index, double reach) const;
  double strayed_at(std::uint64_t index) const;
  bool needs_reach(std::uint64_t index) const;
  double widest_reach(std::uint64_t index) const;
  double final_reach(std::uint64_t index) const;

  std::vector<PathBlock> blocks_;
  std::uint64_t pushed_ = 0;
  std::uint64_t rated_ = 0;    // joins before this one have `widest`
  std::uint64_t reached_ = 0;  // joins before this one have `reach`
  std::uint64_t settled_blocks_ = 0;
  double last_widest_ = 1;
};

}  // namespace trunnion::motion
