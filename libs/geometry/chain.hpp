// Kinematic chains of machines with up to two rotary axes in the head and up to two under the workpiece.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace trunnion::geometry {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Positions of the rotary axes A, B, C of a channel in degrees. Entries no rotary axis names are ignored.
using Angles = std::array<double, 3>;

/// One rotary axis of a head or a table.
struct RotaryAxis {
  Vec3 direction =
      Vec3::UnitZ();           ///< axis of rotation, signed by the sense of rotation; any length above zero
  Vec3 offset = Vec3::Zero();  ///< mm; of a head: from the tool towards the base, of a table: see Chain
  std::size_t angle = 0;       ///< which entry of Angles turns it: 0 = A, 1 = B, 2 = C
};

/// Head and table of a machine: axis 1 is next to the base, axis 2 carries the tool or the workpiece. A
/// machine with one rotary axis on a side uses the second slot of that side. Empty slots do not turn and have
/// no offset.
struct ChainParameters {
  Vec3 tool_direction =
      Vec3::UnitZ();  ///< from the tip to the spindle with every rotary axis at zero; any length
  std::optional<RotaryAxis> head_1, head_2;
  std::optional<RotaryAxis> table_1, table_2;
};

enum class ChainError : std::uint8_t {
  not_finite,      ///< a component of a direction or an offset is infinite or not a number
  zero_direction,  ///< a direction vector has no length
  bad_angle,       ///< RotaryAxis::angle is above 2
  shared_angle,    ///< two rotary axes are turned by the same angle
};

/// Derivative of the machine position by everything it depends on.
struct Jacobian {
  Mat3 tip;    ///< dX/dw, mm/mm: the rotation of the table
  Mat3 angle;  ///< column k: dX/d(angle k), mm/degree; zero for angles that turn nothing
};

/// Transformation between tool tip and machine axes. With t0 the tool direction, L the tool length, R1 and R2
/// the rotations of the two axes and v1, v2 their offsets:
///   table  P = v2 + v1 + R1 [-v1 + R2 (w - v2)]
///   head   X = P - (v1 + v2) + R1 [v1 + R2 (v2 + L t0)]
/// w is the tip in machine coordinates with all rotary axes at zero (so X = w + L t0 there), P the same
/// workpiece point after the table has turned, X the position of the linear machine axes, all in mm. Pure,
/// allocation-free and safe to use from any thread. (HNC-8 five-axis parameters 040400..040437.)
class Chain {
 public:
  /// Checks and normalizes the parameters.
  static std::variant<Chain, ChainError> make(const ChainParameters& parameters);

  /// Machine position of the linear axes that puts a tool of length `tool_length` (mm) with its tip at `w`.
  Vec3 machine_from_tip(const Vec3& w, const Angles& degrees, double tool_length) const;

  /// Inverse of machine_from_tip, closed to rounding.
  Vec3 tip_from_machine(const Vec3& machine, const Angles& degrees, double tool_length) const;

  /// Unit vector from the tip to the spindle as the workpiece sees it, in the frame of w.
  Vec3 tool_direction_in_workpiece(const Angles& degrees) const;

  /// Analytic derivative of machine_from_tip at the pose.
  Jacobian jacobian(const Vec3& w, const Angles& degrees, double tool_length) const;

  /// True when entry `angle` of Angles turns an axis of this machine.
  bool turns(std::size_t angle) const;

 private:
  struct Joint {
    Vec3 direction = Vec3::UnitZ();
    Vec3 offset = Vec3::Zero();
    int angle = -1;  // -1: the slot is empty
  };

  Chain() = default;
  static Mat3 rotation(const Joint& joint, const Angles& degrees);
  static std::optional<ChainError> adopt(const std::optional<RotaryAxis>& axis, Joint& joint);

  Vec3 tool_direction_ = Vec3::UnitZ();
  Joint head_1_, head_2_, table_1_, table_2_;
};

}  // namespace trunnion::geometry
