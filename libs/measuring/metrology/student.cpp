// SPDX-License-Identifier: Apache-2.0
#include "metrology/student.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace trunnion::metrology {

double coverage_factor(double confidence, std::size_t values, std::size_t freedom) {
  const double beyond = (1 - confidence) / static_cast<double>(std::max<std::size_t>(values, 1));
  const auto factor = [beyond](const auto& distribution) {
    return boost::math::quantile(boost::math::complement(distribution, beyond / 2));
  };
  return freedom == 0 ? factor(boost::math::normal())
                      : factor(boost::math::students_t(static_cast<double>(freedom)));
}

}  // namespace trunnion::metrology
