// SPDX-License-Identifier: Apache-2.0
#include "language/program_frame.hpp"

#include <cmath>
#include <numbers>

namespace trunnion::language {
namespace {

struct Turn {
  double cosine;
  double sine;
};

/// Quarter turns are exact: a pocket turned by 90 degrees has the numbers of the pocket.
Turn turn_by(double degrees) {
  const double angle = std::remainder(degrees, 360.0);
  const double quarters = angle / 90.0;
  if (quarters == std::round(quarters)) {
    switch (static_cast<int>(quarters)) {
      case 0:
        return {1, 0};
      case 1:
        return {0, 1};
      case -1:
        return {0, -1};
      default:
        return {-1, 0};
    }
  }
  const double radians = angle * (std::numbers::pi / 180.0);
  return {std::cos(radians), std::sin(radians)};
}

}  // namespace

void ProgramFrame::update() {
  for (std::size_t i = 0; i < axis_count; ++i) total_[i] = work_offset_[i] + shift_[i] + local_[i];
  for (std::size_t i = 0; i < 3; ++i) {
    double centre = rotation_centre_[i];
    if (((mirrored_ >> i) & 1u) != 0) centre = 2 * mirror_[i] - centre;
    turned_centre_[i] = scaling_centre_[i] + factors_[i] * (centre - scaling_centre_[i]);
  }
  const Turn turn = turn_by(flips(plane_) ? -degrees_ : degrees_);
  cosine_ = turn.cosine;
  sine_ = turn.sine;
  ++revision_;
  plain_ = mirrored_ == 0 && !scaled_ && !rotated_ && !turns();
}

AxisValues ProgramFrame::contour_from_program(const AxisValues& program) const {
  AxisValues p = program;
  if (mirrored_ != 0) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      if (((mirrored_ >> i) & 1u) != 0) p[i] = 2 * mirror_[i] - p[i];
    }
  }
  if (scaled_) {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = scaling_centre_[i] + factors_[i] * (p[i] - scaling_centre_[i]);
    }
  }
  if (rotated_) {
    const auto [first, second, normal] = plane_axes(plane_);
    const double u = p[first] - turned_centre_[first];
    const double v = p[second] - turned_centre_[second];
    p[first] = turned_centre_[first] + cosine_ * u - sine_ * v;
    p[second] = turned_centre_[second] + sine_ * u + cosine_ * v;
  }
  return p;
}

AxisValues ProgramFrame::program_from_contour(const AxisValues& contour) const {
  AxisValues p = contour;
  if (rotated_) {
    const auto [first, second, normal] = plane_axes(plane_);
    const double u = p[first] - turned_centre_[first];
    const double v = p[second] - turned_centre_[second];
    p[first] = turned_centre_[first] + cosine_ * u + sine_ * v;
    p[second] = turned_centre_[second] - sine_ * u + cosine_ * v;
  }
  if (scaled_) {
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = scaling_centre_[i] + (p[i] - scaling_centre_[i]) / factors_[i];
    }
  }
  if (mirrored_ != 0) {
    for (std::size_t i = 0; i < axis_count; ++i) {
      if (((mirrored_ >> i) & 1u) != 0) p[i] = 2 * mirror_[i] - p[i];
    }
  }
  return p;
}

Vector3 ProgramFrame::turned_by_tilt(const Vector3& d) const {
  return tilt_.active ? language::turned(tilt_.matrix, d) : d;
}

Vector3 ProgramFrame::turned(const Vector3& d) const {
  return language::turned(setting_.matrix, turned_by_tilt(d));
}

Vector3 ProgramFrame::turned_back(const Vector3& d) const {
  return language::turned_back(tilt_.matrix, language::turned_back(setting_.matrix, d));
}

AxisValues ProgramFrame::command_from_contour(const AxisValues& contour) const {
  AxisValues p = contour;
  if (tilt_.active) {
    const Vector3 turned = turned_by_tilt({p[X], p[Y], p[Z]});
    for (std::size_t i = 0; i < 3; ++i) p[i] = tilt_.origin[i] + turned[i];
  }
  if (setting_.number != 0) return set_up(p);
  for (std::size_t i = 0; i < axis_count; ++i) p[i] += total_[i];
  return p;
}

