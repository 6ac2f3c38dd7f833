// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/circle_program.hpp"

#include <fmt/core.h>

#include "circular_tests/turns.hpp"
#include "geometry/angle.hpp"

namespace trunnion::circular_tests {
namespace {

constexpr double positioning_feed = 6000;  // mm/min

}  // namespace

CirclePlane plane_of(const std::string& name) {
  return {static_cast<std::size_t>(name[0] - 'X'), static_cast<std::size_t>(name[1] - 'X')};
}

std::string circle_program(const CircleMotion& m, const std::vector<std::pair<char, double>>& after) {
  const auto plane = plane_of(m.plane);
  const char first = m.plane[0], second = m.plane[1];
  const auto word = [](char letter) { return static_cast<char>('I' + (letter - 'X')); };
  const auto point = [&](double angle) {
    const auto [s, c] = geometry::sine_cosine(angle);
    return PlanePoint{m.radius * c, m.radius * s};
  };
  const double x = m.centre[static_cast<Eigen::Index>(plane.first)],
               y = m.centre[static_cast<Eigen::Index>(plane.second)];
  const auto to_centre =
      fmt::format("G53 G1 {}{:.6f} {}{:.6f} F{:g}\n", first, x, second, y, positioning_feed);
  std::string program = m.plane == "XY" ? "G17" : m.plane == "XZ" ? "G18" : "G19";
  program += " G90 G94\n";
  program += fmt::format("G53 G1 X{:.6f} Y{:.6f} Z{:.6f} F{:g}\n", m.centre[0], m.centre[1], m.centre[2],
                         positioning_feed);
  for (const int sense : {1, -1}) {
    const double from = m.start - sense * m.overrun, to = m.start + sense * m.overrun;
    const auto begin = point(from), end = point(to);
    // G18 has its plane from Z to X, which is the other sense.
    const char* arc = (sense > 0) == (m.plane != "XZ") ? "G3" : "G2";
    program += fmt::format("G53 G1 {}{:.6f} {}{:.6f} F{:.3f}\n", first, x + begin.first, second,
                           y + begin.second, m.feed);
    const auto to_middle =
        fmt::format("{}{:.6f} {}{:.6f}", word(first), -begin.first, word(second), -begin.second);
    program += fmt::format("{} {} F{:.3f}\n", arc, to_middle, m.feed);
    if (m.overrun > 0)
      program += fmt::format("G91 {} {}{:.6f} {}{:.6f} {}\nG90\n", arc, first, end.first - begin.first,
                             second, end.second - begin.second, to_middle);
    program += to_centre;
  }
  for (const auto& [letter, place] : after)
    program += fmt::format("G53 G1 {}{:.6f} F{:g}\n", letter, place, positioning_feed);
  return program + "G17\nM30\n";
}

}  // namespace trunnion::circular_tests
