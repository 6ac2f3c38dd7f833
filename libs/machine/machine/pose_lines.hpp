// SPDX-License-Identifier: Apache-2.0
// Lines of numbers through the kinematics of a machine: what `trunnion kins` does with its standard input.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/orientation.hpp"
#include "machine/parameters.hpp"

namespace trunnion::machine {

/// Rotary positions are in the order of the parameters: those of the head from the machine's base to the
/// tool, then those of the table from the base to the workpiece (AC table: A C; CB head: C B; B head with C
/// table: B C). A position with the letter of its axis in front ("B30") may be at any place among them.
class PoseLines {
 public:
  enum class Direction { inverse, forward, orient };

  /// Throws KinematicsError.
  PoseLines(const Parameters& parameters, std::uint16_t channel, double tool_length);

  struct Answer {
    std::string text;     ///< numbers with 12 decimals, separated by single spaces, or `none`
    std::string warning;  ///< empty, or one line
  };

  /// inverse: `x y z r1 r2` (tip in the workpiece frame) -> `X Y Z`; forward: `X Y Z r1 r2` -> `x y z i j k`;
  /// orient: `i j k` -> every `r1 r2` within travel, best first counted from all axes at zero, or `none`. Of
  /// a machine with another number of rotary axes there are as many r. Throws std::runtime_error.
  Answer answer(Direction direction, const std::string& line) const;

  /// Letters of the rotary axes in the order of r1, r2.
  std::string letters() const;

 private:
  std::vector<double> numbers(const std::string& line, std::size_t fixed, std::size_t rotary,
                              geometry::Angles& angles) const;
  Answer orient(const std::string& line) const;

  geometry::Chain chain_;
  geometry::OrientationSolver solver_;
  geometry::AngleTravels travels_;
  std::vector<std::size_t> order_;  // entries of Angles
  double tool_length_;
};

}  // namespace trunnion::machine
