// SPDX-License-Identifier: Apache-2.0
// The centre of a sphere from touches of a probe.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "geometry/types.hpp"

namespace trunnion::metrology {

using geometry::Mat3;
using geometry::Vec3;

struct SphereFit {
  Vec3 centre = Vec3::Zero();  ///< mm, in the frame of the touches
  double radius = 0;           ///< mm: that of the sphere and of the probe's ball together
  /// Covariance of the centre for touches of variance 1: times the variance of one touch it is in mm2.
  Mat3 cofactor = Mat3::Zero();
  double radius_cofactor = 0;  ///< the same of the radius; 0 when it was given
  double residual = 0;         ///< mm, root mean square of the distances of the touches from the sphere
  std::size_t freedom = 0;     ///< touches beyond what the unknowns need
};

enum class SphereError {
  too_few,     ///< fewer than 4 touches
  not_finite,  ///< a coordinate is infinite or not a number
  one_plane,   ///< the touches lie in one plane, or nearly
  no_sphere,   ///< the least squares do not converge
};

/// `tips`: the centre of the probe's ball at each touch, mm. Without `radius` centre and radius are unknown:
/// exact for 4 touches. With `radius` (mm, of sphere and ball together) only the centre is. More touches:
/// least squares of the distances from the sphere (orthogonal distance, Gauss-Newton).
std::variant<SphereFit, SphereError> fit_sphere(const std::vector<Vec3>& tips,
                                                std::optional<double> radius = std::nullopt);

/// The meaning of `error`, in words.
const char* to_string(SphereError error);

}  // namespace trunnion::metrology
