// SPDX-License-Identifier: Apache-2.0
#include "calibration/measurement_poses.hpp"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::calibration {
namespace {

using geometry::Chain;

// Clear distance that the search for the angle of the touches prefers no longer, mm.
constexpr double shaft_clearance = 1;
constexpr double plastic_number = 1.32471795724474602596;

std::vector<Vec3> touch_directions(const Vec3& tool, double start, std::size_t around) {
  // The angle counts from the direction of X, or of Y where the tool lies along X.
  const Vec3 reference = std::abs(tool.x()) < 0.9 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 x = (reference - tool * tool.dot(reference)).normalized(), y = tool.cross(x);
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < around; ++i) {
    const auto t = geometry::sine_cosine(start + 360 * static_cast<double>(i) / static_cast<double>(around));
    directions.emplace_back(t.cosine * x + t.sine * y);
  }
  directions.push_back(tool);
  return directions;
}

// Least distance between ball and shaft over all touches, mm; the shaft begins at the centre of the sphere.
double clearance(const std::vector<Vec3>& directions, const Vec3& shaft, const MeasurementInputs& in) {
  double least = 1e9;
  const double reach = (in.sphere_diameter + in.ball_diameter) / 2;
  for (const auto& direction : directions) {
    const double along = direction.dot(shaft);
    const double distance = along > 0 ? reach * direction.cross(shaft).norm() : reach;
    least = std::min(least, distance - (in.ball_diameter + in.shaft_diameter) / 2);
  }
  return least;
}

class Planner {
 public:
  Planner(const MeasurementInputs& in, const MeasuredMachine& machine)
      : in_(in), machine_(machine), chain_(std::get<Chain>(Chain::make(machine.model))) {}

  std::variant<MeasurementPlan, std::string> plan() {
    add({}, in_.axes.front().touch_start);
    for (const auto& range : in_.axes) {
      auto& row = plan_.rows.emplace_back();
      for (std::size_t i = 0; i < range.points; ++i) {
        Angles angles{};
        for (const auto& other : in_.axes) angles[other.angle] = range.other;
        angles[range.angle] = range.start + (range.end - range.start) * static_cast<double>(i) /
                                                static_cast<double>(range.points - 1);
        row.push_back(add(angles, range.touch_start));
      }
    }
    // The additive recurrence with the plastic number is even over a square in every length (Roberts).
    for (std::size_t i = 1; i <= in_.further_poses; ++i) {
      Angles angles{};
      double step = 1;
      for (const auto& range : in_.axes) {
        step /= plastic_number;
        const double share = std::fmod(0.5 + step * static_cast<double>(i), 1);
        angles[range.angle] = std::round(range.start + share * (range.end - range.start));
      }
      add(angles, in_.axes.front().touch_start);
    }
    if (!fault_.empty()) return fault_;
    return plan_;
  }

  std::variant<PlannedPose, std::string> one(const Angles& angles) {
    add(angles, in_.axes.front().touch_start);
    if (!fault_.empty()) return fault_;
    return plan_.poses.front();
  }

 private:
  std::size_t add(const Angles& angles, double touch_start) {
    for (std::size_t i = 0; i < plan_.poses.size(); ++i)
      if (plan_.poses[i].angles == angles) return i;
    const geometry::Mat3 turn = chain_.jacobian(in_.sphere, angles, in_.probe_length).tip;
    const Vec3 tool = (turn * chain_.tool_direction_in_workpiece(angles)).normalized();
    const std::size_t around = in_.touches / 2 - 1;
    PlannedPose pose{angles, touch_directions(tool, touch_start, around)};
    if (in_.shaft) avoid_shaft(pose, tool, (turn * *in_.shaft).normalized(), around);
    check_travel(pose);
    plan_.poses.push_back(pose);
    return plan_.poses.size() - 1;
  }

  void avoid_shaft(PlannedPose& pose, const Vec3& tool, const Vec3& shaft, std::size_t around) {
    double best = -1e9;
    for (double start = 0; start < 360 / static_cast<double>(around); start += 1) {
      const auto directions = touch_directions(tool, start, around);
      const double clear = std::min(clearance(directions, shaft, in_), shaft_clearance);
      if (clear > best + 1e-9) best = clear, pose.directions = directions;
    }
    if (best < 0)
      fail(pose,
           fmt::format(": the probe would meet the shaft of the sphere by {:.2f} mm at every angle of the "
                       "touches; choose a smaller range or another shaft",
                       -best));
  }

  void check_travel(const PlannedPose& pose) {
    const Vec3 centre = chain_.machine_from_tip(in_.sphere, pose.angles, in_.probe_length);
    const double reach = (in_.sphere_diameter + in_.ball_diameter) / 2 + standoff(in_);
    for (int i = 0; i < 3; ++i) {
      const auto& travel = machine_.outline.axes[static_cast<std::size_t>(i)];
      if (!travel.present) continue;
      for (const double side : {-reach, reach}) {
        const double position = centre[i] + side;
        if (position >= travel.low && position <= travel.high) continue;
        fail(pose, fmt::format(": {} {:.3f} mm is not within its travel {:.10g} .. {:.10g} mm", "XYZ"[i],
                               position, travel.low, travel.high));
        return;
      }
    }
  }

  void fail(const PlannedPose& pose, const std::string& text) {
    if (fault_.empty()) fault_ = "pose " + pose_name(pose.angles, machine_.model) + text;
  }

  const MeasurementInputs& in_;
  const MeasuredMachine& machine_;
  Chain chain_;
  MeasurementPlan plan_;
  std::string fault_;
};

}  // namespace

std::variant<MeasurementPlan, std::string> plan_measurement(const MeasurementInputs& inputs,
                                                            const MeasuredMachine& machine) {
  return Planner(inputs, machine).plan();
}

std::variant<PlannedPose, std::string> plan_pose(const MeasurementInputs& inputs,
                                                 const MeasuredMachine& machine, const Angles& angles) {
  return Planner(inputs, machine).one(angles);
}

std::string pose_name(const Angles& angles, const ChainParameters& chain) {
  std::string text;
  for (const auto& vector : metrology::root_vectors(chain)) {
    text += fmt::format("{}{}{:.6g}", text.empty() ? "" : " ", "ABCUVW"[vector.angle], angles[vector.angle]);
  }
  return text;
}

}  // namespace trunnion::calibration
