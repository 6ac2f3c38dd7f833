// SPDX-License-Identifier: Apache-2.0
#include "compensation/thermal.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {
namespace {

constexpr double per_thousand = 1e-3;  // of the slope table and its rate: mm per m

const TableParameters offset_table{parameter::thermal_type,
                                   parameter::thermal_offset_start,
                                   parameter::thermal_offset_points,
                                   parameter::thermal_offset_interval,
                                   nullptr,
                                   nullptr,
                                   parameter::thermal_offset_table};
const TableParameters slope_table{parameter::thermal_type,
                                  parameter::thermal_slope_start,
                                  parameter::thermal_slope_points,
                                  parameter::thermal_slope_interval,
                                  nullptr,
                                  nullptr,
                                  parameter::thermal_slope_table};

double value(TableReader& reader, const TableParameters& parameters, const machine::IntegerParameter& sensor,
             std::uint32_t axis) {
  const auto table = reader.read(parameters, axis, 1);
  const int number = reader.parameters().integer(sensor, axis);
  if (number < 0) refuse(sensor, axis, "must be the number of a sensor, 0 .. 15");
  return table.at(reader.parameters().get(parameter::temperature, 0, static_cast<std::uint32_t>(number)),
                  true);
}

}  // namespace

Thermal Thermal::read(TableReader& reader, std::uint32_t a) {
  const auto& p = reader.parameters();
  const int type = p.integer(parameter::thermal_type, a);
  Thermal thermal;
  thermal.enabled = type != 0;
  thermal.reference = p.get(parameter::thermal_reference, a);
  thermal.offset_rate = p.get(parameter::thermal_rate, a);
  thermal.slope_rate = thermal.offset_rate * per_thousand;
  if (type == 1 || type == 3)
    thermal.offset_target = value(reader, offset_table, parameter::thermal_offset_sensor, a);
  if (type == 2 || type == 3)
    thermal.slope_target = value(reader, slope_table, parameter::thermal_slope_sensor, a) * per_thousand;
  return thermal;
}

}  // namespace trunnion::compensation
