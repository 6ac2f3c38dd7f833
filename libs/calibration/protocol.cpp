// SPDX-License-Identifier: Apache-2.0
#include "calibration/protocol.hpp"

#include <cstdio>

namespace trunnion::calibration {
namespace {

template <class... Values>
void add(std::string& text, const char* format, Values... values) {
  char buffer[400];
  const int length = std::snprintf(buffer, sizeof buffer, format, values...);
  text.append(buffer, std::min<std::size_t>(static_cast<std::size_t>(length), sizeof buffer - 1));
}

void rule(std::string& text, char c) { text.append(78, c).push_back('\n'); }

void add_vector(std::string& text, const char* name, const Vec3& v, int digits) {
  add(text, "%-26s %14.*f %14.*f %14.*f\n", name, digits, v.x(), digits, v.y(), digits, v.z());
}

constexpr const char* modes[]{"correct", "only correct", "measure only"};
constexpr const char* planes[]{"G17", "G18", "G19", "active"};

void add_vectors(std::string& text, const KinematicsResult& result, bool directions_written) {
  add(text, "%-26s %14s %14s %14s\n", "Offset vectors:", "X [mm]", "Y [mm]", "Z [mm]");
  for (const auto& v : result.vectors) {
    add_vector(text, (v.name + " before").c_str(), v.before, 5);
    add_vector(text, (v.name + " after").c_str(), v.after, 5);
    add_vector(text, (v.name + " difference").c_str(), v.after - v.before, 5);
    add_vector(text, (v.name + " uncertainty (95 %)").c_str(), v.expanded, 5);
    if (!directions_written)
      add_vector(text, (v.name + " with real directions").c_str(), v.with_directions, 5);
  }
  add(text, "%-26s %14s %14s %14s\n", "Direction vectors:", "X", "Y", "Z");
  for (const auto& v : result.vectors) {
    add_vector(text, (v.name + " ideal").c_str(), v.direction_before, 9);
    add_vector(text, (v.name + " real").c_str(), v.direction_after, 9);
    add_vector(text, (v.name + " uncertainty (95 %)").c_str(), v.direction_expanded, 9);
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
    add(text, "%s%c%.6g", text.empty() ? "" : " ", rotary_letters[in.axes[axis].angle],
        angles[in.axes[axis].angle]);
  return text;
}

void add_corrections(std::string& text, const KinematicsResult& result) {
  if (result.corrections.empty()) return;
  add(text, "%-26s %14s %14s %14s\n", "Corrections:", "X [mm]", "Y [mm]", "Z [mm]");
  for (const auto& one : result.corrections) {
    add_vector(text, (one.name + " before").c_str(), one.before, 5);
    add_vector(text, (one.name + " circles").c_str(), one.circles, 5);
    add_vector(text, (one.name + " all poses").c_str(), one.all_poses, 5);
  }
}

}  // namespace

std::string protocol_text(const ProtocolHead& head, const MeasurementInputs& in,
                          const MeasuredMachine& machine, const KinematicsResult& result) {
  std::string text;
  rule(text, '*');
  add(text, "Date     : %s   Time: %s\n", head.date.c_str(), head.time.c_str());
  add(text, "Protocol : %s\nMachine  : %s\nTouches  : %s\n", head.file.c_str(), machine.name.c_str(),
      head.source.c_str());
  rule(text, '*');
  const auto type = metrology::kinematic_type(machine.model);
  add(text, "Results measure: kinematics, type %s, %s\n", metrology::to_string(type),
      modes[static_cast<int>(in.mode)]);
  add(text, "Measuring plane : %s\nTransformation  : %s\n", planes[static_cast<int>(in.plane)],
      in.transformation.empty() ? "of the channel" : in.transformation.c_str());
  const auto axes = counted_axes(in, machine.model);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const auto& range = in.axes[axes[i]];
    add(text, "Rotary axis %zu   : %c  start: %.3f  final: %.3f deg  no.: %zu\n", i + 1,
        rotary_letters[range.angle], range.start, range.end, range.points);
    for (std::size_t k = 0; k < axes.size(); ++k)
      if (k != i) add(text, "Position of rotary axis %zu : %.3f deg\n", k + 1, range.other);
  }
  add(text, "Sphere %.4f mm, ball %.4f mm, length of the probe %.4f mm, touches %zu\n", in.sphere_diameter,
      result.ball_diameter, in.probe_length, in.touches);
  rule(text, '-');
  Vec3 high = result.poses.front().difference, low = high;
  for (const auto& pose : result.poses)
    high = high.cwiseMax(pose.difference), low = low.cwiseMin(pose.difference);
  add(text, "%-26s %14s %14s %14s\n", "Difference of measure:", "X [mm]", "Y [mm]", "Z [mm]");
  add_vector(text, "max value", high, 5);
  add_vector(text, "min value", low, 5);
  for (const auto axis : axes)
    for (const auto row : result.axes[axis].rows) {
      const auto& pose = result.poses[row];
      add_vector(text, counted_name(pose.angles, in, axes).c_str(), pose.difference, 5);
    }
  add(text, "%-26s %14s %14s %14s %14s\n", "Residual after:", "X [mm]", "Y [mm]", "Z [mm]", "diameter [mm]");
  for (const auto& pose : result.poses)
    add(text, "%-26s %14.5f %14.5f %14.5f %14.5f\n", pose_name(pose.angles, machine.model).c_str(),
        pose.residual.x(), pose.residual.y(), pose.residual.z(), pose.diameter);
  rule(text, '-');
  add_corrections(text, result);
  add_vectors(text, result, in.write_directions);
  add(text, "Standard deviation of a touch by the residuals: %.5f mm (%zu degrees of freedom)\n",
      result.touch_deviation, result.freedom);
  if (!result.tolerance_alarm.empty()) text += "ALARM: " + result.tolerance_alarm + "\n";
  for (const auto& warning : result.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace trunnion::calibration
