// SPDX-License-Identifier: Apache-2.0
#include "compensation/model_parameters.hpp"

#include "compensation/structure.hpp"
#include "geometry/angle.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/axes.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/parameter_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::volumetric {
namespace {

using geometry::radians_per_degree;
using machine::number_text;

enum Direction { unidirectional = 1, bidirectional = 2, modulo = 3, bidirectional_modulo = 4 };

constexpr std::uint32_t first_value = 700000, value_count = 10000;

[[noreturn]] void fail(const std::string& text) {
  throw machine::KinematicsError(alarm::compensation_invalid, text);
}

Vec3 vector(const machine::Parameters& p, const machine::NumericParameter& parameter, std::uint32_t unit) {
  return {p.get(parameter, unit, 0), p.get(parameter, unit, 1), p.get(parameter, unit, 2)};
}

std::optional<AxisTables> tables_of(const machine::Parameters& p, std::uint32_t a) {
  const int points = p.integer(parameter::volumetric_points, a);
  if (points == 0) return std::nullopt;
  const int direction = p.integer(parameter::volumetric_direction, a);
  AxisTables tables;
  tables.start = p.get(parameter::volumetric_start, a);
  tables.interval = p.get(parameter::volumetric_interval, a);
  tables.points = static_cast<std::size_t>(points);
  tables.bidirectional = direction == bidirectional || direction == bidirectional_modulo;
  tables.modulo = direction == modulo || direction == bidirectional_modulo;
  if (!machine::holds_at_every_turn(p, static_cast<std::uint16_t>(a), tables.modulo,
                                    points * tables.interval))
    fail("parameter " + number_text(parameter::volumetric_direction.number(a)) +
         " (volumetric_direction) is " + std::to_string(direction) + " and the table " +
         text::quantity(points * tables.interval, "deg") + " long; axis " + std::to_string(a) +
         " counts modulo 360 (parameter " + number_text(parameter::rotary_way.number(a)) +
         "), so the table must repeat (3 or 4) after 360 deg or a whole part of it");
  auto number = static_cast<std::uint32_t>(p.integer(parameter::volumetric_table, a));
  const auto values = static_cast<std::uint32_t>(points) * component_count * (tables.bidirectional ? 2u : 1u);
  if (number + values > first_value + value_count)
    fail("parameter " + number_text(parameter::volumetric_table.number(a)) +
         " (volumetric_table): " + std::to_string(values) + " values from " + number_text(number) +
         " end after " + number_text(first_value + value_count - 1));
  for (std::size_t c = 0; c < component_count; ++c)
    for (auto* side : {&tables.positive[c], &tables.negative[c]}) {
      if (side == &tables.negative[c] && !tables.bidirectional) continue;
      for (std::size_t i = 0; i < tables.points; ++i)
        side->push_back(p.at(number++) * (c < 3 ? 1 : radians_per_degree));
    }
  return tables;
}

bool zero(const std::vector<double>& values) {
  for (const double value : values)
    if (value != 0) return false;
  return true;
}

}  // namespace

std::vector<ComponentError> errors_of(const AxisTables& tables, std::size_t axis) {
  std::vector<ComponentError> errors;
  for (std::size_t c = 0; c < component_count; ++c) {
    const auto table = [&](const std::vector<double>& values) {
      ErrorTerms terms;
      if (values.empty() || zero(values)) return terms;
      Table made;
      for (std::size_t i = 0; i < values.size(); ++i)
        made.positions.push_back(tables.start + static_cast<double>(i) * tables.interval);
      made.values = values;
      made.modulo = tables.modulo ? static_cast<double>(values.size()) * tables.interval : 0;
      made.cubic = true;
      terms.tables.push_back(std::move(made));
      return terms;
    };
    ComponentError error{c, axis, {}};
    if (tables.bidirectional)
      error.function.positive = table(tables.positive[c]),
      error.function.negative = table(tables.negative[c]);
    else
      error.function.terms = table(tables.positive[c]);
    if (!error.function.terms.empty() || !error.function.positive.empty() || !error.function.negative.empty())
      errors.push_back(std::move(error));
  }
  return errors;
}

