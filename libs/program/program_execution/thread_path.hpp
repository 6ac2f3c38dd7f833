// SPDX-License-Identifier: Apache-2.0
// The way of a thread (G33, G34) as a function of the spindle's angle. Between run-in and run-out the tool is
// on the pitch line: the line that goes through the start point at the start angle, whatever the spindle's
// speed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "language/canonical.hpp"
#include "motion/limits.hpp"

namespace trunnion::program_execution {

using language::AxisValues;

/// One command of kind thread.
struct ThreadLeg {
  AxisValues target{};
  double lead = 1;         ///< mm per revolution at its start, of the axis that goes farthest
  double lead_change = 0;  ///< mm per revolution in each revolution
  double start_angle = 0;  ///< degrees behind the index mark; that of the first leg holds for all
  std::uint32_t program = 0, sequence = 0, line = 0;  ///< of its command
};

ThreadLeg leg_of(const language::Command& thread);

/// A thread as a line that is not coupled to the spindle: at the mean lead times S.
language::Command thread_line(language::Command thread, const AxisValues& from);

/// Where the tool is in a thread.
struct ThreadPlace {
  AxisValues position{};
  AxisValues velocity{};  ///< mm per revolution in the spindle's direction
  std::size_t leg = 0;
  double fraction = 0;  ///< of the leg's revolutions that are done; 1 only at rest at the end of the thread
};

/// Where the velocity has to change, at the start, at the end and between two legs, it changes smoothly over
/// the same angle before and behind the place, and the tool is on the pitch line behind that. So the run-in
/// begins before the spindle is at the start angle, and the run-out ends behind the angle of the end. Angles
/// are in revolutions, clockwise positive, turns counted, from an index mark at whole revolutions.
class ThreadPath {
 public:
  static constexpr std::size_t most_legs = 64;
  /// Axes keep to their acceleration and jerk up to this times S: to the highest override, 1.5, and what the
  /// spindle may be too fast.
  static constexpr double speed_margin = 1.6;

  enum class Fault : std::uint8_t {
    none,
    too_short,     ///< a leg has no room for what happens at its ends
    acceleration,  ///< the lead changes faster than an axis can
  };

  /// From rest at `start` over `legs`, one at least, to rest at the last target. `speed` in 1/min, above 0.
  /// The origin is then 0.
  Fault build(const AxisValues& start, std::span<const ThreadLeg> legs, double speed, bool clockwise,
              const motion::Limits& limits);
  /// Of the last build(), when it has a fault.
  std::size_t faulty_leg() const { return faulty_leg_; }
  /// Up to this times S, at most the margin, every axis keeps to its velocity, too.
  double highest_share() const { return highest_share_; }
  /// The angle at which the pitch line goes through the start point.
  void set_origin(double angle) { origin_ = angle; }
  double origin() const { return origin_; }
  /// The first origin whose run-in begins `ahead` revolutions or more behind `angle`.
  double first_origin(double angle, double ahead) const;

  ThreadPlace at(double angle) const;
  bool done(double angle) const { return turned(angle) >= nodes_.back().place + nodes_.back().half; }
  /// It rests at its start.
  bool waits(double angle) const { return turned(angle) <= -nodes_.front().half; }
  /// Ends it as soon as it can be left on the pitch line and without going beyond the end of a leg.
  void brake_from(double angle);

  /// Travel before the tool is on the pitch line, and behind where it leaves it, mm of the axis that goes
  /// farthest.
  double length_of_run_in() const;
  double length_of_run_out() const;
  const AxisValues& start() const { return pieces_.front().start; }
  /// Where it ends.
  const AxisValues& end() const { return end_; }
  const ThreadLeg& leg(std::size_t index) const { return pieces_[index].leg; }

 private:
  /// The pitch line of a leg: start + direction * (lead t + lead_change t^2 / 2), t revolutions from `begin`.
  struct Piece {
    ThreadLeg leg;
    AxisValues start{}, direction{};
    double begin = 0, revolutions = 0;
    double distance(double turned) const {
      const double t = turned - begin;
      return t * (leg.lead + leg.lead_change / 2 * t);
    }
    double lead(double turned) const { return leg.lead + leg.lead_change * (turned - begin); }
  };
  /// Within `half` revolutions of `place` the velocity changes by `step` + `slope` t, t from `place`.
  struct Node {
    double place = 0, half = 0;
    AxisValues step{}, slope{};
  };

  double turned(double angle) const { return clockwise_ ? angle - origin_ : origin_ - angle; }
  /// Its half length, or below 0 when the lead changes faster than an axis can.
  double half_of(const Node& node, const Piece* before, const Piece* behind) const;
  Node node_between(const Piece* before, const Piece* behind, double place) const;

  std::vector<Piece> pieces_;
  std::vector<Node> nodes_;  // one more than pieces
  AxisValues end_{};
  AxisValues acceleration_{}, jerk_{};  // mm per revolution^2 and ^3
  double origin_ = 0, highest_share_ = speed_margin;
  std::size_t faulty_leg_ = 0;
  bool clockwise_ = true;
  bool whole_ = true;  // it was not braked
};

}  // namespace trunnion::program_execution
