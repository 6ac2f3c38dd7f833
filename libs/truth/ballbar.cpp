// SPDX-License-Identifier: Apache-2.0
#include "truth/ballbar.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::truth {
namespace {

enum Term { mean, centre_first, centre_second, scale, square, lag, back_first, back_second, terms };

// deg: readings nearer to a reversal do not count in the fit. There an axis is still crossing its lost
// motion.
constexpr double reversal_zone = 3;

bool near_reversal(double angle) {
  const double beyond = angle - 90 * std::round(angle / 90);
  return std::abs(beyond) < reversal_zone;
}

int sign(double value) { return (value > 0) - (value < 0); }

}  // namespace

double ballbar_deviation(const BallbarPath& path, const Vec3& tip) {
  return (tip - path.centre).norm() - path.radius;
}

BallbarResult evaluate_ballbar(const BallbarPath& path, std::span<const BallbarReading> ccw,
                               std::span<const BallbarReading> cw) {
  Eigen::Matrix<double, Eigen::Dynamic, terms> rows(static_cast<Eigen::Index>(ccw.size() + cw.size()),
                                                    int{terms});
  Eigen::VectorXd values(rows.rows()), weights(rows.rows());
  Eigen::Index row = 0;
  const auto add = [&](std::span<const BallbarReading> readings, int sense) {
    for (const BallbarReading& reading : readings) {
      const auto [s, c] = geometry::sine_cosine(reading.angle);
      // Signs of the motion of both axes; at a reversal none.
      const int first = -sense * (std::abs(s) < 1e-12 ? 0 : sign(s));
      const int second = sense * (std::abs(c) < 1e-12 ? 0 : sign(c));
      rows(row, mean) = 1;
      rows(row, centre_first) = c;
      rows(row, centre_second) = s;
      rows(row, scale) = 0.5 * path.radius * (c * c - s * s);
      rows(row, square) = -path.radius * s * c;
      rows(row, lag) = sense * s * c;
      rows(row, back_first) = -0.5 * first * c;
      rows(row, back_second) = -0.5 * second * s;
      values(row) = reading.deviation;
      weights(row++) = near_reversal(reading.angle) ? 0 : 1;
    }
  };
  add(ccw, 1);
  add(cw, -1);
  const Eigen::Matrix<double, terms, 1> x =
      (weights.asDiagonal() * rows).colPivHouseholderQr().solve(weights.cwiseProduct(values));
  BallbarResult result;
  result.radius = x[mean];
  result.centre[static_cast<Eigen::Index>(path.first)] = x[centre_first];
  result.centre[static_cast<Eigen::Index>(path.second)] = x[centre_second];
  result.scale_mismatch = x[scale];
  result.squareness = x[square];
  result.lag_mismatch = x[lag];
  result.reversal_first = x[back_first];
  result.reversal_second = x[back_second];
  // Deviations without the setting of the instrument: its centre and its length.
  const Eigen::VectorXd centred = values - rows.leftCols<3>() * x.head<3>();
  const auto ccw_count = static_cast<Eigen::Index>(ccw.size()),
             cw_count = static_cast<Eigen::Index>(cw.size());
  const auto spread = [](const auto& part) {
    return part.size() == 0 ? 0 : part.maxCoeff() - part.minCoeff();
  };
  result.circular_ccw = spread(centred.head(ccw_count));
  result.circular_cw = spread(centred.tail(cw_count));
  result.bidirectional = spread(centred);
  result.radial_minimum = values.minCoeff();
  result.radial_maximum = values.maxCoeff();
  return result;
}

}  // namespace trunnion::truth
