// SPDX-License-Identifier: Apache-2.0
// The programmable axes of a channel, their values and the planes they span.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trunnion::canonical {

/// The nine programmable axes of a channel in the order of parameters 040001..040009 (ISO 841 letters).
enum Axis : std::uint8_t { X, Y, Z, A, B, C, U, V, W };
inline constexpr std::size_t axis_count = 9;
inline constexpr std::string_view axis_letters = "XYZABCUVW";

/// One value per axis: mm for X Y Z U V W, degrees for A B C. Axes a channel does not have stay 0.
using AxisValues = std::array<double, axis_count>;

/// Components along X Y Z.
using Vector3 = std::array<double, 3>;

constexpr bool is_rotary(std::size_t axis) { return axis == A || axis == B || axis == C; }

enum class Plane : std::uint8_t { xy, zx, yz };  // G17, G18, G19

/// Axes of a plane: an anticlockwise turn about `normal` goes from `first` to `second`.
struct PlaneAxes {
  std::uint8_t first;
  std::uint8_t second;
  std::uint8_t normal;
};

constexpr PlaneAxes plane_axes(Plane plane) {
  switch (plane) {
    case Plane::zx:
      return {Z, X, Y};
    case Plane::yz:
      return {Y, Z, X};
    case Plane::xy:
      break;
  }
  return {X, Y, Z};
}

}  // namespace trunnion::canonical
