// SPDX-License-Identifier: Apache-2.0
#include "calibration/measuring_program.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "geometry/angle.hpp"

namespace trunnion::calibration {
namespace {

constexpr std::uint32_t first_variable = 52150, serial_variable = 52999;
using canonical::axis_letters;
constexpr double longest_turn = 150;          // deg, in one line; half a turn has no shorter way
constexpr double arc_step = 10;               // deg: an arc around the sphere is a polygon
constexpr double second_retract = 1;          // mm, between first and second touch
constexpr double largest_inverse_time = 1e6;  // 1/min: a way of the last digits only

class Writer {
 public:
  Writer(const MeasurementInputs& in, const MeasuredMachine& machine) : in_(in) {
    for (std::size_t i = 0; i < machine.outline.axes.size(); ++i)
      present_[i] = machine.outline.axes[i].present, ways_[i] = machine.outline.axes[i].way;
    for (const auto& vector : metrology::root_vectors(machine.model)) present_[3 + vector.angle] = true;
  }

  void begin(const std::string& title, const Way& way) {
    text_ += "(" + title + ")\n";
    text_ += fmt::format("#{}=0\n", serial_variable);
    text_ += "G21 G17 G90 G94 G40 G80 G49 G54 G61\n";
    text_ += fmt::format("M{}\n", in_.probe_on);
    // By their time: F of a way that moves and turns would count millimetres and degrees together.
    if (way.size() > 1) text_ += "G93\n";
    for (std::size_t i = 1; i < way.size(); ++i) go(way[i - 1], way[i]);
    if (way.size() > 1) text_ += "G94\n";
  }
  std::string end(const ProgramEnd& end) {
    text_ += fmt::format("#{}={}\n", serial_variable, end.serial);
    text_ += fmt::format("M{}\n{}\n", in_.probe_off, end.code == EndsWith::m30 ? "M30" : "M99");
    return std::move(text_);
  }

  // Straight to X, Y, Z.
  void go(const Vec3& linear, double feed) {
    text_ +=
        fmt::format("G53 G1 X{:.6f} Y{:.6f} Z{:.6f} F{:.3f}\n", linear.x(), linear.y(), linear.z(), feed);
  }
  // min, with the linear axes at the positioning feed or the fastest rotary axis at its own.
  double duration(const AxisPosition& from, const AxisPosition& to) const {
    double turned = 0;
    for (std::size_t i = 3; i < to.size(); ++i) turned = std::max(turned, std::abs(to[i] - from[i]));
    const double moved = Vec3(to[0] - from[0], to[1] - from[1], to[2] - from[2]).norm();
    return std::max(moved / in_.positioning_feed, turned / in_.rotary_feed);
  }
  // In one sense: in parts where an axis that counts modulo 360 would take the shorter way.
  void go(const AxisPosition& from, const AxisPosition& to) {
    const double minutes = duration(from, to);
    if (minutes == 0) return;
    double parts = 1;
    for (std::size_t i = 0; i < to.size(); ++i)
      if (ways_[i] != canonical::RotaryWay::linear)
        parts = std::max(parts, std::ceil(std::abs(to[i] - from[i]) / longest_turn));
    auto last = from;
    for (double part = 1; part <= parts; ++part) {
      auto next = to;
      if (part < parts)
        for (std::size_t i = 0; i < to.size(); ++i) next[i] = from[i] + part / parts * (to[i] - from[i]);
      text_ += "G53 G1";
      for (std::size_t i = 0; i < next.size(); ++i)
        if (present_[i])
          text_ +=
              fmt::format(" {}{:.6f}", axis_letters[i], canonical::rotary_word(ways_[i], next[i], last[i]));
      text_ += fmt::format(" F{:.6f}\n", std::min(parts / minutes, largest_inverse_time));
      last = next;
    }
  }

