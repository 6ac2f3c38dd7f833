// SPDX-License-Identifier: Apache-2.0
#include "motion/decimals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trunnion::motion {
namespace {

using canonical::axis_count;

// Coordinates are multiples of this, mm or degrees, or they are none.
constexpr double finest = 1e-6;
// Tolerances that a rounding may be.
constexpr double coarsest = 4;

// The changes of a line as multiples of the smallest decimal that counts, by their common divisor; 1 when
// they are none.
std::uint64_t divisor_of(const AxisValues& change, bool rotary) {
  std::uint64_t divisor = 0;
  for (std::size_t i = 0; i < axis_count; ++i) {
    if (canonical::is_rotary(i) != rotary || change[i] == 0) continue;
    const double steps = std::abs(change[i]) / finest, whole = std::round(steps);
    if (!(whole < 1e15) || std::abs(steps - whole) > 0.01) return 1;
    divisor = std::gcd(divisor, static_cast<std::uint64_t>(whole));
  }
  return divisor;
}

}  // namespace

void Decimals::begin(std::uint64_t number) {
  newest_ = number;
  if (number % group_size == 0) groups_[number / group_size % groups] = {};
}

void Decimals::add(const AxisValues& change) {
  Divisors& group = groups_[newest_ / group_size % groups];
  group.linear = std::gcd(group.linear, divisor_of(change, false));
  group.rotary = std::gcd(group.rotary, divisor_of(change, true));
}

Grain Decimals::about(std::uint64_t number, const BlendRules& rules) const {
  const std::uint64_t group = number / group_size, last = std::min(group + 1, newest_ / group_size);
  std::uint64_t linear = 0, rotary = 0;
  for (std::uint64_t k = group > 0 ? group - 1 : 0; k <= last; ++k) {
    linear = std::gcd(linear, groups_[k % groups].linear);
    rotary = std::gcd(rotary, groups_[k % groups].rotary);
  }
  const auto grain = [](std::uint64_t divisor, double tolerance) {
    const double step = finest * static_cast<double>(divisor);
    return step > coarsest * tolerance ? 0 : step;
  };
  return {grain(linear, rules.contour_tolerance), grain(rotary, rules.orientation_tolerance)};
}

}  // namespace trunnion::motion
