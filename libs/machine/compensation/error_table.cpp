// SPDX-License-Identifier: Apache-2.0
#include "compensation/error_table.hpp"

#include <algorithm>
#include <cmath>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"
#include "text/quantity.hpp"

namespace trunnion::compensation {
namespace {

constexpr std::uint32_t last_value = 709999;

}  // namespace

void refuse(const machine::ParameterKey& parameter, std::uint32_t unit, const std::string& text) {
  throw machine::KinematicsError(
      alarm::compensation_invalid,
      "parameter " + machine::number_text(parameter.number(unit)) + " (" + parameter.name + ") " + text);
}

double ErrorTable::at(double x, bool positive_direction) const {
  const auto& table = bidirectional && !positive_direction ? negative : positive;
  if (!enabled || table.empty()) return 0;
  double place = (x - start) / interval;
  const auto n = static_cast<double>(table.size());
  if (modulo) {
    place -= std::floor(place / n) * n;
    const auto i = std::min(static_cast<std::size_t>(place), table.size() - 1);
    const double next = table[(i + 1) % table.size()];
    return factor * (table[i] + (next - table[i]) * (place - static_cast<double>(i)));
  }
  if (place <= 0) return factor * table.front();
  if (place >= n - 1) return factor * table.back();
  const auto i = static_cast<std::size_t>(place);
  return factor * (table[i] + (table[i + 1] - table[i]) * (place - static_cast<double>(i)));
}

ErrorTable TableReader::read(const TableParameters& p, std::uint32_t a, int type) {
  ErrorTable table;
  const int points = parameters_.integer(p.points, a);
  table.enabled = type != 0 && points > 0;
  table.bidirectional = type == 2;
  table.modulo = p.modulo != nullptr && parameters_.integer(*p.modulo, a) == 1;
  table.start = parameters_.get(p.start, a);
  table.interval = parameters_.get(p.interval, a);
  table.factor = p.factor != nullptr ? parameters_.get(*p.factor, a) : 1;
  if (!table.enabled) return table;
  if (!(table.interval > 0)) refuse(p.interval, a, "must be above 0 for a table with values");
  const auto first = static_cast<std::uint32_t>(parameters_.integer(p.table, a));
  const std::uint32_t values = static_cast<std::uint32_t>(points) * (table.bidirectional ? 2u : 1u);
  if (first + values - 1 > last_value)
    refuse(p.table, a,
           "is " + std::to_string(first) + ": " + std::to_string(values) + " values end after " +
               std::to_string(last_value));
  count(values);
  for (std::uint32_t k = 0; k < values; ++k)
    (k < static_cast<std::uint32_t>(points) ? table.positive : table.negative)
        .push_back(parameters_.at(first + k));
  return table;
}

void TableReader::check_turns(const ErrorTable& table, const TableParameters& p, std::uint32_t number,
                              std::uint16_t over) const {
  const double period = table.interval * static_cast<double>(table.positive.size());
  if (!table.enabled || machine::holds_at_every_turn(parameters_, over, table.modulo, period)) return;
  refuse(*p.modulo, number,
         std::string("is ") + (table.modulo ? "1" : "0") + " and the table " + text::quantity(period, "deg") +
             " long; axis " + std::to_string(over) + " counts modulo 360 (parameter " +
             machine::number_text(parameter::rotary_way.number(over)) +
             "), so the table must repeat (1) after 360 deg or a whole part of it");
}

void TableReader::count(std::size_t values) {
  values_ += values;
  const int most = parameters_.integer(parameter::volumetric_values_maximum);
  if (values_ > static_cast<std::size_t>(most))
    refuse(parameter::volumetric_values_maximum, 0,
           "permits " + std::to_string(most) + " values in all tables of a channel; there are " +
               std::to_string(values_) + " or more");
}

}  // namespace trunnion::compensation
