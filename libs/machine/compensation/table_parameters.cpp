// SPDX-License-Identifier: Apache-2.0
#include "compensation/table_parameters.hpp"

#include <algorithm>
#include <stdexcept>

#include "canonical/axes.hpp"
#include "machine/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::error_tables {
namespace {

using machine::number_text;
using machine::Parameters;

using canonical::axis_letters;
constexpr std::uint32_t last_value = 709999;

// The parameters of one table. Those that a kind does not have are null.
struct Slot {
  machine::IntegerParameter type;
  machine::NumericParameter start;
  machine::IntegerParameter points;
  machine::NumericParameter interval;
  machine::IntegerParameter modulo;
  machine::NumericParameter factor;
  machine::IntegerParameter table;
  const machine::IntegerParameter* axis = nullptr;         // reference axis
  const machine::IntegerParameter* compensated = nullptr;  // of an angle
  const machine::NumericParameter* point = nullptr;        // of an angle
};

const Slot pitch{parameter::pitch_type,     parameter::pitch_start,  parameter::pitch_points,
                 parameter::pitch_interval, parameter::pitch_modulo, parameter::pitch_override,
                 parameter::pitch_table};
const Slot straightness[] = {
    {parameter::straightness_first_type, parameter::straightness_first_start,
     parameter::straightness_first_points, parameter::straightness_first_interval,
     parameter::straightness_first_modulo, parameter::straightness_first_magnification,
     parameter::straightness_first_table, &parameter::straightness_first_axis},
    {parameter::straightness_second_type, parameter::straightness_second_start,
     parameter::straightness_second_points, parameter::straightness_second_interval,
     parameter::straightness_second_modulo, parameter::straightness_second_magnification,
     parameter::straightness_second_table, &parameter::straightness_second_axis}};
const Slot angle[] = {
    {parameter::angle_first_type, parameter::angle_first_start, parameter::angle_first_points,
     parameter::angle_first_interval, parameter::angle_first_modulo, parameter::angle_first_magnification,
     parameter::angle_first_table, &parameter::angle_first_axis, &parameter::angle_first_compensated,
     &parameter::angle_first_point},
    {parameter::angle_second_type, parameter::angle_second_start, parameter::angle_second_points,
     parameter::angle_second_interval, parameter::angle_second_modulo, parameter::angle_second_magnification,
     parameter::angle_second_table, &parameter::angle_second_axis, &parameter::angle_second_compensated,
     &parameter::angle_second_point}};
struct SquarenessSlot {
  machine::IntegerParameter enable, axis;
  machine::NumericParameter point, angle;
};
const SquarenessSlot squareness[] = {
    {parameter::squareness_first_enable, parameter::squareness_first_axis, parameter::squareness_first_point,
     parameter::squareness_first_angle},
    {parameter::squareness_second_enable, parameter::squareness_second_axis,
     parameter::squareness_second_point, parameter::squareness_second_angle}};

class Channel {
 public:
  Channel(const Parameters& p, std::uint16_t channel)
      : axes_(machine::channel_axes(p, channel)), channel_(channel) {}

  const machine::ChannelAxes& axes() const { return axes_; }
  std::uint16_t number(std::size_t letter, const std::string& table) const {
    const auto found = std::find(axes_.index.begin(), axes_.index.end(), letter);
    if (found == axes_.index.end())
      throw std::runtime_error("table " + table + ": channel " + std::to_string(channel_) + " has no axis " +
                               axis_letters[letter]);
    return axes_.number[static_cast<std::size_t>(found - axes_.index.begin())];
  }
  std::size_t letter(int number, const machine::ParameterKey& key, std::uint32_t a) const {
    const auto found = std::find(axes_.number.begin(), axes_.number.end(), number);
    if (found == axes_.number.end())
      throw std::runtime_error("parameter " + number_text(key.number(a)) + " (" + key.name + ") is " +
                               std::to_string(number) + ": channel " + std::to_string(channel_) +
                               " has no such axis");
    return axes_.index[static_cast<std::size_t>(found - axes_.number.begin())];
  }

 private:
  machine::ChannelAxes axes_;
  std::uint16_t channel_;
};

TextTable table_of(const Parameters& p, std::uint32_t a, const Slot& slot) {
  TextTable table;
  const bool both = p.integer(slot.type, a) == 2, modulo = p.integer(slot.modulo, a) == 1;
  table.direction = static_cast<Direction>((modulo ? 3 : 1) + (both ? 1 : 0));
  table.points = static_cast<std::size_t>(p.integer(slot.points, a));
  table.spacing = p.get(slot.interval, a);
  table.offset = table.spacing > 0 ? -p.get(slot.start, a) / table.spacing : 0;
  const auto first = static_cast<std::uint32_t>(p.integer(slot.table, a));
  const auto count = table.points * (both ? 2 : 1);
  if (first + count - 1 > last_value)
    throw std::runtime_error("parameter " + number_text(slot.table.number(a)) + " (" + slot.table.name +
                             ") is " + std::to_string(first) + ": " + std::to_string(count) +
                             " values end after " + std::to_string(last_value));
  for (std::uint32_t k = 0; k < count; ++k) table.values.push_back(p.get(slot.factor, a) * p.at(first + k));
  return table;
}

}  // namespace

