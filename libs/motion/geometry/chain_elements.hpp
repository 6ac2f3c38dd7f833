// SPDX-License-Identifier: Apache-2.0
// A kinematic chain as data: named elements in their order from the workpiece to the tool.
#pragma once

#include <string>
#include <vector>

#include "geometry/chain.hpp"

namespace trunnion::geometry {

enum class ElementKind : std::uint8_t {
  offset,      ///< a fixed vector of the machine's design
  correction,  ///< a fixed vector that a measurement of the kinematics writes; counts like an offset
  linear,      ///< X, Y or Z
  rotary,      ///< A, B, C, U, V or W; before the base it carries the workpiece, else the tool
  base,        ///< the machine's base; without it, the base is at the first linear axis
};

struct ChainElement {
  std::string name;
  ElementKind kind = ElementKind::offset;
  /// Offset and correction: mm, towards the tool, machine coordinates with every axis at zero. Linear: where
  /// the tool moves seen from the workpiece when the axis goes in the positive direction. Rotary: axis of
  /// rotation, signed by the sense in which a positive angle turns what the axis carries.
  Vec3 vector = Vec3::Zero();
  std::size_t axis = 0;  ///< linear: 0 = X .. 2 = Z; rotary: 0 = A .. 5 = W
};

struct ChainDescription {
  Vec3 tool_direction = Vec3::UnitZ();  ///< as in ChainParameters
  std::vector<ChainElement> elements;
  /// A closed chain ends at its start: tip = machine position with every axis at zero and a tool without
  /// length, for any sum of the vectors. The end of an open one is the sum of its vectors.
  bool closed = true;
};

/// The same machine in the form of the parameters: neighbouring offsets are added up, a correction keeps its
/// own vector. Errors: those of the order (two_bases, too_many_rotary, linear_missing) and of corrections
/// (two_corrections, idle_correction); Chain::make finds the others.
std::variant<ChainParameters, ChainError> parameters_of(const ChainDescription& description);

/// Names of the corrections by the place where ChainParameters have them; empty where there is none.
struct CorrectionNames {
  std::array<std::string, 3> table, head;  ///< of axis 2, 1, 0
  std::string base;                        ///< of base_correction
};
CorrectionNames correction_names(const ChainDescription& description);

}  // namespace trunnion::geometry
