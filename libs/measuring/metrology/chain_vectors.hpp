// SPDX-License-Identifier: Apache-2.0
// The offset vectors of a chain one after the other from its root, their free components and the slots of
// geometry::ChainParameters.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "geometry/chain.hpp"

namespace trunnion::metrology {

using geometry::ChainParameters;
using geometry::Mat3;
using geometry::Vec3;

/// Where ChainParameters have a rotary axis.
enum class Slot : std::uint8_t { table_2, table_1, table_0, head_2, head_1, head_0 };
inline constexpr std::size_t slot_count = 6;
inline constexpr std::array<Slot, slot_count> all_slots{Slot::table_2, Slot::table_1, Slot::table_0,
                                                        Slot::head_2,  Slot::head_1,  Slot::head_0};

const std::optional<geometry::RotaryAxis>& axis_at(const ChainParameters& chain, Slot slot);
std::optional<geometry::RotaryAxis>& axis_at(ChainParameters& chain, Slot slot);
inline std::size_t index_of(Slot slot) { return static_cast<std::size_t>(slot); }
inline bool in_table(Slot slot) { return slot <= Slot::table_0; }

/// Of a machine, after the manual of CYCLE9960: which side its rotary axes are on.
enum class KinematicType : std::uint8_t { none, one_axis, table, head, mixed };
KinematicType kinematic_type(const ChainParameters& chain);
/// "P", "T", "M", "one rotary axis".
const char* to_string(KinematicType type);

/// One vector of the chain, counted from the root (the machine's base) outwards. Of the table: from the root
/// to its first axis, and from an axis to the next one towards the workpiece. Of the head: from an axis to
/// the next one towards the tool, of the last one to the spindle. Named after the rotary axis which it
/// places. mm, machine frame with every axis at zero.
struct RootVector {
  Slot slot = Slot::table_2;  ///< of the axis
  std::size_t angle = 0;      ///< of the axis: 0 = A .. 5 = W
  /// The vector is the sum of this times offset and correction of each slot.
  std::array<double, slot_count> share{};
};
std::vector<RootVector> root_vectors(const ChainParameters& chain);
Vec3 value_of(const RootVector& vector, const ChainParameters& chain);

/// A point of the axis of each slot, mm: of a table axis in machine coordinates of the workpiece frame, of a
/// head axis counted from the spindle face, both with every axis at zero.
Vec3 axis_point(const ChainParameters& chain, Slot slot);

/// What becomes of the component of an offset vector along its axis, which no measurement shows
/// (setting 55645 of the manual).
struct Normalization {
  int mode = 0;       ///< 0 least change of the vector; 1, 2, 3: X, Y, Z is `value`; 4, 5, 6: X, Y, Z is kept
  double value = 0;   ///< mm, of modes 1 .. 3
  bool open = false;  ///< tens digit 1: the chain is open
};

/// 0 .. 6, 10 .. 16. An error is one line with the limits.
std::variant<Normalization, std::string> normalization_of(int setting, double value);

/// `vector`, moved along `direction` (any length) until the component is as the normalization has it;
/// `active` is the vector in force. Nothing where the axis does not move the component (it is less than 1 %
/// of the direction).
std::optional<Vec3> normalized(const Vec3& vector, const Vec3& direction, const Normalization& normalization,
                               const Vec3& active);

}  // namespace trunnion::metrology
