// SPDX-License-Identifier: Apache-2.0
#include "compensation/angle.hpp"

#include "geometry/angle.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

double AngleCompensation::at(const double* x, double direction) const {
  const auto angle = geometry::sine_cosine(table.at(x[reference], direction >= 0));
  return (x[arm] - point) * (angle.sine / angle.cosine);
}

std::vector<AngleCompensation> read_angles(TableReader& reader, std::uint32_t a,
                                           const ChannelColumns& columns) {
  using namespace parameter;
  const struct {
    machine::IntegerParameter axis, compensated;
    machine::NumericParameter point;
    TableParameters table;
  } both[] = {{angle_first_axis,
               angle_first_compensated,
               angle_first_point,
               {angle_first_type, angle_first_start, angle_first_points, angle_first_interval,
                &angle_first_modulo, &angle_first_magnification, angle_first_table}},
              {angle_second_axis,
               angle_second_compensated,
               angle_second_point,
               {angle_second_type, angle_second_start, angle_second_points, angle_second_interval,
                &angle_second_modulo, &angle_second_magnification, angle_second_table}}};
  std::vector<AngleCompensation> found;
  const auto& p = reader.parameters();
  for (const auto& one : both) {
    auto values = reader.read(one.table, a);
    if (!values.enabled) continue;
    const auto reference = columns.of(p, one.axis, a);
    reader.check_turns(values, one.table, a, columns.numbers[reference]);
    const auto arm = std::find(columns.numbers.begin(), columns.numbers.end(), a) - columns.numbers.begin();
    found.push_back({reference, static_cast<std::size_t>(arm), columns.of(p, one.compensated, a),
                     p.get(one.point, a), std::move(values)});
  }
  return found;
}

}  // namespace trunnion::compensation
