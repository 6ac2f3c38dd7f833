#include "motion/axis_motion.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {
namespace {

using geometry::Angles;
using geometry::Vec3;

Vec3 tip_of(const AxisValues& v) { return {v[0], v[1], v[2]}; }
Angles angles_of(const AxisValues& v) { return {v[language::A], v[language::B], v[language::C]}; }

}  // namespace

AxisValues machine_axes(const AxisValues& position, const geometry::Chain* chain, double tool_length) {
  AxisValues axes = position;
  if (chain == nullptr) return axes;
  const Vec3 machine = chain->machine_from_tip(tip_of(position), angles_of(position), tool_length);
  std::copy_n(machine.data(), 3, axes.begin());
  return axes;
}

// The highest derivatives enter linearly through the Jacobian; what the lower ones contribute is differenced along
// the parabola they make, which is smooth and short against a turn of the axes.
PathRates machine_rates(const AxisValues& position, const PathRates& rates, const geometry::Chain* chain,
                        double tool_length) {
  PathRates result = rates;
  if (chain == nullptr) return result;
  const geometry::Jacobian j = chain->jacobian(tip_of(position), angles_of(position), tool_length);
  const auto linear = [&](const AxisValues& d) -> Vec3 {
    return j.tip * tip_of(d) + j.angle * Vec3(d[language::A], d[language::B], d[language::C]);
  };
  const Vec3 first = linear(rates[0]);
  const auto stands = [&](std::size_t i) {
    return rates[0][i] == 0 && rates[1][i] == 0 && rates[2][i] == 0;
  };
  if (stands(language::A) && stands(language::B) && stands(language::C)) {
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 moved = j.tip * tip_of(rates[n]);
      std::copy_n(moved.data(), 3, result[n].begin());
    }
    return result;
  }
  const double turn = std::hypot(rates[0][language::A], rates[0][language::B], rates[0][language::C]);
  const double turn_2 = std::sqrt(std::hypot(rates[1][language::A], rates[1][language::B], rates[1][language::C]));
  const double h = 1.5 / std::max({turn, turn_2, 0.05});  // about 1.5 degrees
  const auto place = [&](double s) -> Vec3 {
    AxisValues p{};
    for (std::size_t i = 0; i < 6; ++i) p[i] = position[i] + s * (rates[0][i] + s / 2 * rates[1][i]);
    return chain->machine_from_tip(tip_of(p), angles_of(p), tool_length);
  };
  const Vec3 m2 = place(-2 * h), m1 = place(-h), c = place(0), p1 = place(h), p2 = place(2 * h);
  const Vec3 second = (-p2 + 16 * p1 - 30 * c + 16 * m1 - m2) / (12 * h * h);
  const Vec3 third = (p2 - 2 * p1 + 2 * m1 - m2) / (2 * h * h * h) + linear(rates[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    result[0][i] = first[k];
    result[1][i] = second[k];
    result[2][i] = third[k];
  }
  return result;
}

}  // namespace trunnion::motion
