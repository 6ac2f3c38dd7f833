// SPDX-License-Identifier: Apache-2.0
// Where the parts of a machine are: the rigid parts between its axes, from the base to the workpiece and from
// the base to the tool.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "compensation/error_model.hpp"
#include "machine/machine_outline.hpp"

namespace trunnion::collision {

using geometry::Mat3;
using geometry::Vec3;

/// X Y Z A B C U V W in machine coordinates, mm and deg.
using AxisPosition = std::array<double, 9>;

/// Travel of the axes X Y Z A .. W; an axis that is not present does not move.
using Travel = std::array<machine::AxisOutline, 9>;

/// "X10.000 Y-20.000 Z0.000 A30.000": the axes that are present.
std::string text_of(const AxisPosition& position, const Travel& travel);

/// A rotation and a translation: of a point as it is with every axis at zero to where it is.
struct Placement {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();  ///< mm
  Vec3 operator*(const Vec3& point) const { return rotation * point + translation; }
};

/// A rigid part: what `depth` axes of a side carry, counted from the base; 0: the base.
struct Link {
  bool workpiece = false;
  std::size_t depth = 0;
  bool operator==(const Link&) const = default;
};

/// An axis with its place when every axis is at zero.
struct Joint {
  std::size_t axis = 0;  ///< 0 .. 8: X Y Z A .. W
  bool rotary = false;
  Vec3 direction = Vec3::UnitZ();  ///< unit vector of the motion of what it carries
  Vec3 point = Vec3::Zero();       ///< rotary: of the axis, mm
};

/// The frame is the machine's with every axis at zero: the spindle face is at face(), the workpiece frame of
/// geometry::Chain is the machine's.
class MachineLinks {
 public:
  /// `structure` as in volumetric::GeometryErrors; empty: X, Y and Z carry the tool. An error is one line.
  static std::variant<MachineLinks, std::string> make(
      const geometry::ChainParameters& design, const std::vector<volumetric::StructureAxis>& structure = {});

  /// Axes of a side from the base outwards.
  const std::vector<Joint>& joints(bool workpiece) const { return workpiece ? workpiece_ : tool_; }
  /// What the axis carries; nothing when the machine has no such axis in its chain.
  std::optional<Link> carried_by(std::size_t axis) const;
  Link workpiece() const { return {true, workpiece_.size()}; }
  Link spindle() const { return {false, tool_.size()}; }
  const Vec3& face() const { return face_; }
  /// Unit vector from the tip to the spindle with every axis at zero.
  const Vec3& tool_direction() const { return tool_direction_; }
  /// "[w C' A' b X Y Z (S) t]"
  const std::string& notation() const { return notation_; }

  /// Of every depth of a side, 0 .. number of its axes.
  void place(const AxisPosition& position, bool workpiece, std::vector<Placement>& placements) const;

 private:
  std::vector<Joint> workpiece_, tool_;
  Vec3 face_ = Vec3::Zero(), tool_direction_ = Vec3::UnitZ();
  std::string notation_;
};

/// "spindle", "workpiece", "base" or the letter of the axis that carries it last.
std::string name_of(const MachineLinks& links, Link link);

}  // namespace trunnion::collision
