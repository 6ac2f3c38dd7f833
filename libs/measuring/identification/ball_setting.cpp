// SPDX-License-Identifier: Apache-2.0
#include "identification/ball_setting.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <string_view>

namespace trunnion::identification {
namespace {

using truth::Vec3;

constexpr double positioning_feed = 3000;  // mm/min or deg/min
constexpr double widest_arc = 300;         // deg, of the circle that is computed

Vec3 perpendicular(const Vec3& axis) {
  const Vec3 x = Vec3::UnitX() - axis * axis.x();
  return x.norm() > 0.5 ? Vec3(x.normalized()) : Vec3((Vec3::UnitY() - axis * axis.y()).normalized());
}

std::optional<metrology::AxisError> find_circle(TurnedBall& set, double start) {
  std::vector<metrology::TurnedCentre> places;
  const double range = std::min(std::abs(set.sweep), widest_arc);
  for (int k = 0; k < 7; ++k) places.push_back({start + range * k / 6, place_at(set, start + range * k / 6)});
  const auto fit = metrology::fit_axis(places);
  if (const auto* error = std::get_if<metrology::AxisError>(&fit)) return *error;
  const auto& found = std::get<metrology::AxisFit>(fit);
  set.direction = found.direction, set.centre = found.centre, set.radius = found.radius;
  return std::nullopt;
}

// Index of the letter of a rotary axis in A B C U V W.
std::optional<std::size_t> rotary_index(const servo_analysis::TestedAxis& axis) {
  const auto index = canonical::axis_letters.find(axis.letter);
  if (index > 2 && index < canonical::axis_letters.size()) return index - 3;
  return std::nullopt;
}

bool is_linear(const servo_analysis::TestedAxis& axis) { return axis.letter >= 'X' && axis.letter <= 'Z'; }

// To the ball with the axes as they stand then, tool tip control on.
std::string opening(const TurnedBall& set, const BallProgram& program, double start) {
  const auto angles = angles_at(set, start);
  const Vec3 place = place_at(set, start);
  std::string lines = "G17 G90 G94\nG53 G1";
  for (const auto& a : program.axes)
    if (const auto index = rotary_index(a)) lines += fmt::format(" {}{:.6f}", a.letter, angles[*index]);
  lines += fmt::format(" F{:g}\nG53 G1 X{:.6f} Y{:.6f} Z{:.6f} F{:g}\nG43.4 H{}\nG4 P500\n", positioning_feed,
                       place[0], place[1], place[2], positioning_feed, program.tool);
  return lines;
}

std::string closing(const BallProgram& program) {
  std::string lines = "G4 P500\nG49\nG53 G1";
  for (const auto& a : program.axes)
    if (is_linear(a)) lines += fmt::format(" {}{:.6f}", a.letter, a.place);
  lines += fmt::format(" F{:g}\nG53 G1", positioning_feed);
  for (const auto& a : program.axes)
    if (rotary_index(a)) lines += fmt::format(" {}{:.6f}", a.letter, a.place);
  return lines + fmt::format(" F{:g}\nM30\n", positioning_feed);
}

}  // namespace

geometry::Angles angles_at(const TurnedBall& set, double angle) {
  auto angles = set.held;
  angles[set.axis - 3] = angle;
  return angles;
}

Vec3 place_at(const TurnedBall& set, double angle) {
  return set.model.machine_from_tip(set.ball, angles_at(set, angle), set.tool_length);
}

bool hold_axis(TurnedBall& set, const std::string& word) {
  const auto index = word.empty() ? std::string_view::npos : canonical::axis_letters.find(word[0]);
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(word.substr(std::min<std::size_t>(1, word.size())), &used);
  } catch (const std::exception&) {
  }
  if (index == std::string_view::npos || index < 3 || !set.model.turns(index - 3) || index == set.axis ||
      used == 0 || used + 1 != word.size() || !std::isfinite(value))
    return false;
  set.held[index - 3] = value;
  return true;
}

std::optional<LeftTravel> left_travel(const TurnedBall& set,
                                      const std::array<servo_analysis::TestedAxis, 3>& linear, double start) {
  constexpr int steps = 72;
  for (int k = 0; k <= steps; ++k) {
    const double angle = start + set.sweep * k / steps;
    const Vec3 place = place_at(set, angle);
    for (int i = 0; i < 3; ++i) {
      const auto& axis = linear[static_cast<std::size_t>(i)];
      if (!(place[i] >= axis.low && place[i] <= axis.high)) return LeftTravel{axis, place[i], angle};
    }
  }
  return std::nullopt;
}

std::optional<metrology::AxisError> place_ball(TurnedBall& set, const WantedBall& wanted, double start,
                                               const Vec3& here) {
  const auto& design = set.machine.design;
  Vec3 point = Vec3::Zero();
  std::optional<Vec3> direction;
  // The points of the axes of a table, from the workpiece outwards: v2, v2 + v1, v2 + v1 + v0.
  for (const auto* table : {&design.table_2, &design.table_1, &design.table_0}) {
    if (!*table || direction) continue;
    point += (*table)->offset + (*table)->correction;
    if ((*table)->angle == set.axis - 3) direction = (*table)->direction.normalized();
  }
  if (wanted.place) {
    set.ball = *wanted.place;
  } else if (direction) {
    // Beside an axis along the tool, above an axis across it.
    const Vec3 tool = set.model.tool_direction(), across = tool - *direction * direction->dot(tool);
    set.ball = across.norm() > 0.5
                   ? Vec3(point + across.normalized() * wanted.radius)
                   : Vec3(point + perpendicular(*direction) * wanted.radius + tool * wanted.height);
  } else {
    set.ball = set.model.tip_from_machine(here, angles_at(set, start), set.tool_length);
  }
  return find_circle(set, start);
}

// Incremental: a table that counts modulo 360 would not turn for its own angle.
std::string ball_turn_program(const TurnedBall& set, const BallProgram& program, double start, double feed) {
  const char letter = canonical::axis_letters[set.axis];
  return opening(set, program, start) +
         fmt::format("G91 G1 {}{:.6f} F{:.6f}\nG4 P500\nG1 {}{:.6f}\nG90\n", letter, set.sweep, feed, letter,
                     -set.sweep) +
         closing(program);
}

std::string ball_stops_program(const TurnedBall& set, const BallProgram& program, double start,
                               std::size_t stops) {
  const char letter = canonical::axis_letters[set.axis];
  auto lines = opening(set, program, start) + "G91\n";
  for (std::size_t k = 0; k < stops; ++k)
    lines += fmt::format("G1 {}{:.6f} F{:g}\nG4 P400\n", letter,
                         k == 0 ? 0.0 : set.sweep / static_cast<double>(stops), positioning_feed);
  return lines + "G90\n" + closing(program);
}

}  // namespace trunnion::identification