  // From the end of the measuring path against `direction`; the result is touch `number`.
  void touch(const Vec3& direction, std::size_t number) {
    text_ +=
        fmt::format("G65 P9801 X{:.9f} Y{:.9f} Z{:.9f} D{:.6f} J{:.3f} K{:.3f} R{:.6f}\n", -direction.x(),
                    -direction.y(), -direction.z(), standoff(in_) + in_.measuring_path, in_.first_touch_feed,
                    in_.measuring_feed, std::min(second_retract, in_.measuring_path / 2));
    for (unsigned i = 0; i < 3; ++i)
      text_ += fmt::format("#{}=#{}-#{}+#{}\n", first_variable + 3 * static_cast<unsigned>(number) + i,
                           141 + i, 5041 + i, 5021 + i);
  }

 private:
  const MeasurementInputs& in_;
  std::array<bool, 9> present_{};
  std::array<canonical::RotaryWay, 9> ways_{};
  std::string text_;
};

double outer_radius(const MeasurementInputs& in) {
  return (in.sphere_diameter + in.ball_diameter) / 2 + standoff(in);
}

// The arc about `tool` from one direction to the next, both across it, without its ends; empty where the
// ball would pass the shaft, or the directions are those of a half turn or more.
std::vector<Vec3> arc_between(const Vec3& from, const Vec3& to, const Vec3& tool,
                              const std::optional<Vec3>& shaft, const MeasurementInputs& in) {
  const double angle =
      geometry::arc_tangent(tool.dot(from.cross(to)), from.dot(to)) / geometry::radians_per_degree;
  if (angle <= 0) return {};
  const auto steps = static_cast<int>(std::ceil(angle / arc_step));
  const double clear_of_shaft = std::max(1.0, in.confidence_range);  // mm
  std::vector<Vec3> points;
  for (int i = 1; i < steps; ++i) {
    const auto t = geometry::sine_cosine(angle * i / steps);
    points.emplace_back(t.cosine * from + t.sine * tool.cross(from));
  }
  if (shaft)
    for (const auto& point : points) {
      const double away = point.dot(*shaft) > 0 ? point.cross(*shaft).norm() : 1;
      if (outer_radius(in) * away - (in.ball_diameter + in.shaft_diameter) / 2 < clear_of_shaft) return {};
    }
  return points;
}

// The shaft of the sphere in machine coordinates at the pose.
std::optional<Vec3> shaft_at(const MeasurementInputs& in, const MeasuredMachine& machine,
                             const Angles& angles) {
  if (!in.shaft) return std::nullopt;
  const auto chain = std::get<geometry::Chain>(geometry::Chain::make(machine.model));
  return Vec3(chain.jacobian(in.sphere, angles, in.probe_length).tip * *in.shaft).normalized();
}

}  // namespace

AxisPosition approach_position(const MeasurementInputs& in, const PlannedPose& pose, const Vec3& centre) {
  const Vec3 above = centre + outer_radius(in) * pose.directions.back();
  AxisPosition position{above.x(), above.y(), above.z()};
  std::copy(pose.angles.begin(), pose.angles.end(), position.begin() + 3);
  return position;
}

Way retract_way(const AxisPosition& from, const AxisPosition& to, double top) {
  Way way{from};
  const auto add = [&](std::size_t first, std::size_t last, const AxisPosition& target) {
    auto next = way.back();
    std::copy(target.begin() + static_cast<std::ptrdiff_t>(first),
              target.begin() + static_cast<std::ptrdiff_t>(last),
              next.begin() + static_cast<std::ptrdiff_t>(first));
    if (next != way.back()) way.push_back(next);
  };
  AxisPosition retracted{};
  retracted[2] = std::max(top, from[2]);
  add(2, 3, retracted);
  add(3, 9, to);
  add(0, 2, to);
  add(2, 3, to);
  return way;
}

AxisPosition nearest_turns(const machine::MachineOutline& outline, const AxisPosition& from,
                           AxisPosition to) {
  for (std::size_t i = 0; i < to.size(); ++i)
    if (outline.axes[i].way != canonical::RotaryWay::linear)
      to[i] = canonical::rotary_target(canonical::RotaryWay::shortest, to[i], from[i]);
  return to;
}

std::vector<MeasuringStep> measuring_steps(const MeasurementInputs& in, const MeasuredMachine& machine,
                                           const PlannedPose& pose, const Vec3& centre) {
  std::vector<MeasuringStep> steps;
  const auto go = [&](const Vec3& beside, double feed) { steps.push_back({centre + beside, feed}); };
  const Vec3& tool = pose.directions.back();
  const auto shaft = shaft_at(in, machine, pose.angles);
  const double radius = outer_radius(in);
  for (std::size_t i = 0; i < pose.directions.size(); ++i) {
    const Vec3& direction = pose.directions[i];
    const bool pole = i + 1 == pose.directions.size();
    std::vector<Vec3> arc;
    if (in.positioning == Positioning::circular && i > 0 && !pole)
      arc = arc_between(pose.directions[i - 1], direction, tool, shaft, in);
    if (arc.empty()) {
      // By the height of the pole.
      if (i > 0) go(radius * (pose.directions[i - 1] + tool), in.positioning_feed);
      if (!pole) go(radius * (direction + tool), in.positioning_feed);
    }
    for (const auto& point : arc) go(radius * point, in.circle_feed);
    go(radius * direction, in.positioning_feed);
    steps.back().touch = true;
    steps.back().direction = direction;
  }
  return steps;
}

std::string measuring_program(const MeasurementInputs& in, const MeasuredMachine& machine,
                              const PlannedPose& pose, const Vec3& centre, const Way& way,
                              const ProgramEnd& end) {
  Writer writer(in, machine);
  writer.begin("calibration, pose " + pose_name(pose.angles, machine.model), way);
  std::size_t touches = 0;
  for (const auto& step : measuring_steps(in, machine, pose, centre)) {
    writer.go(step.to, step.feed);
    if (step.touch) writer.touch(step.direction, touches++);
  }
  return writer.end(end);
}

std::string repeatability_program(const MeasurementInputs& in, const MeasuredMachine& machine,
                                  const PlannedPose& pose, const Vec3& centre, const Way& way,
                                  const ProgramEnd& end) {
  Writer writer(in, machine);
  writer.begin("calibration, repeatability of the probe", way);
  writer.go(centre + outer_radius(in) * pose.directions.back(), in.positioning_feed);
  for (std::size_t i = 0; i < repeated_touches; ++i) writer.touch(pose.directions.back(), i);
  return writer.end(end);
}

std::string positioning_program(const MeasurementInputs& in, const MeasuredMachine& machine, const Way& way,
                                const ProgramEnd& end) {
  Writer writer(in, machine);
  writer.begin("calibration, end", way);
  return writer.end(end);
}

bool completed(const MacroVariables& variables, std::uint32_t serial) {
  const auto found = variables.find(serial_variable);
  return found != variables.end() && found->second == serial;
}

std::vector<Vec3> measured_positions(const MacroVariables& variables, std::size_t count) {
  std::vector<Vec3> positions;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3& position = positions.emplace_back();
    for (unsigned k = 0; k < 3; ++k) {
      const auto number = first_variable + 3 * static_cast<std::uint32_t>(i) + k;
      const auto found = variables.find(number);
      if (found == variables.end())
        throw std::runtime_error(
            fmt::format("macro variable #{} is vacant: touch {} is missing", number, i + 1));
      position[k] = found->second;
    }
  }
  return positions;
}

double range_along(const std::vector<Vec3>& positions, const Vec3& direction) {
  double low = 1e300, high = -1e300;
  for (const auto& position : positions) {
    low = std::min(low, position.dot(direction));
    high = std::max(high, position.dot(direction));
  }
  return positions.empty() ? 0 : high - low;
}

}  // namespace trunnion::calibration