AxisValues ProgramFrame::workpiece_from_command(const AxisValues& command) const {
  AxisValues p = command;
  for (std::size_t i = 0; i < axis_count; ++i) p[i] -= total_[i];
  if (setting_.number == 0) return p;
  Vector3 d{};
  for (std::size_t i = 0; i < 3; ++i) d[i] = command[i] - work_offset_[i] - setting_.offset[i];
  d = language::turned_back(setting_.matrix, d);
  for (std::size_t i = 0; i < 3; ++i) p[i] = d[i] - local_[i] - shift_[i];
  return p;
}

// What G52 and G92 shift stands as the workpiece does.
AxisValues ProgramFrame::set_up(AxisValues p) const {
  Vector3 d{};
  for (std::size_t i = 0; i < 3; ++i) d[i] = p[i] + local_[i] + shift_[i];
  d = language::turned(setting_.matrix, d);
  for (std::size_t i = 0; i < axis_count; ++i) p[i] += total_[i];
  for (std::size_t i = 0; i < 3; ++i) p[i] = work_offset_[i] + setting_.offset[i] + d[i];
  return p;
}

AxisValues ProgramFrame::contour_from_command(const AxisValues& command) const {
  AxisValues p = workpiece_from_command(command);
  if (tilt_.active) {
    const auto& m = tilt_.matrix;
    const Vector3 d{p[X] - tilt_.origin[0], p[Y] - tilt_.origin[1], p[Z] - tilt_.origin[2]};
    for (std::size_t i = 0; i < 3; ++i) p[i] = m[i] * d[0] + m[3 + i] * d[1] + m[6 + i] * d[2];
  }
  return p;
}

void ProgramFrame::set_work_offset(const AxisValues& offset) {
  work_offset_ = offset;
  update();
}

void ProgramFrame::set_local(std::uint8_t axis, double value) {
  local_[axis] = value;
  update();
}

void ProgramFrame::set_shift(std::uint8_t axis, double value) {
  shift_[axis] = value;
  update();
}

void ProgramFrame::set_mirror(std::uint8_t axis, bool on, double about) {
  const auto bit = static_cast<std::uint16_t>(1u << axis);
  mirrored_ = static_cast<std::uint16_t>(on ? mirrored_ | bit : mirrored_ & ~bit);
  mirror_[axis] = about;
  update();
}

void ProgramFrame::clear_mirror() {
  mirrored_ = 0;
  update();
}

void ProgramFrame::set_scaling(const Vector3& centre, const Vector3& factors) {
  scaled_ = true;
  scaling_centre_ = centre;
  factors_ = factors;
  update();
}

void ProgramFrame::clear_scaling() {
  scaled_ = false;
  scaling_centre_ = {};
  factors_ = {1, 1, 1};
  update();
}

void ProgramFrame::set_rotation(Plane plane, const Vector3& centre, double degrees) {
  rotated_ = true;
  plane_ = plane;
  rotation_centre_ = centre;
  degrees_ = degrees;
  update();
}

void ProgramFrame::clear_rotation() {
  rotated_ = false;
  degrees_ = 0;
  update();
}

void ProgramFrame::set_tilt(const Tilt& tilt) {
  tilt_ = tilt;
  update();
}

void ProgramFrame::set_setting_error(std::uint8_t number, const AxisValues& values) {
  setting_ = {};
  if (number != 0)
    setting_ = {number, {values[X], values[Y], values[Z]}, roll_pitch_yaw(values[A], values[B], values[C])};
  update();
}

void ProgramFrame::set_zone(const StrokeZone& zone) {
  zone_ = zone;
  update();
}

bool ProgramFrame::keeps_circles(Plane plane) const {
  const auto [first, second, normal] = plane_axes(plane);
  // Factors are small decimal words; a difference above rounding is meant.
  return std::abs(std::abs(factors_[first]) - std::abs(factors_[second])) <=
         1e-12 * std::abs(factors_[first]);
}

bool ProgramFrame::flips(Plane plane) const {
  const auto [first, second, normal] = plane_axes(plane);
  const bool mirrored = (((mirrored_ >> first) ^ (mirrored_ >> second)) & 1u) != 0;
  return mirrored != ((factors_[first] < 0) != (factors_[second] < 0));
}

}  // namespace trunnion::language
