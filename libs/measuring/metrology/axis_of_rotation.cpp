// SPDX-License-Identifier: Apache-2.0
#include "metrology/axis_of_rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"

namespace trunnion::metrology {
namespace {

constexpr std::size_t most_searched = 60;  // centres among which the widest triangle is searched

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / geometry::radians_per_degree;
}

// Centre of the circle through three points.
Vec3 circumcentre(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a, n = u.cross(v);
  return a + (u.squaredNorm() * v.cross(n) - v.squaredNorm() * u.cross(n)) / (2 * n.squaredNorm());
}

// How well the motion from centre to centre turns about `direction` in the sense of the angles: above zero
// for the right sense. Each pair votes by the sine of the angle between.
double sense(const std::vector<TurnedCentre>& centres, const Vec3& direction, const Vec3& centre) {
  double sum = 0;
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (std::size_t j = i + 1; j < std::min(centres.size(), i + most_searched); ++j) {
      const Vec3 a = centres[i].centre - centre, b = centres[j].centre - centre;
      sum += geometry::sine_cosine(centres[j].angle - centres[i].angle).sine * direction.dot(a.cross(b));
    }
  return sum;
}

}  // namespace

double least_triangle_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  if ((a - b).isZero(0) || (b - c).isZero(0) || (c - a).isZero(0)) return 0;
  return std::min(
      {degrees_between(b - a, c - a), degrees_between(a - b, c - b), degrees_between(a - c, b - c)});
}

std::variant<AxisFit, AxisError> fit_axis(const std::vector<TurnedCentre>& centres,
                                          const AxisLimits& limits) {
  const std::size_t n = centres.size();
  if (n < 3) return AxisError::too_few;
  double low = centres[0].angle, high = low;
  for (const auto& c : centres) {
    if (!c.centre.allFinite() || !std::isfinite(c.angle)) return AxisError::not_finite;
    low = std::min(low, c.angle), high = std::max(high, c.angle);
  }
  AxisFit fit;
  fit.swept_angle = high - low;
  std::array<std::size_t, 3> widest{};
  const std::size_t stride = (n + most_searched - 1) / most_searched;
  for (std::size_t i = 0; i < n; i += stride)
    for (std::size_t j = i + stride; j < n; j += stride)
      for (std::size_t k = j + stride; k < n; k += stride) {
        const double angle = least_triangle_angle(centres[i].centre, centres[j].centre, centres[k].centre);
        if (angle > fit.triangle_angle) fit.triangle_angle = angle, widest = {i, j, k};
      }
  if (!(fit.swept_angle >= limits.least_swept_angle - 1e-9)) return AxisError::swept_angle;
  if (!(fit.triangle_angle >= limits.least_triangle_angle) || !(fit.triangle_angle > 1e-6))
    return AxisError::triangle_angle;
  const Vec3 &a = centres[widest[0]].centre, &b = centres[widest[1]].centre, &c = centres[widest[2]].centre;
  fit.direction = (b - a).cross(c - a).normalized();
  fit.centre = circumcentre(a, b, c);
  fit.radius = (a - fit.centre).norm();
  // Unknowns: centre (3), tilt of the direction about two perpendicular vectors, radius.
  const auto rows = static_cast<Eigen::Index>(2 * n);
  Eigen::MatrixXd jacobian(rows, 6);
  Eigen::VectorXd deviations(rows);
  Vec3 across = Vec3::Zero(), other = Vec3::Zero();
  constexpr int most_steps = 50;
  for (int step = 0; step < most_steps; ++step) {
    across = fit.direction.unitOrthogonal();
    other = fit.direction.cross(across);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 arm = centres[i].centre - fit.centre;
      const double along = fit.direction.dot(arm);
      const Vec3 radial = arm - along * fit.direction, e = radial.normalized();
      const auto row = static_cast<Eigen::Index>(2 * i);
      deviations[row] = radial.norm() - fit.radius;
      deviations[row + 1] = along;
      jacobian.row(row) << -e.transpose(), -along * e.dot(across), -along * e.dot(other), -1;
      jacobian.row(row + 1) << -fit.direction.transpose(), arm.dot(across), arm.dot(other), 0;
    }
    Eigen::VectorXd change = geometry::least_squares(jacobian, -deviations);
    if (!change.allFinite()) return AxisError::triangle_angle;
    fit.centre += change.head<3>();
    fit.direction = (fit.direction + change[3] * across + change[4] * other).normalized();
    fit.radius += change[5];
    if (change.norm() <= 1e-13 * (1 + fit.radius + fit.centre.norm())) break;
  }
  if (!(fit.radius > 0)) return AxisError::triangle_angle;
  const double turning = sense(centres, fit.direction, fit.centre);
  if (std::abs(turning) <= 1e-9 * fit.radius * fit.radius) return AxisError::no_sense;
  if (turning < 0) fit.direction = -fit.direction;
  const Eigen::MatrixXd cofactor = (jacobian.transpose() * jacobian).inverse();
  fit.centre_cofactor = cofactor.topLeftCorner<3, 3>();
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << across, other;
  fit.direction_cofactor = tangents * cofactor.block<2, 2>(3, 3) * tangents.transpose();
  for (const auto& turned : centres) {
    const Vec3 arm = turned.centre - fit.centre;
    const double along = fit.direction.dot(arm);
    const Vec3 radial = arm - along * fit.direction;
    fit.residuals.emplace_back(along * fit.direction + (radial.norm() - fit.radius) * radial.normalized());
    fit.variance += fit.residuals.back().squaredNorm();
  }
  fit.freedom = 2 * n - 6;
  fit.variance = fit.freedom > 0 ? fit.variance / static_cast<double>(fit.freedom) : 0;
  return fit;
}

const char* to_string(AxisError error) {
  switch (error) {
    case AxisError::too_few:
      return "fewer than 3 centres";
    case AxisError::not_finite:
      return "a centre or an angle is not a finite number";
    case AxisError::triangle_angle:
      return "the triangle of the centres has too small an angle";
    case AxisError::swept_angle:
      return "the angle from the first to the last centre is too small";
    case AxisError::no_sense:
      return "the centres do not turn in the sense of the angles";
  }
  return "";
}

}  // namespace trunnion::metrology
