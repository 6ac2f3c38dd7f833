// SPDX-License-Identifier: Apache-2.0
#include "truth/position_accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trunnion::truth {
namespace {

struct Runs {
  double mean = 0, deviation = 0;  // the estimator of the standard uncertainty
};

Runs runs_of(const std::vector<double>& values) {
  if (values.size() < 2) throw std::invalid_argument("a target needs two runs or more in each direction");
  Runs runs;
  const auto n = static_cast<double>(values.size());
  for (const double value : values) runs.mean += value / n;
  for (const double value : values) runs.deviation += (value - runs.mean) * (value - runs.mean);
  runs.deviation = std::sqrt(runs.deviation / (n - 1));
  return runs;
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) { low = std::min(low, value), high = std::max(high, value); }
  double span() const { return high - low; }
};

}  // namespace

PositionAccuracy position_accuracy(const std::vector<TargetDeviations>& targets) {
  if (targets.empty()) throw std::invalid_argument("no targets");
  PositionAccuracy a;
  Range means, systematic, all;
  for (const auto& target : targets) {
    const Runs up = runs_of(target.up), down = runs_of(target.down);
    const double b = up.mean - down.mean;
    a.reversal = std::max(a.reversal, std::abs(b));
    a.mean_reversal += b / static_cast<double>(targets.size());
    a.repeatability = std::max({a.repeatability, 2 * up.deviation + 2 * down.deviation + std::abs(b),
                                4 * up.deviation, 4 * down.deviation});
    means.add((up.mean + down.mean) / 2);
    for (const Runs& runs : {up, down}) {
      systematic.add(runs.mean);
      all.add(runs.mean + 2 * runs.deviation);
      all.add(runs.mean - 2 * runs.deviation);
    }
  }
  a.mean_bidirectional = means.span();
  a.systematic = systematic.span();
  a.accuracy = all.span();
  return a;
}

}  // namespace trunnion::truth
