// SPDX-License-Identifier: Apache-2.0
#include "compensation/error_function.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::volumetric {

void Table::finish() {
  const std::size_t n = positions.size();
  slopes.assign(n, 0.0);
  if (!cubic || n < 2) return;
  const auto secant = [&](std::size_t i, std::size_t j, double width) {
    return (values[j] - values[i]) / width;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const bool before = i > 0 || modulo > 0, after = i + 1 < n || modulo > 0;
    const std::size_t previous = i > 0 ? i - 1 : n - 1, next = i + 1 < n ? i + 1 : 0;
    const double left = i > 0 ? positions[i] - positions[previous] : positions[0] + modulo - positions[n - 1];
    const double right =
        i + 1 < n ? positions[next] - positions[i] : positions[0] + modulo - positions[n - 1];
    if (before && after)
      slopes[i] = (secant(previous, i, left) * right + secant(i, next, right) * left) / (left + right);
    else
      slopes[i] = before ? secant(previous, i, left) : secant(i, next, right);
  }
}

double Table::value(double x) const {
  const std::size_t n = positions.size();
  if (n == 0) return 0;
  if (n == 1) return values[0];
  if (modulo > 0) x -= modulo * std::floor((x - positions[0]) / modulo);
  const auto above =
      static_cast<std::size_t>(std::upper_bound(positions.begin(), positions.end(), x) - positions.begin());
  if (above == 0) return values[0];
  if (above == n && modulo <= 0) return values[n - 1];
  const std::size_t i = above - 1, j = above < n ? above : 0;
  const double width = (above < n ? positions[j] : positions[0] + modulo) - positions[i];
  const double u = (x - positions[i]) / width;
  if (!cubic) return values[i] + u * (values[j] - values[i]);
  // Hermite's form of the cubic with these values and derivatives at both ends.
  const double v = 1 - u;
  return v * v * ((1 + 2 * u) * values[i] + u * width * slopes[i]) +
         u * u * ((1 + 2 * v) * values[j] - v * width * slopes[j]);
}

double ErrorTerms::value(double x) const {
  double sum = 0;
  for (const Polynomial& polynomial : polynomials) {
    const double u = (x - polynomial.origin) / polynomial.unit;
    double value = 0;
    for (std::size_t k = polynomial.coefficients.size(); k-- > 0;)
      value = value * u + polynomial.coefficients[k];
    sum += value;
  }
  for (const Harmonic& harmonic : harmonics)
    sum += harmonic.amplitude * geometry::sine_cosine(360 * (x / harmonic.period) + harmonic.phase).sine;
  for (const Table& table : tables) sum += table.value(x);
  return sum;
}

double ErrorFunction::value(double x, int approach) const {
  double sum = terms.value(x);
  if (approach >= 0 && !positive.empty()) sum += (approach > 0 ? 1 : 0.5) * positive.value(x);
  if (approach <= 0 && !negative.empty()) sum += (approach < 0 ? 1 : 0.5) * negative.value(x);
  return sum + 0.5 * reversal * ((approach > 0) - (approach < 0));
}

}  // namespace trunnion::volumetric
