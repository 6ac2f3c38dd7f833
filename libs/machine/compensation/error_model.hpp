// SPDX-License-Identifier: Apache-2.0
// A machine with geometric errors: where the tip of the tool is for given positions of the axes.
//
// Frames and signs. The frame is the machine's with every axis at zero, mm. An error is the motion of the
// tool as the workpiece sees it, for carriages of the tool and of the workpiece alike: with EXX = +5 um the
// tool arrives 5 um too far in +X. The parts are rigid, and their transformations are multiplied without
// linearization.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compensation/error_function.hpp"
#include "compensation/warm_up.hpp"
#include "geometry/chain.hpp"

namespace trunnion::volumetric {

using geometry::Mat3;
using geometry::Vec3;

/// A rotation: by `angles` x, y, z (rad) about the fixed axes X, then Y, then Z: Rz * Ry * Rx.
Mat3 rotation(const Vec3& angles);

/// ISO 230-1: the six errors of an axis, in the order of their names EX. EY. EZ. EA. EB. EC.
inline constexpr std::size_t component_count = 6;

/// One component error of an axis.
struct ComponentError {
  std::size_t component = 0;  ///< 0 .. 2 translation along X Y Z, mm; 3 .. 5 rotation about X Y Z, rad
  std::size_t source = 0;     ///< the axis whose position decides (X Y Z A .. W): mostly the axis itself,
                              ///< another one for deflection by a weight that moves
  ErrorFunction function;
};

struct AxisErrors {
  /// Where the component errors are measured, mm. Linear: a point of the carriage with every axis at zero.
  /// Rotary: its projection on the axis counts; without it, the point that the kinematic parameters name.
  std::optional<Vec3> reference_point;
  std::vector<ComponentError> errors;
  /// Location errors (ISO 230-1, ISO 230-7). Rotary: displacement of the axis XO. YO. ZO., mm, and its
  /// rotation AO. BO. CO., rad; the part along the axis is its zero position error, positive when the tool is
  /// turned too far in the positive direction. Linear: only the rotation, which turns the direction of the
  /// motion: squareness C0Y, A0Z, B0Z; positive C0Y and A0Z: the angle to X, to Y exceeds 90 degrees,
  /// positive B0Z: the angle between Z and X is less than 90 degrees.
  Vec3 displacement = Vec3::Zero(), inclination = Vec3::Zero();
};

/// Two drives that move one beam, which is rigid and turns about the foot of the master.
struct BeamErrors {
  std::size_t axis = 1;             ///< the linear axis they move
  Vec3 master_foot = Vec3::Zero();  ///< mm, with every axis at zero
  Vec3 slave_foot = Vec3::UnitX();  ///< apart from the master's across the axis
  double misalignment = 0;          ///< mm: the slave's foot ahead of the master's at equal positions
  ErrorFunction slave_error;        ///< mm: in addition, by the position of the axis
  double racking_frequency = 0;   ///< Hz: of one side while the other is held; 0 = no force between the sides
  double racking_damping = 0.05;  ///< ratio of that vibration
};

/// The order of the axes from the workpiece to the tool, and which of them carry the workpiece.
struct StructureAxis {
  std::size_t axis = 0;  ///< 0 .. 8: X Y Z A B C U V W
  bool workpiece = false;
};

struct GeometryErrors {
  /// Empty: the rotary axes of the table, X, Y and Z on the tool's side, then those of the head.
  std::vector<StructureAxis> structure;
  std::array<AxisErrors, axis_count> axes;
  /// The spindle relative to its carriage: displacement, mm, and inclination, rad, about the spindle face.
  AxisErrors spindle;
  std::optional<BeamErrors> beam;
  HeatSources heat;

  /// No error of any kind.
  bool ideal() const;
};

/// What decides where the tool is.
struct MachinePose {
  std::array<double, axis_count> positions{};  ///< X Y Z A B C U V W of the loads, mm or deg
  std::array<int, axis_count> approach{};      ///< sign of the newest motion; 0: not known
  double tool_length = 0;                      ///< mm
  double slave_lead = 0;  ///< mm: of a beam, position of the slave less that of the master
  Temperatures temperatures{};
};

struct ToolPose {
  Vec3 tip = Vec3::Zero();    ///< mm, in the workpiece frame of geometry::Chain
  Vec3 axis = Vec3::UnitZ();  ///< unit vector from the tip to the spindle
};

/// A pose and its derivatives by the positions of the axes, per mm or per rad, of X Y Z A B C U V W; zero for
/// axes that are not in the chain. The slopes of the errors are left out (they are of the order of 1e-4).
struct PoseDerivatives {
  ToolPose pose;
  std::array<Vec3, axis_count> tip, axis;
};

/// Evaluation of GeometryErrors. Pure, without allocation, the same bits on every host.
class ErrorModel {
 public:
  /// `design` is the chain the machine was built to. Otherwise one line that says what does not fit.
  static std::variant<ErrorModel, std::string> make(const geometry::ChainParameters& design,
                                                    const GeometryErrors& errors);

  /// Tip and axis of the tool relative to the workpiece.
  ToolPose pose(const MachinePose& machine) const;
  /// The same of the machine without errors; the bits of geometry::Chain.
  ToolPose ideal_pose(const MachinePose& machine) const;

  PoseDerivatives derivatives(const MachinePose& machine) const;

  const GeometryErrors& errors() const { return errors_; }
  /// The structure in the notation of ISO 10791, for example [w C' A' b X Y Z (S) t].
  std::string notation() const;

 private:
  struct Joint {
    std::size_t axis = 0;
    bool workpiece = false;
    bool rotary = false;
    Vec3 direction = Vec3::UnitZ();  // of the tool's motion as the workpiece sees it
    Vec3 pivot = Vec3::Zero();       // rotary: a point of the axis
    Vec3 reference = Vec3::Zero();   // of the component errors
    double zero = 0;                 // rotary: zero position error, deg
  };
  // Of points and of directions.
  struct Points {
    Vec3 tip, axis;
  };

  explicit ErrorModel(geometry::Chain chain) : chain_(std::move(chain)) {}
  std::string order(const geometry::ChainParameters& design);
  std::string place(const geometry::ChainParameters& design, Joint& joint) const;
  void apply_errors(const Joint& joint, const MachinePose& machine, Points& p) const;
  void apply_beam(const MachinePose& machine, Points& p) const;
  void apply_motion(const Joint& joint, double position, Points& p) const;
  void apply_joint(const Joint& joint, const MachinePose& machine, Points& p) const;
  Points tool(const MachinePose& machine) const;

  geometry::Chain chain_;
  GeometryErrors errors_;
  bool ideal_ = true;
  std::vector<Joint> joints_;  // workpiece to tool
  Vec3 face_ = Vec3::Zero();   // spindle face with every axis at zero
  Vec3 beam_axis_ = Vec3::UnitZ();
  double beam_span_ = 1;
};

}  // namespace trunnion::volumetric
