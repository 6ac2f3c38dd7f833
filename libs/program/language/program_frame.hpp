// SPDX-License-Identifier: Apache-2.0
// From the words of a program to the frame of its commands.
#pragma once

#include <array>
#include <cstdint>

#include "language/arc_geometry.hpp"
#include "language/canonical.hpp"
#include "language/rotation_matrix.hpp"
#include "language/stroke_zone.hpp"

namespace trunnion::language {

/// How the workpiece stands against its drawing (G54.4).
struct SettingError {
  std::uint8_t number = 0;  ///< P; 0 = none
  Vector3 offset{};         ///< mm, of the workpiece zero
  Matrix3 matrix = no_rotation;
};

/// The chain of programmable frames. In whatever sequence a program switches them on, a position goes
/// through them in this one:
///
///   program   words as written, after units, diameters, polar coordinates and G91
///     1. mirror (G51.1, G24): about a coordinate, per axis
///     2. scaling (G51): about a point, per linear axis
///     3. rotation (G68): in one plane, about a point that the mirror and the scaling move along; where they
///        mirror the plane, in the other sense, so that a mirrored part is the mirror image of the part
///   contour   where cutter radius compensation works
///     4. tilted plane (G68.1, G68.2, G68.3): rotation matrix and origin
///   workpiece what a drawing dimensions
///     5. G52 + G92, added; then the setting error of the workpiece (G54.4): rotation matrix and offset
///     6. work offset (G54..G59, G54.1, external), added
///   command   as in Command::target, but for the tool length
///
/// Angles in degrees, lengths in mm. Every step can be undone: no factor may be 0.
class ProgramFrame {
 public:
  AxisValues contour_from_program(const AxisValues& program) const;
  AxisValues program_from_contour(const AxisValues& contour) const;
  AxisValues command_from_contour(const AxisValues& contour) const;
  AxisValues contour_from_command(const AxisValues& command) const;
  /// The point as the words of the program would give it.
  AxisValues program_from_command(const AxisValues& command) const {
    return program_from_contour(contour_from_command(command));
  }
  /// The point without its offsets: what a position display calls workpiece coordinates.
  AxisValues workpiece_from_command(const AxisValues& command) const;
  /// A direction in the tilted plane, in the workpiece frame.
  Vector3 turned_by_tilt(const Vector3& direction) const;
  /// The same in the frame of the commands, and back.
  Vector3 turned(const Vector3& direction) const;
  Vector3 turned_back(const Vector3& direction) const;
  /// A direction of the words is another one in the frame of the commands.
  bool turns() const { return tilt_.active || setting_.number != 0; }

  /// Only offsets act: a command is the program's position plus total_offset().
  bool plain() const { return plain_; }
  const AxisValues& total_offset() const { return total_; }
  /// Counts the changes.
  std::uint32_t revision() const { return revision_; }

  void set_work_offset(const AxisValues& offset);
  void set_local(std::uint8_t axis, double value);  ///< G52
  void set_shift(std::uint8_t axis, double value);  ///< G92: added to the work offset
  const AxisValues& work_offset() const { return work_offset_; }
  const AxisValues& local() const { return local_; }
  const AxisValues& shift() const { return shift_; }

  void set_mirror(std::uint8_t axis, bool on, double about);
  void clear_mirror();
  bool mirrored() const { return mirrored_ != 0; }
  /// A bit of each axis.
  std::uint16_t mirrored_axes() const { return mirrored_; }

  /// Factors of X Y Z, negative ones mirror; none may be 0.
  void set_scaling(const Vector3& centre, const Vector3& factors);
  void clear_scaling();

  /// Anticlockwise in the plane.
  void set_rotation(Plane plane, const Vector3& centre, double degrees);
  void clear_rotation();
  double rotation() const { return degrees_; }

  void set_tilt(const Tilt& tilt);
  const Tilt& tilt() const { return tilt_; }

  /// X Y Z mm and A B C degrees as Environment::setting_error(); 0: none.
  void set_setting_error(std::uint8_t number, const AxisValues& values);
  const SettingError& setting_error() const { return setting_; }

  /// What G22 forbids moves to do: it has a frame's life, and changes no position.
  void set_zone(const StrokeZone& zone);
  const StrokeZone& zone() const { return zone_; }

  /// Circles of the plane stay circles: both axes have the same factor but for its sign.
  bool keeps_circles(Plane plane) const;
  /// Clockwise becomes anticlockwise, left becomes right.
  bool flips(Plane plane) const;

 private:
  void update();
  /// A point of the workpiece, with G52 and G92, in the frame of the commands.
  AxisValues set_up(AxisValues workpiece) const;

  AxisValues work_offset_{}, local_{}, shift_{}, total_{};
  std::uint16_t mirrored_ = 0;  // bit of each axis
  AxisValues mirror_{};
  bool scaled_ = false;
  Vector3 scaling_centre_{}, factors_{1, 1, 1};
  bool rotated_ = false;
  Plane plane_ = Plane::xy;
  Vector3 rotation_centre_{};  // as programmed
  Vector3 turned_centre_{};    // after mirror and scaling
  double degrees_ = 0, cosine_ = 1, sine_ = 0;
  Tilt tilt_{};
  SettingError setting_{};
  StrokeZone zone_{};
  bool plain_ = true;
  std::uint32_t revision_ = 0;
};

}  // namespace trunnion::language
