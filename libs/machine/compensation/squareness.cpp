// SPDX-License-Identifier: Apache-2.0
#include "compensation/squareness.hpp"

#include "geometry/angle.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

std::vector<Squareness> read_squareness(const machine::Parameters& p, std::uint32_t a,
                                        const ChannelColumns& columns) {
  using namespace parameter;
  const struct {
    machine::IntegerParameter enable, axis;
    machine::NumericParameter point, angle;
  } both[] = {
      {squareness_first_enable, squareness_first_axis, squareness_first_point, squareness_first_angle},
      {squareness_second_enable, squareness_second_axis, squareness_second_point, squareness_second_angle}};
  std::vector<Squareness> found;
  for (const auto& one : both) {
    if (p.integer(one.enable, a) == 0) continue;
    const auto angle = geometry::sine_cosine(p.get(one.angle, a));
    found.push_back({columns.of(p, one.axis, a), p.get(one.point, a), angle.sine / angle.cosine});
  }
  return found;
}

}  // namespace trunnion::compensation
