// SPDX-License-Identifier: Apache-2.0
// Rotary angles along a great circle of tool directions (vector interpolation, G43.5).
#pragma once

#include <variant>

#include "geometry/direction_arc.hpp"
#include "geometry/orientation.hpp"

namespace trunnion::geometry {

struct DirectionPathRequest {
  Vec3 from = Vec3::UnitZ(), to = Vec3::UnitZ();  ///< tip to spindle, seen from the workpiece; any length
  Angles present{};                               ///< positions of the rotary axes before the path
  AngleTravels travel{};
  double tolerance = 0.05;   ///< degrees the direction may leave the great circle near a pole (04c902)
  bool avoid_poles = false;  ///< 04c100 = 1: a path closer to a pole than pole_range is a fault
  double pole_range = 1;     ///< degrees (04c950)
};

struct DirectionPathFault {
  enum Kind : std::uint8_t {
    not_a_direction,  ///< no length, or not finite
    opposite,         ///< the directions are opposite: no shortest path exists
    unreachable,      ///< the machine does not reach the direction at `s`
    outside_travel,   ///< a rotary axis is beyond its travel at `s`, within a degree of where it leaves
    pole,             ///< the path comes too close to a pole at `s`
  };
  Kind kind = not_a_direction;
  double s = 0;                  ///< 0 .. 1
  Vec3 nearest = Vec3::UnitZ();  ///< of unreachable: the nearest direction in reach
};

/// The angles are a closed function of s in 0 .. 1, so any part of the path can be evaluated in any order.
///
/// Away from poles the direction is on the great circle at an even rate, exactly. Where the great circle
/// passes a pole closer than the tolerance, the rotary axes run smoothly (rates and accelerations are
/// continuous) from one side of the pole to the other, which keeps the axis nearest the workpiece slow and
/// the direction within the tolerance; the tool tip is not touched by this. Farther from a pole that axis
/// turns by up to 1 / sin(distance) degrees for each degree of direction: derivatives() gives this in
/// advance. Of more than two rotary axes the pair nearest the tool that can follow the path moves. Pure,
/// allocation-free and safe to use from any thread.
class DirectionPath {
 public:
  static std::variant<DirectionPath, DirectionPathFault> make(const OrientationSolver& solver,
                                                              const DirectionPathRequest& request);

  /// All six angles at s in 0 .. 1; those of axes that take no part are the present ones.
  Angles angles(double s) const;

  /// The angles and their first three derivatives by s.
  std::array<Angles, 4> derivatives(double s) const;

  /// Angles at s = 0. They differ from the present ones where the tool is at a pole, so that an axis must
  /// turn before the direction can follow the path, or where the axes must change to the other solution.
  Angles start() const { return angles(0); }

  /// The number of equal pieces of s, a power of two up to `most`, in which the axes may move in proportion
  /// so that the direction stays within `deviation` (degrees) of this path.
  std::uint32_t pieces(const Chain& chain, double deviation, std::uint32_t most) const;

  const DirectionArc& arc() const { return arc_; }
  /// Sections that pass a pole.
  std::size_t windows() const;

 private:
  using Two = std::array<double, 2>;
  // On the great circle, or in a window around a pole by polynomials of degree five in (s - begin) / (end -
  // begin).
  struct Piece {
    double begin = 0, end = 1;
    bool window = false;
    double side = 1;   // of the triangle of the axes
    double first = 0;  // position of axis 1 at the beginning, degrees
    double turn = 0;   // full turns of axis 2, degrees
    std::array<std::array<double, 6>, 2> polynomial{};
  };

  DirectionPath(const DirectionArc& arc, const Angles& present) : arc_(arc), present_(present) {}
  std::optional<DirectionPathFault> keep_direction(const OrientationSolver& solver,
                                                   const DirectionPathRequest& request);
  std::optional<DirectionPathFault> turn_one(const OrientationSolver& solver,
                                             const DirectionPathRequest& request);
  std::optional<DirectionPathFault> turn_two(const MovingPair& pair, const DirectionPathRequest& request);
  std::optional<DirectionPathFault> check_directions(const DirectionPathRequest& request) const;
  bool start_at(double side, const DirectionPathRequest& request, Piece& piece) const;
  void build(const Piece& start, const DirectionPathRequest& request);
  bool add_window(double begin, double end, double tolerance);
  std::optional<double> outside(const DirectionPathRequest& request) const;
  double foot(double sign) const;
  bool has_pole(double sign, double tolerance) const;
  Vec3 across(double s) const;
  Vec3 around(const AxisPair::Triangle& triangle, double side) const;
  Two on_arc(const Piece& piece, double s) const;
  std::array<Two, 4> rates(const Piece& piece, double s) const;
  Two positions(const Piece& piece, double s) const;
  const Piece& piece_at(double s) const;
  Angles with(const Two& positions) const;

  DirectionArc arc_;
  Angles present_{};
  MovingPair pair_{AxisPair{}, angle_count, angle_count};
  std::array<Piece, 5> pieces_;
  std::size_t count_ = 0;  // 0: nothing moves
};

}  // namespace trunnion::geometry
