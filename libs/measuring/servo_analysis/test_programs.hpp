// SPDX-License-Identifier: Apache-2.0
// What the servo tests move: axes with their travel, and the programs of the motions.
#pragma once

#include <cstdint>
#include <string>

namespace trunnion::servo_analysis {

/// An axis of a channel as it stands before a test.
struct TestedAxis {
  char letter = 0;
  std::uint16_t number = 0;  ///< logical
  bool turns = false;
  double place = 0;          ///< machine coordinate, mm or deg
  double low = 0, high = 0;  ///< travel
  double highest_feed = 0;   ///< mm/min or deg/min
  double acceleration = 0;   ///< mm/s2 or deg/s2

  /// `distance` signed: towards the farther end of the travel. Throws std::runtime_error when there is not
  /// enough.
  double into_travel(double distance) const;
  std::string length_unit() const { return turns ? "deg" : "mm"; }
  std::string speed_unit() const { return turns ? "deg/min" : "mm/min"; }
};

/// `strokes` strokes to and fro from the place of the axis; with an odd number one more, back.
std::string to_and_fro_program(const TestedAxis& axis, double distance, double feed, int strokes);
/// To and fro with `time` s at constant speed where the travel permits.
std::string stroke_program(const TestedAxis& axis, double feed, double time, int strokes = 2);
/// A circle of both axes from the place of the first one, which reverses there: two turns. Throws
/// std::runtime_error when there is no space, or the axes are not two of X, Y, Z.
std::string circle_program(const TestedAxis& first, const TestedAxis& second, double radius, double feed);

/// A rotary axis turns under tool tip control and comes back.
struct RtcpMotion {
  char letter = 'C';
  double start = 0, end = 360;             ///< deg
  double feed = 1000, positioning = 3000;  ///< deg/min
  std::uint32_t tool = 1;                  ///< H
};
std::string rtcp_program(const RtcpMotion& motion);

}  // namespace trunnion::servo_analysis
