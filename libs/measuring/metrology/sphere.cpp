// SPDX-License-Identifier: Apache-2.0
#include "metrology/sphere.hpp"

#include <Eigen/LU>
#include <cmath>

#include "geometry/decompositions.hpp"

namespace trunnion::metrology {
namespace {

// Of the directions from the centre to the touches: below it one direction is hardly seen.
constexpr double least_singular_value = 1e-4;

}  // namespace

std::variant<SphereFit, SphereError> fit_sphere(const std::vector<Vec3>& tips, std::optional<double> radius) {
  if (tips.size() < 4) return SphereError::too_few;
  Vec3 mean = Vec3::Zero();
  for (const auto& tip : tips) {
    if (!tip.allFinite()) return SphereError::not_finite;
    mean += tip / static_cast<double>(tips.size());
  }
  if (radius && !(*radius > 0 && std::isfinite(*radius))) return SphereError::not_finite;
  const auto rows = static_cast<Eigen::Index>(tips.size());
  // |p|^2 = 2 c.p + (r^2 - |c|^2) is linear; in units of the touches' spread.
  double spread = 0;
  for (const auto& tip : tips) spread = std::max(spread, (tip - mean).norm());
  if (!(spread > 0)) return SphereError::one_plane;
  Eigen::MatrixX4d linear(rows, 4);
  Eigen::VectorXd squares(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Vec3 p = (tips[static_cast<std::size_t>(i)] - mean) / spread;
    linear.row(i) << 2 * p.transpose(), 1;
    squares[i] = p.squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(linear, Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (!(svd.singularValues()[3] > least_singular_value * svd.singularValues()[0]))
    return SphereError::one_plane;
  const Eigen::Vector4d start = svd.solve(squares);
  SphereFit fit;
  fit.centre = mean + spread * start.head<3>();
  fit.radius = radius.value_or(spread * std::sqrt(std::max(0.0, start[3] + start.head<3>().squaredNorm())));
  const Eigen::Index unknowns = radius ? 3 : 4;
  Eigen::MatrixXd jacobian(rows, unknowns);
  Eigen::VectorXd distances(rows);
  constexpr int most_steps = 50;
  for (int step = 0;; ++step) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const Vec3 arm = tips[static_cast<std::size_t>(i)] - fit.centre;
      const double length = arm.norm();
      if (!(length > 0)) return SphereError::no_sphere;
      distances[i] = length - fit.radius;
      jacobian.row(i).head<3>() = -arm.transpose() / length;
      if (!radius) jacobian(i, 3) = -1;
    }
    const Eigen::VectorXd change = geometry::least_squares(jacobian, distances);
    if (!change.allFinite() || step > most_steps) return SphereError::no_sphere;
    fit.centre -= change.head<3>();
    if (!radius) fit.radius -= change[3];
    if (change.norm() <= 1e-12 * (spread + fit.centre.norm())) break;
  }
  if (!(fit.radius > 0)) return SphereError::no_sphere;
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd cofactor = normal.inverse();
  if (!cofactor.allFinite()) return SphereError::one_plane;
  fit.cofactor = cofactor.topLeftCorner<3, 3>();
  fit.radius_cofactor = radius ? 0 : cofactor(3, 3);
  fit.residual = distances.norm() / std::sqrt(static_cast<double>(rows));
  fit.freedom = tips.size() - static_cast<std::size_t>(unknowns);
  return fit;
}

const char* to_string(SphereError error) {
  switch (error) {
    case SphereError::too_few:
      return "fewer than 4 touches";
    case SphereError::not_finite:
      return "a touch or the radius is not a finite number";
    case SphereError::one_plane:
      return "the touches lie in one plane";
    case SphereError::no_sphere:
      return "the touches do not lie on a sphere";
  }
  return "";
}

}  // namespace trunnion::metrology
