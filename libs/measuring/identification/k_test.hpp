// SPDX-License-Identifier: Apache-2.0
// The kinematic tests K1 and K2 of ISO 10791-6: a ball that the control holds while one rotary axis turns.
#pragma once

#include <optional>
#include <vector>

#include "circular_tests/ball_signal.hpp"
#include "identification/turned_ball.hpp"

namespace trunnion::identification {

enum class KTest {
  k1,  ///< the axis that swivels the tool or the table
  k2   ///< the axis that turns about the tool's direction
};

/// Its letter; nothing when the machine has no rotary axis for the test.
std::optional<char> axis_of_test(const geometry::Chain& model, KTest test);

/// A: two rotary axes in the head, B: two in the table, C: one in each.
char annex_of(const machine::MachineOutline& machine);

/// What the sensors have read in one sense of the axis.
struct SenseFigures {
  bool positive = true;
  std::vector<double> angles;              ///< deg of the axis since the start of the turn, by sample
  std::vector<truth::Vec3> deviations;     ///< mm, along X Y Z
  truth::Vec3 span = truth::Vec3::Zero();  ///< mm: largest less least
  circular_tests::DirectionRanges range;
};
SenseFigures figures_of(const TurnedBall& set, const BallTurn& turn);

}  // namespace trunnion::identification
