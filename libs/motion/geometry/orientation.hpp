// SPDX-License-Identifier: Apache-2.0
// Tool direction to rotary angles: in closed form for any two rotary axes, with the choice among the
// solutions.
#pragma once

#include <span>

#include "geometry/axis_pair.hpp"
#include "geometry/chain.hpp"

namespace trunnion::geometry {

/// Travel of a rotary axis in degrees. An axis with eight revolutions or more counts as endless.
struct AngleTravel {
  double negative = -99999, positive = 99999;
  bool endless() const { return positive - negative >= 8 * 360.0; }
};
using AngleTravels = std::array<AngleTravel, angle_count>;

/// Which of the solutions within travel is best. The leading axis is the rotary axis nearest the tool. The
/// time of a solution is that of the axis which takes longest at its `rate`.
enum class SolutionChoice : std::uint8_t {
  shortest,  ///< P0: the least time, of equal times the least sum of the times
  positive,  ///< P1: likewise among the positions of the leading axis from 0 up; one that is endless turns in
             ///< the positive direction or not at all
  negative,  ///< P2: likewise from 0 down, and in the negative direction
  continuous,  ///< the sum of the travels of all rotary axes is least: follows a path of directions
};

struct OrientationRequest {
  /// From the tip to the spindle as the workpiece sees it; any length above zero.
  Vec3 direction = Vec3::UnitZ();
  Angles present{};       ///< present positions of the rotary axes: travels start there, free axes stay there
  AngleTravels travel{};  ///< allowed positions
  SolutionChoice choice = SolutionChoice::shortest;
  /// A direction the machine misses by less than this (degrees) is replaced by the nearest it reaches.
  double tolerance = 1e-7;
  Angles rate{1, 1, 1, 1, 1, 1};  ///< greatest speeds, deg/s, above 0; only their ratios count
};

enum class OrientationStatus : std::uint8_t {
  found,
  not_a_direction,  ///< no length, or a component is infinite or not a number
  unreachable,      ///< no position of the rotary axes has this direction, whatever their travel
  outside_travel,   ///< only beyond the travel of a rotary axis, or against the requested sense of rotation
};

struct Orientation {
  Angles angles{};  ///< all six; those of axes that do not take part are the present ones
  /// 1: an axis turns about as far as the direction does; near 0: an axis turns by up to 1/regularity degrees
  /// for each degree of direction; 0: a pole, where the axis nearest the workpiece keeps its position, or the
  /// border of what the machine reaches. Of a machine with one rotary axis: sine of tool and axis.
  double regularity = 1;
};

struct OrientationAnswer {
  OrientationStatus status = OrientationStatus::unreachable;
  Orientation best;
  Vec3 nearest = Vec3::UnitZ();  ///< when unreachable: unit vector of the nearest reachable direction
};

/// Two axes of a chain with the others at rest; directions in the workpiece frame.
struct MovingPair {
  AxisPair axes;
  std::size_t first = 0, second = 0;  ///< entries of Angles
};

/// Solves tool_direction_in_workpiece(angles) = direction for one chain.
///
/// Two axes solve it; a machine with more of them uses the pair nearest the tool that has a solution within
/// travel and does not move the other axes. Each of at most two solutions is repeated by full turns
/// over the travel; of an endless axis only the position nearest to the present one counts, or the nearest in
/// the requested sense. Equal ranks: the solution with the greater position of the leading axis, then of
/// the others. Directions come out within 1e-12. Pure, allocation-free and safe to use from any thread; a
/// copy is cheap.
class OrientationSolver {
 public:
  explicit OrientationSolver(const Chain& chain);

  /// The best solution. Takes the path every cycle can afford.
  OrientationAnswer best(const OrientationRequest& request) const;

  /// Most solutions all() can list: two, each with up to nine turns of both axes.
  static constexpr std::size_t most_solutions = 2 * 9 * 9;

  /// Every solution, best first, at most out.size(). Returns their number; the status as best().
  std::size_t all(const OrientationRequest& request, std::span<Orientation> out,
                  OrientationAnswer& answer) const;

  /// Axes `i` < `j` counted from the workpiece to the tool; the others are at `present`. Nothing when the
  /// two are parallel or the second turns about the tool itself.
  std::optional<MovingPair> pair(std::size_t i, std::size_t j, const Angles& present) const;
  std::size_t axis_count() const { return count_; }

 private:
  // Solutions modulo full turns of the axes `first` (none: one axis only) and `second`.
  struct Solutions {
    std::array<Orientation, 2> of;
    std::size_t count = 0;
    std::size_t first = angle_count, second = angle_count;
    Vec3 nearest = Vec3::UnitZ();
  };
  static Solutions solve(const MovingPair& pair, const Vec3& u, const OrientationRequest& request);
  Solutions solve_single(std::size_t i, const Vec3& u, const OrientationRequest& request) const;
  Solutions solve_last(const Vec3& u, const OrientationRequest& request) const;
  Vec3 carried(std::size_t end, const Vec3& v, const Angles& at, std::size_t i, std::size_t j) const;
  template <class Visit>
  OrientationAnswer search(const OrientationRequest& request, Visit&& visit) const;

  std::array<OrientingAxis, 6> axes_;
  std::size_t count_ = 0;
  Vec3 tool_ = Vec3::UnitZ();
  // The two axes nearest the tool, seen with those before them at zero: they turn the pair as a whole.
  std::optional<MovingPair> last_pair_;
};

}  // namespace trunnion::geometry
