// SPDX-License-Identifier: Apache-2.0
#include "metrology/student.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::metrology {

double student_within(double t, std::size_t freedom) {
  const auto n = static_cast<double>(freedom);
  const double theta = std::atan(t / std::sqrt(n)), c = std::cos(theta), s = std::sin(theta);
  const bool odd = freedom % 2 == 1;
  double term = odd ? c : 1, sum = freedom == 1 ? 0 : term;
  for (std::size_t k = odd ? 3 : 2; k + 2 <= freedom; k += 2) {
    const auto d = static_cast<double>(k);
    term *= c * c * (d - 1) / d;
    sum += term;
  }
  return odd ? 2 / std::numbers::pi * (theta + s * sum) : s * sum;
}

double coverage_factor(double confidence, std::size_t values, std::size_t freedom) {
  const double within = 1 - (1 - confidence) / static_cast<double>(std::max<std::size_t>(values, 1));
  const auto probability = [&](double t) {
    return freedom == 0 ? std::erf(t / std::numbers::sqrt2)
                        : student_within(t, std::min<std::size_t>(freedom, 1000));
  };
  double low = 0, high = 1;
  while (probability(high) < within && high < 1e9) high *= 2;
  for (int i = 0; i < 100; ++i) (probability((low + high) / 2) < within ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

}  // namespace trunnion::metrology
