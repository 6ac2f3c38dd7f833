// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/test_picture.hpp"

namespace trunnion::servo_analysis {

Curve over_time(const std::string& name, const std::vector<double>& values, double interval, double unit) {
  Curve curve{name, {}};
  for (std::size_t i = 0; i < values.size(); ++i)
    curve.points.push_back({static_cast<double>(i) * interval, values[i] * unit});
  return curve;
}

std::vector<double> difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

}  // namespace trunnion::servo_analysis