GeometryErrors errors_of(const machine::Parameters& p, std::uint16_t channel) {
  GeometryErrors errors;
  if (const auto text = p.text(parameter::volumetric_structure, channel); !text.empty()) {
    auto structure = parse_structure(text);
    if (const auto* refused = std::get_if<std::string>(&structure))
      fail("parameter " + number_text(parameter::volumetric_structure.number(channel)) +
           " (volumetric_structure): " + *refused);
    errors.structure = std::get<std::vector<StructureAxis>>(std::move(structure));
  }
  const auto axes = machine::channel_axes(p, channel);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const std::uint32_t a = axes.number[i];
    const std::size_t index = axes.index[i];
    AxisErrors& axis = errors.axes[index];
    axis.displacement = vector(p, parameter::volumetric_displacement, a);
    axis.inclination = vector(p, parameter::volumetric_inclination, a) * radians_per_degree;
    if (index < 3) axis.reference_point = vector(p, parameter::volumetric_reference, a);
    if (const auto tables = tables_of(p, a)) axis.errors = errors_of(*tables, index);
  }
  for (std::uint32_t i = 0; i < 2; ++i)
    errors.spindle.inclination[i] =
        p.get(parameter::volumetric_spindle_inclination, channel, i) * radians_per_degree;
  return errors;
}

std::optional<VolumetricCompensation> compensation_of(const machine::Parameters& p, std::uint16_t channel) {
  const int type = p.integer(parameter::volumetric_type, channel);
  if (type == 0) return std::nullopt;
  const auto number = number_text(parameter::volumetric_type.number(channel));
  const auto axes = machine::channel_axes(p, channel);
  if (axes.letters.find("XYZ") == std::string::npos)
    fail("parameter " + number + " (volumetric_type): channel " + std::to_string(channel) +
         " needs the axes X, Y and Z, it has " + axes.letters);
  auto made = VolumetricCompensation::make(machine::chain_parameters(p, channel), errors_of(p, channel),
                                           {type == 2, p.get(parameter::volumetric_damping, channel) * 1e-3});
  if (const auto* refused = std::get_if<std::string>(&made))
    fail("parameter " + number + " (volumetric_type): channel " + std::to_string(channel) + ": " + *refused);
  return std::get<VolumetricCompensation>(std::move(made));
}

std::map<std::uint32_t, machine::ParameterValue> parameters_of(
    const machine::Parameters& machine, std::uint16_t channel, const GeometryErrors& location,
    const std::map<std::size_t, AxisTables>& tables, std::uint32_t first) {
  std::map<std::uint32_t, machine::ParameterValue> out;
  const auto set = [&](std::uint32_t number, double value) { out[number] = {value, ""}; };
  const auto axes = machine::channel_axes(machine, channel);
  for (std::size_t i = 0; i < axes.index.size(); ++i) {
    const std::uint32_t a = axes.number[i];
    const AxisErrors& axis = location.axes[axes.index[i]];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      set(parameter::volumetric_displacement.number(a, k), axis.displacement[row]);
      set(parameter::volumetric_inclination.number(a, k), axis.inclination[row] / radians_per_degree);
      set(parameter::volumetric_reference.number(a, k),
          axes.index[i] < 3 && axis.reference_point ? (*axis.reference_point)[row] : 0);
    }
    const auto found = tables.find(axes.index[i]);
    set(parameter::volumetric_points.number(a),
        found == tables.end() ? 0 : static_cast<double>(found->second.points));
    if (found == tables.end()) continue;
    const AxisTables& t = found->second;
    set(parameter::volumetric_start.number(a), t.start);
    set(parameter::volumetric_interval.number(a), t.interval);
    set(parameter::volumetric_direction.number(a), (t.modulo ? 3 : 1) + (t.bidirectional ? 1 : 0));
    set(parameter::volumetric_table.number(a), first);
    for (std::size_t c = 0; c < component_count; ++c)
      for (const auto* side : {&t.positive[c], &t.negative[c]}) {
        if (side == &t.negative[c] && !t.bidirectional) continue;
        if (first + t.points > first_value + value_count)
          fail("the tables need more than the " + std::to_string(value_count) + " values of parameters " +
               number_text(first_value) + " .. " + number_text(first_value + value_count - 1));
        for (const double value : *side) set(first++, value / (c < 3 ? 1 : radians_per_degree));
      }
  }
  for (std::uint32_t k = 0; k < 2; ++k)
    set(parameter::volumetric_spindle_inclination.number(channel, k),
        location.spindle.inclination[static_cast<Eigen::Index>(k)] / radians_per_degree);
  return out;
}

}  // namespace trunnion::volumetric
