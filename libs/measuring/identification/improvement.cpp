// SPDX-License-Identifier: Apache-2.0
#include "identification/improvement.hpp"

#include <algorithm>

#include "geometry/angle.hpp"

namespace trunnion::identification {
namespace {

truth::Spread spread_of(std::vector<double> values) {
  truth::Spread spread;
  std::sort(values.begin(), values.end());
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  spread.percentile_95 = values[(values.size() * 95 + 99) / 100 - 1];
  spread.maximum = values.back();
  return spread;
}

}  // namespace

VolumetricErrors volumetric_errors(const truth::PoseReport& report, std::size_t count, std::uint64_t seed,
                                   bool about_mean) {
  std::vector<truth::Vec3> tips;
  std::vector<double> lengths, angles;
  truth::Vec3 mean = truth::Vec3::Zero();
  for (const auto& pose : report.random_poses(count, seed)) {
    const auto answer = report.at(pose);
    tips.push_back(answer.deviation.tip);
    mean += answer.deviation.tip / static_cast<double>(count);
    angles.push_back(
        geometry::angle_between(answer.actual.axis, truth::Vec3(answer.actual.axis - answer.deviation.axis)));
  }
  if (tips.empty()) return {};
  for (const auto& tip : tips) lengths.push_back((about_mean ? truth::Vec3(tip - mean) : tip).norm());
  return {spread_of(std::move(lengths)), spread_of(std::move(angles))};
}

}  // namespace trunnion::identification
