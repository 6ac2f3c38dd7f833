// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/ballbar_causes.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"
#include "geometry/decompositions.hpp"

namespace trunnion::circular_tests {
namespace {

enum Term { mean, centre_first, centre_second, scale, square, lag, back_first, back_second, terms };
using Row = Eigen::Matrix<double, 1, terms>;

int sign(double value) { return (value > 0) - (value < 0); }

// The deviation by each cause of size one.
Row closed_forms(double angle, int sense, double radius) {
  const auto [s, c] = geometry::sine_cosine(angle);
  // Signs of the motion of both axes; at a reversal none.
  const int first = -sense * (std::abs(s) < 1e-12 ? 0 : sign(s));
  const int second = sense * (std::abs(c) < 1e-12 ? 0 : sign(c));
  Row row;
  row[mean] = 1;
  row[centre_first] = c;
  row[centre_second] = s;
  row[scale] = 0.5 * radius * (c * c - s * s);
  row[square] = -radius * s * c;
  row[lag] = sense * s * c;
  row[back_first] = -0.5 * first * c;
  row[back_second] = -0.5 * second * s;
  return row;
}

double from_reversal(double angle) { return angle - 90 * std::round(angle / 90); }

// The farthest of the readings from the causes behind each reversal. A reading between the places before and
// behind the lost motion is on its way, and no spike.
std::array<double, 4> spikes(Readings readings, const Eigen::VectorXd& x, double radius, int sense) {
  std::array<double, 4> found{};
  for (const auto& reading : readings) {
    const double past = sense * from_reversal(reading.angle);
    if (past < 0 || past > spike_zone) continue;
    const auto quadrant =
        static_cast<std::size_t>(static_cast<long long>(std::round(reading.angle / 90)) & 3);
    const Row row = closed_forms(reading.angle, sense, radius);
    const auto axis = quadrant % 2 == 0 ? back_first : back_second;
    const double behind = reading.deviation - row * x, before = behind + 2 * row[axis] * x[axis];
    if ((behind > 0) != (before > 0)) continue;
    const double rest = std::abs(behind) < std::abs(before) ? behind : before;
    if (std::abs(rest) > std::abs(found[quadrant])) found[quadrant] = rest;
  }
  return found;
}

}  // namespace

BallbarCauses ballbar_causes(Readings ccw, Readings cw, double radius) {
  Eigen::Matrix<double, Eigen::Dynamic, terms> rows(static_cast<Eigen::Index>(ccw.size() + cw.size()),
                                                    int{terms});
  Eigen::VectorXd values(rows.rows()), weights(rows.rows());
  Eigen::Index row = 0;
  const auto add = [&](Readings readings, int sense) {
    for (const auto& reading : readings) {
      rows.row(row) = closed_forms(reading.angle, sense, radius);
      values(row) = reading.deviation;
      weights(row++) = std::abs(from_reversal(reading.angle)) < reversal_zone ? 0 : 1;
    }
  };
  add(ccw, 1);
  add(cw, -1);
  const Eigen::Matrix<double, terms, 1> x =
      geometry::least_squares(weights.asDiagonal() * rows, weights.cwiseProduct(values));
  BallbarCauses causes;
  causes.radius = x[mean];
  causes.centre_first = x[centre_first], causes.centre_second = x[centre_second];
  causes.scale_mismatch = x[scale];
  causes.squareness = x[square];
  causes.lag_mismatch = x[lag];
  causes.reversal_first = x[back_first], causes.reversal_second = x[back_second];
  const Eigen::VectorXd rests = values - rows * x;
  causes.spike_ccw = spikes(ccw, x, radius, 1);
  causes.spike_cw = spikes(cw, x, radius, -1);
  if (rests.size() > 0) causes.rest = rests.norm() / std::sqrt(static_cast<double>(rests.size()));
  return causes;
}

std::vector<CauseShare> cause_shares(const BallbarCauses& causes, double radius) {
  const auto largest_spike = [&](std::size_t axis) {
    double largest = 0;
    for (const auto* spikes : {&causes.spike_ccw, &causes.spike_cw})
      for (std::size_t q = axis; q < 4; q += 2) largest = std::max(largest, std::abs((*spikes)[q]));
    return largest;
  };
  // Spans of the closed forms: sin cos and (cos^2 - sin^2) / 2 go from -1/2 to 1/2, the sign of a speed times
  // cos from -1 to 1.
  std::vector<CauseShare> shares = {{"squareness", radius * std::abs(causes.squareness), 0},
                                    {"scale mismatch", radius * std::abs(causes.scale_mismatch), 0},
                                    {"servo mismatch", std::abs(causes.lag_mismatch), 0},
                                    {"lost motion 1", std::abs(causes.reversal_first), 0},
                                    {"lost motion 2", std::abs(causes.reversal_second), 0},
                                    {"spike 1", largest_spike(0), 0},
                                    {"spike 2", largest_spike(1), 0}};
  double sum = 0;
  for (const auto& share : shares) sum += share.span;
  for (auto& share : shares) share.share = sum > 0 ? share.span / sum : 0;
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.span > b.span; });
  return shares;
}

}  // namespace trunnion::circular_tests