std::map<std::uint32_t, machine::ParameterValue> parameters_of(const TextTables& tables,
                                                               const Parameters& machine,
                                                               std::uint16_t channel, std::uint32_t first) {
  std::map<std::uint32_t, machine::ParameterValue> out;
  const auto set = [&](const machine::ParameterKey& key, std::uint32_t a, double value) {
    out[key.number(a)] = {value, ""};
  };
  const Channel known(machine, channel);
  for (const auto a : known.axes().number) {
    set(pitch.type, a, 0);
    for (const auto& slot : straightness) set(slot.type, a, 0);
    for (const auto& slot : angle) set(slot.type, a, 0);
    for (const auto& slot : squareness) set(slot.enable, a, 0);
  }
  const auto free_slot = [&](auto& slots, const auto& type_of, std::uint32_t a, const std::string& table) {
    for (auto& slot : slots)
      if (out[type_of(slot).number(a)].value == 0) return &slot;
    throw std::runtime_error("table " + table + ": its axis has two tables of this kind already");
  };
  for (const auto& table : tables.tables) {
    const auto name = name_of(table);
    const auto moving = known.number(table.moving, name), compensated = known.number(table.compensated, name);
    const std::uint32_t a = table.arm ? known.number(*table.arm, name) : compensated;
    const auto type_of = [](const Slot& slot) { return slot.type; };
    const Slot* slot = &pitch;
    if (table.arm)
      slot = free_slot(angle, type_of, a, name);
    else if (moving != compensated)
      slot = free_slot(straightness, type_of, a, name);
    else if (out[pitch.type.number(a)].value != 0)
      throw std::runtime_error("table " + name + " is there twice");
    if (first + table.values.size() - 1 > last_value)
      throw std::runtime_error("table " + name + ": " + std::to_string(table.values.size()) +
                               " values from " + std::to_string(first) + " end after " +
                               std::to_string(last_value));
    set(slot->type, a, both_ways(table.direction) ? 2 : 1);
    set(slot->start, a, -table.offset * table.spacing);
    set(slot->points, a, static_cast<double>(table.points));
    set(slot->interval, a, table.spacing);
    set(slot->modulo, a, repeats(table.direction) ? 1 : 0);
    set(slot->factor, a, 1);
    set(slot->table, a, first);
    if (slot->axis != nullptr) set(*slot->axis, a, moving);
    if (slot->compensated != nullptr) set(*slot->compensated, a, compensated);
    if (slot->point != nullptr) set(*slot->point, a, table.reference);
    for (const double value : table.values) out[first++] = {value, ""};
  }
  for (const auto& one : tables.squareness) {
    const std::string name =
        std::string("squareness ") + axis_letters[one.moving] + "_" + axis_letters[one.compensated];
    const std::uint32_t a = known.number(one.compensated, name);
    const auto* slot = free_slot(
        squareness, [](const SquarenessSlot& s) { return s.enable; }, a, name);
    set(slot->enable, a, 1);
    set(slot->axis, a, known.number(one.moving, name));
    set(slot->point, a, 0);
    set(slot->angle, a, one.angle);
  }
  for (const auto& [number, value] : out)
    if (const auto refused = machine::Catalogue::instance().check(number, value.value, ""); !refused.empty())
      throw std::runtime_error(refused);
  return out;
}

TextTables tables_of(const Parameters& p, std::uint16_t channel) {
  TextTables found;
  const Channel known(p, channel);
  for (std::size_t i = 0; i < known.axes().number.size(); ++i) {
    const std::uint32_t a = known.axes().number[i];
    const std::size_t own = known.axes().index[i];
    const auto on = [&](const Slot& slot) {
      return p.integer(slot.type, a) != 0 && p.integer(slot.points, a) > 0;
    };
    if (on(pitch)) {
      found.tables.push_back(table_of(p, a, pitch));
      found.tables.back().moving = found.tables.back().compensated = own;
    }
    for (const auto& slot : straightness) {
      if (!on(slot)) continue;
      auto table = table_of(p, a, slot);
      table.moving = known.letter(p.integer(*slot.axis, a), *slot.axis, a);
      table.compensated = own;
      found.tables.push_back(std::move(table));
    }
    for (const auto& slot : angle) {
      if (!on(slot)) continue;
      auto table = table_of(p, a, slot);
      table.moving = known.letter(p.integer(*slot.axis, a), *slot.axis, a);
      table.compensated = known.letter(p.integer(*slot.compensated, a), *slot.compensated, a);
      table.arm = own;
      table.reference = p.get(*slot.point, a);
      found.tables.push_back(std::move(table));
    }
    for (const auto& slot : squareness)
      if (p.integer(slot.enable, a) != 0)
        found.squareness.push_back(
            {known.letter(p.integer(slot.axis, a), slot.axis, a), own, p.get(slot.angle, a)});
  }
  return found;
}

}  // namespace trunnion::error_tables
