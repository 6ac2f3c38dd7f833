// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/test_programs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "servo_analysis/axis_trace.hpp"

namespace trunnion::servo_analysis {

double TestedAxis::into_travel(double distance) const {
  distance = std::abs(distance);
  if (high - place >= distance && high - place >= place - low) return distance;
  if (place - low >= distance) return -distance;
  throw std::runtime_error(
      fmt::format("axis {} at {:.3f} {} cannot move by {:.3f}: its travel is {:.3f} .. {:.3f}", letter, place,
                  turns ? "deg" : "mm", distance, low, high));
}

std::string to_and_fro_program(const TestedAxis& axis, double distance, double feed, int strokes) {
  // Incremental: an axis that counts modulo 360 would go to an angle by the shorter way.
  std::string program = "G91\n";
  for (int i = 0; i < strokes + strokes % 2; ++i)
    program += fmt::format("G1 {}{:.6f} F{:.3f}\n", axis.letter, i % 2 == 0 ? distance : -distance, feed);
  return program + "G90\nM30\n";
}

// The acceleration settles in 0.1 s.
std::string stroke_program(const TestedAxis& a, double feed, double time, int strokes) {
  const double v = feed / per_minute;
  const double space = std::max(a.high - a.place, a.place - a.low);
  const double distance = std::min(space, std::max(0.5, v * (time + 0.1) + v * v / a.acceleration));
  return to_and_fro_program(a, a.into_travel(distance), feed, strokes);
}

std::string circle_program(const TestedAxis& first, const TestedAxis& second, double radius, double feed) {
  const double to_centre = first.into_travel(2 * radius) / 2;
  if (second.place - radius < second.low || second.place + radius > second.high)
    throw std::runtime_error(fmt::format("axis {} at {:.3f} mm has no space for a circle of radius {:.3f} mm",
                                         second.letter, second.place, radius));
  const auto centre_word = [](char letter) { return static_cast<char>('I' + (letter - 'X')); };
  const std::string both{std::min(first.letter, second.letter), std::max(first.letter, second.letter)};
  const char* plane = both == "XY" ? "G17" : both == "XZ" ? "G18" : both == "YZ" ? "G19" : nullptr;
  if (plane == nullptr) throw std::runtime_error("a circle needs two of the axes X, Y, Z");
  const auto turn = fmt::format("G3 {}{:.6f} {}0 F{:.3f}\n", centre_word(first.letter), to_centre,
                                centre_word(second.letter), feed);
  return std::string(plane) + "\n" + turn + turn + "G17\nM30\n";
}

// The manual's program without its stops. Incremental, as in to_and_fro_program().
std::string rtcp_program(const RtcpMotion& m) {
  return fmt::format("G90 G94\nG1 {}{:.4f} F{:.3f}\nG4 P500\nG43.4 H{}\n", m.letter, m.start, m.positioning,
                     m.tool) +
         fmt::format("G91 G1 {}{:.4f} F{:.3f}\nG4 P500\nG1 {}{:.4f} F{:.3f}\nG90 G49\nM30\n", m.letter,
                     m.end - m.start, m.feed, m.letter, m.start - m.end, m.positioning);
}

}  // namespace trunnion::servo_analysis
