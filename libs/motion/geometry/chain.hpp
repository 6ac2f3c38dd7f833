// SPDX-License-Identifier: Apache-2.0
// Kinematic chains of machines: rotary axes in the head and under the workpiece, linear axes between them.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "geometry/types.hpp"

namespace trunnion::geometry {

/// One rotary axis of a head or a table.
struct RotaryAxis {
  Vec3 direction =
      Vec3::UnitZ();           ///< axis of rotation, signed by the sense of rotation; any length above zero
  Vec3 offset = Vec3::Zero();  ///< mm; of a head: from the tool towards the base, of a table: see Chain
  std::size_t angle = 0;       ///< which entry of Angles turns it: 0 = A .. 5 = W
  Vec3 correction =
      Vec3::Zero();  ///< mm, added to the offset: what a measurement of the kinematics has found
};

/// Head, table and linear axes of a machine, as parameters 04c400..04c437 have them. Axis 1 is next to the
/// base, axis 2 carries the tool or the workpiece; a third axis of a side, axis 0, comes before axis 1. A
/// side with one rotary axis uses slot 2, one with two slots 1 and 2. Empty slots do not turn and have no
/// offset.
struct ChainParameters {
  Vec3 tool_direction =
      Vec3::UnitZ();  ///< from the tip to the spindle with every rotary axis at zero; any length
  std::optional<RotaryAxis> head_1, head_2;
  std::optional<RotaryAxis> table_1, table_2;
  std::optional<RotaryAxis> head_0, table_0;
  /// Columns: where the tool moves, seen from the workpiece, when X, Y, Z go in the positive direction; any
  /// length.
  Mat3 linear_direction = Mat3::Identity();
  /// Number of rotary axes between the base and X, Y, Z, which turn them. Above zero those of the head,
  /// below zero those of the table, counted from the base. linear_direction is meant with all at zero.
  std::array<int, 3> linear_carriers{};
  /// mm: the tip minus the origin of the workpiece frame with every axis at zero and a tool without length.
  /// Zero for a closed chain.
  Vec3 origin = Vec3::Zero();
  /// The chain does not end where it began: corrections move the origin, too.
  bool open = false;
  /// mm: of an open chain, the correction between the last table axis and the first head axis, towards the
  /// tool.
  Vec3 base_correction = Vec3::Zero();
};

enum class ChainError : std::uint8_t {
  not_finite,        ///< a component of a direction or an offset is infinite or not a number
  zero_direction,    ///< a direction vector has no length
  bad_angle,         ///< RotaryAxis::angle is above 5
  shared_angle,      ///< two rotary axes are turned by the same angle
  parallel_axes,     ///< no two of several rotary axes have different directions
  dependent_linear,  ///< the directions of X, Y and Z lie in a plane
  bad_carrier,       ///< a linear axis is carried by more rotary axes than its side has
  too_many_rotary,   ///< more than three rotary axes on a side
  two_corrections,   ///< two corrections with no rotary axis between them
  idle_correction,   ///< a correction between table and head of a closed chain: it would do nothing
  linear_missing,    ///< a chain of elements without X, Y or Z, or with one of them twice
  two_bases,         ///< a chain of elements with more than one base
};

/// Rotary axes whose directions enclose less than this (sine of the angle) count as parallel.
inline constexpr double parallel_sine = 0.01;

/// Derivative of the machine position by everything it depends on.
struct Jacobian {
  Mat3 tip;            ///< dX/dw, mm/mm
  Mat3 angle;          ///< column k: dX/d(angle k), mm/degree, of A B C; zero for angles that turn nothing
  Mat3 further_angle;  ///< the same of U V W
};

/// Tip and angles with their derivatives by a path parameter or by time: [0] value, [1] .. [3] derivatives.
struct TipMotion {
  std::array<Vec3, 4> tip{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  ///< mm
  std::array<Angles, 4> angles{};                                                   ///< degrees
};

/// One rotary axis in the order workpiece to tool with its direction as it turns the tool seen from the
/// workpiece: that of a table axis is the opposite of its parameter.
struct OrientingAxis {
  Vec3 direction = Vec3::UnitZ();
  std::size_t angle = 0;
};

/// Transformation between tool tip and machine axes. With t0 the tool direction, L the tool length, R0 R1 R2
/// the rotations of a side's axes and v0 v1 v2 their offsets:
///   table  P = v2 + v1 + v0 + R0 [-v0 + R1 [-v1 + R2 (w - v2)]]
///   head   D X = P - (v2 + v1 + v0) + R0 [v0 + R1 [v1 + R2 (v2 + L t0)]] - origin
/// w is the tip in the workpiece frame: machine coordinates with all rotary axes at zero (so X = w + L t0
/// there, for D = 1 and no origin), P the same workpiece point after the table has turned, X the position of
/// the linear machine axes, all in mm; D has the directions of the linear axes as columns, turned by the
/// rotary axes that carry them. Angles in degrees. Pure, allocation-free and safe to use from any thread.
/// (HNC-8 five-axis parameters 040400..040437.)
class Chain {
 public:
  /// Checks and normalizes the parameters.
  static std::variant<Chain, ChainError> make(const ChainParameters& parameters);

