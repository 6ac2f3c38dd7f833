// SPDX-License-Identifier: Apache-2.0
// Where a ball is set to turn a rotary axis with it, and the programs that turn it under tool tip control.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "identification/turned_ball.hpp"
#include "metrology/axis_of_rotation.hpp"
#include "servo_analysis/test_programs.hpp"

namespace trunnion::identification {

/// The angles of the rotary axes when that of the test is at `angle`, deg.
geometry::Angles angles_at(const TurnedBall& set, double angle);
/// mm: X Y Z that puts the tip into the ball when the axis is at `angle`.
truth::Vec3 place_at(const TurnedBall& set, double angle);

/// `word`, as A-30: another rotary axis than that of the test stands at this angle, deg. False when it does
/// not say that.
bool hold_axis(TurnedBall& set, const std::string& word);

struct WantedBall {
  std::optional<truth::Vec3> place;     ///< mm, workpiece frame
  double radius = 72.411, height = 50;  ///< mm: about an axis of a table and along it, without `place`
};

/// Sets the ball and its circle. A table's axis carries the ball about it: the ball is at the radius asked
/// for. A head turns about its own axis, and its length is the radius: the ball is at the tip when the linear
/// axes are at `here` and the axis is at `start`. Says why when the ball has no circle about the axis.
std::optional<metrology::AxisError> place_ball(TurnedBall& set, const WantedBall& wanted, double start,
                                               const truth::Vec3& here);

/// A linear axis that leaves its travel.
struct LeftTravel {
  servo_analysis::TestedAxis axis;
  double place = 0;  ///< mm, outside of the travel
  double angle = 0;  ///< deg of the axis of the test
};
/// The first of X, Y, Z that does while the axis turns from `start` deg by the sweep; nothing when none does.
std::optional<LeftTravel> left_travel(const TurnedBall& set,
                                      const std::array<servo_analysis::TestedAxis, 3>& linear, double start);

/// Where the axes of the channel are before and after, and the tool whose tip is the ball's centre.
struct BallProgram {
  std::vector<servo_analysis::TestedAxis> axes;
  std::uint32_t tool = 1;
};
/// From `start` deg by the sweep and back with `feed` deg/min, between rests.
std::string ball_turn_program(const TurnedBall& set, const BallProgram& program, double start, double feed);
/// `stops` stops at equal angles of the sweep from `start` deg.
std::string ball_stops_program(const TurnedBall& set, const BallProgram& program, double start,
                               std::size_t stops);

}  // namespace trunnion::identification
