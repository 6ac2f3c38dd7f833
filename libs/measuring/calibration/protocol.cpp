// SPDX-License-Identifier: Apache-2.0
#include "calibration/protocol.hpp"

#include <fmt/core.h>

namespace trunnion::calibration {
namespace {

void rule(std::string& text, char c) { text.append(78, c).push_back('\n'); }

void add_vector(std::string& text, const std::string& name, const Vec3& v, int digits) {
  text += fmt::format("{:<26} {:>14.{}f} {:>14.{}f} {:>14.{}f}\n", name, v.x(), digits, v.y(), digits, v.z(),
                      digits);
}

constexpr const char* modes[]{"correct", "only correct", "measure only"};
constexpr const char* planes[]{"G17", "G18", "G19", "active"};

void add_vectors(std::string& text, const KinematicsResult& result, bool directions_written) {
  text += fmt::format("{:<26} {:>14} {:>14} {:>14}\n", "Offset vectors:", "X [mm]", "Y [mm]", "Z [mm]");
  for (const auto& v : result.vectors) {
    add_vector(text, v.name + " before", v.before, 5);
    add_vector(text, v.name + " after", v.after, 5);
    add_vector(text, v.name + " difference", v.after - v.before, 5);
    add_vector(text, v.name + " uncertainty (95 %)", v.expanded, 5);
    if (!directions_written) add_vector(text, v.name + " with real directions", v.with_directions, 5);
  }
  text += fmt::format("{:<26} {:>14} {:>14} {:>14}\n", "Direction vectors:", "X", "Y", "Z");
  for (const auto& v : result.vectors) {
    add_vector(text, v.name + " ideal", v.direction_before, 9);
    add_vector(text, v.name + " real", v.direction_after, 9);
    add_vector(text, v.name + " uncertainty (95 %)", v.direction_expanded, 9);
  }
}

// Indices into the inputs' axes: rotary axis 1, rotary axis 2.
std::vector<std::size_t> counted_axes(const MeasurementInputs& in, const ChainParameters& model) {
  std::vector<std::size_t> axes;
  for (const auto& vector : counted_vectors(model))
    for (std::size_t i = 0; i < in.axes.size(); ++i)
      if (in.axes[i].angle == vector.angle) axes.push_back(i);
  return axes;
}

// "B90 C0": rotary axis 1, rotary axis 2.
std::string counted_name(const Angles& angles, const MeasurementInputs& in,
                         const std::vector<std::size_t>& axes) {
  std::string text;
  for (const auto axis : axes)
    text += fmt::format("{}{}{:.6g}", text.empty() ? "" : " ", rotary_letters[in.axes[axis].angle],
                        angles[in.axes[axis].angle]);
  return text;
}

void add_corrections(std::string& text, const KinematicsResult& result) {
  if (result.corrections.empty()) return;
  text += fmt::format("{:<26} {:>14} {:>14} {:>14}\n", "Corrections:", "X [mm]", "Y [mm]", "Z [mm]");
  for (const auto& one : result.corrections) {
    add_vector(text, one.name + " before", one.before, 5);
    add_vector(text, one.name + " circles", one.circles, 5);
    add_vector(text, one.name + " all poses", one.all_poses, 5);
  }
}

}  // namespace

std::string protocol_text(const ProtocolHead& head, const MeasurementInputs& in,
                          const MeasuredMachine& machine, const KinematicsResult& result) {
  std::string text;
  rule(text, '*');
  text += fmt::format("Date     : {}   Time: {}\n", head.date, head.time);
  text += fmt::format("Protocol : {}\nMachine  : {}\nTouches  : {}\n", head.file, machine.name, head.source);
  rule(text, '*');
  const auto type = metrology::kinematic_type(machine.model);
  text += fmt::format("Results measure: kinematics, type {}, {}\n", metrology::to_string(type),
                      modes[static_cast<int>(in.mode)]);
  text += fmt::format("Measuring plane : {}\nTransformation  : {}\n", planes[static_cast<int>(in.plane)],
                      in.transformation.empty() ? "of the channel" : in.transformation);
  const auto axes = counted_axes(in, machine.model);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& range = in.axes[axes[i]];
    text += fmt::format("Rotary axis {}   : {}  start: {:.3f}  final: {:.3f} deg  no.: {}\n", i + 1,
                        rotary_letters[range.angle], range.start, range.end, range.points);
    for (std::size_t k = 0; k < axes.size(); ++k)
      if (k != i) text += fmt::format("Position of rotary axis {} : {:.3f} deg\n", k + 1, range.other);
  }
  text += fmt::format("Sphere {:.4f} mm, ball {:.4f} mm, length of the probe {:.4f} mm, touches {}\n",
                      in.sphere_diameter, result.ball_diameter, in.probe_length, in.touches);
  rule(text, '-');
  Vec3 high = result.poses.front().difference, low = high;
  for (const auto& pose : result.poses)
    high = high.cwiseMax(pose.difference), low = low.cwiseMin(pose.difference);
  text +=
      fmt::format("{:<26} {:>14} {:>14} {:>14}\n", "Difference of measure:", "X [mm]", "Y [mm]", "Z [mm]");
  add_vector(text, "max value", high, 5);
  add_vector(text, "min value", low, 5);
  for (const auto axis : axes)
    for (const auto row : result.axes[axis].rows) {
      const auto& pose = result.poses[row];
      add_vector(text, counted_name(pose.angles, in, axes), pose.difference, 5);
    }
  text += fmt::format("{:<26} {:>14} {:>14} {:>14} {:>14}\n", "Residual after:", "X [mm]", "Y [mm]", "Z [mm]",
                      "diameter [mm]");
  for (const auto& pose : result.poses)
    text +=
        fmt::format("{:<26} {:>14.5f} {:>14.5f} {:>14.5f} {:>14.5f}\n", pose_name(pose.angles, machine.model),
                    pose.residual.x(), pose.residual.y(), pose.residual.z(), pose.diameter);
  rule(text, '-');
  add_corrections(text, result);
  add_vectors(text, result, in.write_directions);
  text += fmt::format("Standard deviation of a touch by the residuals: {:.5f} mm ({} degrees of freedom)\n",
                      result.touch_deviation, result.freedom);
  if (!result.tolerance_alarm.empty()) text += "ALARM: " + result.tolerance_alarm + "\n";
  for (const auto& warning : result.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace trunnion::calibration
