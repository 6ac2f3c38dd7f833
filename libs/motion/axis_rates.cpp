#include "motion/axis_rates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trunnion::motion {
namespace {

using language::axis_count;

AxisValues rates_at(const PathSegment& segment, double s, const geometry::Chain* chain, double tool_length) {
  AxisValues rate = segment.derivative(s);
  if (chain == nullptr) return rate;
  const AxisValues at = segment.position(s);
  const geometry::Jacobian j =
      chain->jacobian({at[0], at[1], at[2]}, geometry::angles_of(at.data()), tool_length);
  const geometry::Vec3 linear =
      j.tip * geometry::Vec3(rate[0], rate[1], rate[2]) +
      j.angle * geometry::Vec3(rate[language::A], rate[language::B], rate[language::C]) +
      j.further_angle * geometry::Vec3(rate[language::U], rate[language::V], rate[language::W]);
  for (std::size_t i = 0; i < 3; ++i) rate[i] = linear[static_cast<Eigen::Index>(i)];
  return rate;
}

}  // namespace

AxisRates sample_rates(const PathSegment& segment, const geometry::Chain* chain, double tool_length) {
  AxisRates rates;
  const double length = segment.length();
  rates.at_start = rates_at(segment, 0, chain, tool_length);
  if (chain == nullptr && segment.curvature() == 0) {
    rates.at_end = rates.at_start;
    for (std::size_t i = 0; i < axis_count; ++i) rates.largest[i] = std::abs(rates.at_start[i]);
    return rates;
  }
  const double rotary = length * std::hypot(rates.at_start[language::A], rates.at_start[language::B],
                                            rates.at_start[language::C]);
  const double turning = segment.curvature() * length * (180.0 / std::numbers::pi);
  const int intervals = static_cast<int>(std::clamp(std::ceil(std::max(rotary / 2, turning / 6)), 2.0, 64.0));
  AxisValues before = rates.at_start;
  for (std::size_t i = 0; i < axis_count; ++i) rates.largest[i] = std::abs(before[i]);
  for (int k = 1; k <= intervals; ++k) {
    const AxisValues now = rates_at(segment, length * k / intervals, chain, tool_length);
    for (std::size_t i = 0; i < axis_count; ++i) {
      rates.largest[i] = std::max(rates.largest[i], std::abs(now[i]));
      rates.bend[i] = std::max(rates.bend[i], std::abs(now[i] - before[i]) * intervals / length);
    }
    before = now;
  }
  rates.at_end = before;
  return rates;
}

AxisValues machine_axes(const AxisValues& position, const geometry::Chain* chain, double tool_length) {
  AxisValues axes = position;
  if (chain == nullptr) return axes;
  const geometry::Vec3 machine = chain->machine_from_tip({position[0], position[1], position[2]},
                                                         geometry::angles_of(position.data()), tool_length);
  for (std::size_t i = 0; i < 3; ++i) axes[i] = machine[static_cast<Eigen::Index>(i)];
  return axes;
}

}  // namespace trunnion::motion