  /// Result of machine_from_tip() for every linear axis, mm, where no position exists: rotary axes that
  /// carry linear ones have turned X, Y and Z into one plane (within parallel_sine). It is beyond every
  /// travel, so that such a pose is reported as out of travel.
  static constexpr double no_position = 1e7;

  /// Machine position of the linear axes that puts a tool of length `tool_length` (mm) with its tip at `w`.
  Vec3 machine_from_tip(const Vec3& w, const Angles& degrees, double tool_length) const;

  /// Inverse of machine_from_tip, closed to rounding.
  Vec3 tip_from_machine(const Vec3& machine, const Angles& degrees, double tool_length) const;

  /// Unit vector from the tip to the spindle as the workpiece sees it, in the frame of w.
  Vec3 tool_direction_in_workpiece(const Angles& degrees) const;

  /// Analytic derivative of machine_from_tip at the pose.
  Jacobian jacobian(const Vec3& w, const Angles& degrees, double tool_length) const;

  /// Machine position and its first three derivatives along a path of tip and angles: velocity, acceleration
  /// and jerk of the linear axes when the path is given by time.
  std::array<Vec3, 4> machine_derivatives(const TipMotion& motion, double tool_length) const;

  /// True when entry `angle` of Angles turns an axis of this machine.
  bool turns(std::size_t angle) const;

  std::size_t rotary_count() const { return table_.count + head_.count; }
  /// Axis `index` < rotary_count() counted from the workpiece to the tool.
  OrientingAxis orienting_axis(std::size_t index) const;
  /// Unit vector from the tip to the spindle with every rotary axis at zero.
  const Vec3& tool_direction() const { return tool_direction_; }

 private:
  struct Joint {
    Vec3 direction = Vec3::UnitZ();
    Vec3 offset = Vec3::Zero();
    std::size_t angle = 0;
  };
  // Axes of one side, [0] next to the workpiece or the tool.
  struct Side {
    std::array<Joint, 3> joints;
    std::size_t count = 0;
    Vec3 offsets() const;
  };

  Chain() = default;
  static std::optional<ChainError> adopt(const std::optional<RotaryAxis>& axis, Side& side);
  std::optional<ChainError> check_rotary() const;
  void turn(const Joint& joint, const TipMotion& motion, std::array<Vec3, 4>& y) const;
  template <class Turn>
  void carry(std::size_t axis, Turn&& turn) const;
  Mat3 carried_directions(const Angles& degrees) const;
  Vec3 carried_axes_from_space(const Vec3& x, const Angles& degrees) const;
  std::array<Vec3, 4> carried_derivatives(const std::array<Vec3, 4>& space, const TipMotion& motion) const;
  Jacobian carried_jacobian(const Vec3& w, const Angles& degrees, double tool_length) const;
  Vec3 axes_from_space(const Vec3& x, const Angles& degrees) const {
    if (carried_) return carried_axes_from_space(x, degrees);
    return perpendicular_ ? x : Vec3(from_space_ * x);
  }
  Vec3 space_from_axes(const Vec3& x, const Angles& degrees) const {
    if (carried_) return carried_directions(degrees) * x;
    return perpendicular_ ? x : Vec3(to_space_ * x);
  }

  Vec3 tool_direction_ = Vec3::UnitZ();
  Side table_, head_;
  Vec3 base_ = Vec3::Zero();  // what the formulae add apart from the brackets
  bool perpendicular_ = true;
  Mat3 to_space_ = Mat3::Identity(), from_space_ = Mat3::Identity();
  std::array<int, 3> carriers_{};
  bool carried_ = false;  // any of them is not zero
};

}  // namespace trunnion::geometry
