// SPDX-License-Identifier: Apache-2.0
#include "machine/kinematics.hpp"

#include <array>
#include <cmath>

#include "machine/alarm_constants.hpp"
#include "machine/axes.hpp"
#include "machine/chain_parameters.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

using geometry::ChainError;
using geometry::Vec3;

// The parameters of one side of the chain, its slots beginning with the one next to the tool or the
// workpiece.
struct Side {
  IntegerParameter type;
  std::array<RealParameter, 3> direction, offset, correction;
  std::array<TextParameter, 3> correction_name;
};
constexpr std::size_t slots = 3;
constexpr Side head{
    parameter::head_type,
    {parameter::head_direction_2, parameter::head_direction_1, parameter::head_direction_0},
    {parameter::head_offset_2, parameter::head_offset_1, parameter::head_offset_0},
    {parameter::head_correction_2, parameter::head_correction_1, parameter::head_correction_0},
    {parameter::head_correction_name_2, parameter::head_correction_name_1,
     parameter::head_correction_name_0}};
constexpr Side table{
    parameter::table_type,
    {parameter::table_direction_2, parameter::table_direction_1, parameter::table_direction_0},
    {parameter::table_offset_2, parameter::table_offset_1, parameter::table_offset_0},
    {parameter::table_correction_2, parameter::table_correction_1, parameter::table_correction_0},
    {parameter::table_correction_name_2, parameter::table_correction_name_1,
     parameter::table_correction_name_0}};

Vec3 vector(const Parameters& parameters, const RealParameter& parameter, std::uint16_t channel,
            std::uint32_t first = 0) {
  return {parameters.get(parameter, channel, first), parameters.get(parameter, channel, first + 1),
          parameters.get(parameter, channel, first + 2)};
}

std::string number_of(const ParameterKey& parameter, std::uint16_t channel, std::uint32_t index = 0) {
  return number_text(parameter.number(channel, index));
}

[[noreturn]] void fail_type(const Side& side, std::uint16_t channel, const std::string& what) {
  std::string text = "parameter ";
  text.append(number_of(side.type, channel)).append(" (").append(side.type.name).append("): ").append(what);
  throw KinematicsError(alarm::kinematics_invalid, text);
}

// Digits of a structure type, the last one first: one for each slot in use.
std::vector<int> digits_of(const Parameters& parameters, const Side& side, std::uint16_t channel) {
  std::vector<int> digits;
  for (int type = parameters.integer(side.type, channel); type > 0; type /= 10) digits.push_back(type % 10);
  if (digits.size() > slots) fail_type(side, channel, "more than three rotary axes");
  return digits;
}

void read_side(const Parameters& parameters, const Side& side, std::uint16_t channel,
               std::array<std::optional<geometry::RotaryAxis>*, 3> axes) {
  const auto digits = digits_of(parameters, side, channel);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] < 3 || digits[i] > 8)
      fail_type(side, channel,
                "digit " + std::to_string(digits[i]) + " is not 3 (A), 4 (B), 5 (C), 6 (U), 7 (V) or 8 (W)");
    *axes[i] = {vector(parameters, side.direction[i], channel), vector(parameters, side.offset[i], channel),
                static_cast<std::size_t>(digits[i] - 3), vector(parameters, side.correction[i], channel)};
  }
}

const AlarmDefinition& alarm_about(ChainError error) {
  switch (error) {
    case ChainError::not_finite:
      return alarm::kinematics_not_finite;
    case ChainError::zero_direction:
      return alarm::kinematics_zero_direction;
    case ChainError::parallel_axes:
      return alarm::kinematics_parallel_axes;
    default:
      return alarm::kinematics_invalid;
  }
}

// The parameter of every direction vector in use, and the index of its X.
template <class Visit>
void visit_directions(const Parameters& parameters, std::uint16_t channel, Visit&& visit) {
  visit(parameter::tool_direction, 0u);
  for (const Side* side : {&head, &table}) {
    const auto count = digits_of(parameters, *side, channel).size();
    for (std::size_t i = 0; i < count; ++i) visit(side->direction[i], 0u);
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) visit(parameter::linear_direction, axis * 3);
}

}  // namespace

std::string to_string(ChainError error) {
  switch (error) {
    case ChainError::not_finite:
      return "a value is not finite";
    case ChainError::zero_direction:
      return "the direction of an axis is zero";
    case ChainError::bad_angle:
      return "a rotary axis is not A, B, C, U, V or W";
    case ChainError::shared_angle:
      return "two rotary axes have the same letter";
    case ChainError::parallel_axes:
      return "the rotary axes are parallel";
    case ChainError::dependent_linear:
      return "the directions of X, Y and Z lie in one plane";
    case ChainError::bad_carrier:
      return "a linear axis is carried by more rotary axes than its side has";
    case ChainError::too_many_rotary:
      return "more than three rotary axes on one side";
    case ChainError::two_corrections:
      return "two corrections with no rotary axis between them: one does the same";
    case ChainError::idle_correction:
      return "a correction between table and head of a closed chain does nothing";
    case ChainError::linear_missing:
      return "each of X, Y and Z must be there once";
    case ChainError::two_bases:
      return "more than one base";
  }
  return "";
}

const AlarmDefinition& alarm_of(const std::exception& error) {
  const auto* kinematics = dynamic_cast<const KinematicsError*>(&error);
  return kinematics != nullptr ? kinematics->alarm() : alarm::kinematics_invalid;
}

geometry::ChainParameters chain_parameters(const Parameters& parameters, std::uint16_t channel) {
  geometry::ChainParameters p;
  p.tool_direction = vector(parameters, parameter::tool_direction, channel);
  read_side(parameters, head, channel, {&p.head_2, &p.head_1, &p.head_0});
  read_side(parameters, table, channel, {&p.table_2, &p.table_1, &p.table_0});
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    p.linear_direction.col(axis) = vector(parameters, parameter::linear_direction, channel, axis * 3);
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    p.linear_carriers[axis] = parameters.integer(parameter::linear_carriers, channel, axis);
  p.origin = vector(parameters, parameter::chain_origin, channel);
  p.open = parameters.integer(parameter::chain_open, channel) != 0;
  p.base_correction = vector(parameters, parameter::base_correction, channel);
  return p;
}

geometry::Chain make_chain(const Parameters& parameters, std::uint16_t channel) {
  auto made = geometry::Chain::make(chain_parameters(parameters, channel));
  if (const auto* error = std::get_if<ChainError>(&made)) {
    std::string where = number_of(parameter::tool_direction, channel) + " .. " +
                        number_of(parameter::table_offset_2, channel, 2);
    // One vector can be named.
    if (*error == ChainError::zero_direction)
      visit_directions(parameters, channel, [&](const RealParameter& direction, std::uint32_t first) {
        if (vector(parameters, direction, channel, first).isZero(0))
          where = number_of(direction, channel, first) + " .. " + number_of(direction, channel, first + 2);
      });
    if (*error == ChainError::bad_carrier)
      where = number_of(parameter::linear_carriers, channel) + " .. " +
              number_of(parameter::linear_carriers, channel, 2);
    throw KinematicsError(alarm_about(*error), "channel " + std::to_string(channel) + ", parameters " +
                                                   where + ": " + to_string(*error));
  }
  return std::get<geometry::Chain>(std::move(made));
}

std::vector<std::string> kinematics_warnings(const Parameters& parameters, std::uint16_t channel) {
  std::vector<std::string> lines;
  visit_directions(parameters, channel, [&](const RealParameter& direction, std::uint32_t first) {
    const double length = vector(parameters, direction, channel, first).norm();
    if (std::abs(length - 1) <= 1e-4) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", length);
    lines.push_back("parameters " + number_of(direction, channel, first) + " .. " +
                    number_of(direction, channel, first + 2) + " (" + direction.name +
                    "): the direction is " + text + " long and is normalized");
  });
  return lines;
}

geometry::AngleTravels rotary_travels(const Parameters& parameters, std::uint16_t channel) {
  geometry::AngleTravels travels;
  for (std::uint32_t i = 0; i < geometry::angle_count; ++i) {
    const int axis = parameters.integer(parameter::channel_axis, channel, 3 + i);
    if (axis < 0) continue;
    travels[i] = travel_of(parameters, static_cast<std::uint16_t>(axis));
  }
  return travels;
}

std::map<std::uint32_t, ParameterValue> parameters_of_chain(const geometry::ChainDescription& description,
                                                            std::uint16_t channel) {
  const auto made = geometry::parameters_of(description);
  if (const auto* error = std::get_if<ChainError>(&made))
    throw KinematicsError(alarm_about(*error), to_string(*error));
  const auto& p = std::get<geometry::ChainParameters>(made);
  std::map<std::uint32_t, ParameterValue> values;
  const auto set = [&](const NumericParameter& parameter, std::uint32_t index, double value) {
    const auto number = parameter.number(channel, index);
    if (const auto refused = Catalogue::instance().check(number, value, ""); !refused.empty())
      throw KinematicsError(std::isfinite(value) ? alarm::kinematics_invalid : alarm::kinematics_not_finite,
                            refused);
    values[number] = {value, ""};
  };
  const auto set_vector = [&](const RealParameter& parameter, std::uint32_t first, const Vec3& v) {
    for (std::uint32_t i = 0; i < 3; ++i) set(parameter, first + i, v[i]);
  };
  const auto set_side = [&](const Side& side,
                            std::array<const std::optional<geometry::RotaryAxis>*, 3> axes) {
    double type = 0, place = 1;
    for (std::size_t i = 0; i < axes.size() && *axes[i]; ++i, place *= 10) {
      const auto& axis = **axes[i];
      type += place * static_cast<double>(axis.angle + 3);
      set_vector(side.direction[i], 0, axis.direction);
      set_vector(side.offset[i], 0, axis.offset);
      set_vector(side.correction[i], 0, axis.correction);
    }
    set(side.type, 0, type);
  };
  set_vector(parameter::tool_direction, 0, p.tool_direction);
  set_side(head, {&p.head_2, &p.head_1, &p.head_0});
  set_side(table, {&p.table_2, &p.table_1, &p.table_0});
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    set_vector(parameter::linear_direction, axis * 3, p.linear_direction.col(axis));
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    set(parameter::linear_carriers, axis, p.linear_carriers[axis]);
  set_vector(parameter::chain_origin, 0, p.origin);
  set_vector(parameter::base_correction, 0, p.base_correction);
  set(parameter::chain_open, 0, p.open ? 1 : 0);
  const auto corrections = geometry::correction_names(description);
  const auto set_name = [&](const TextParameter& parameter, const std::string& text) {
    if (text.empty()) return;
    const auto number = parameter.number(channel);
    if (const auto refused = Catalogue::instance().check(number, 0, text); !refused.empty())
      throw KinematicsError(alarm::kinematics_invalid, refused);
    values[number] = {0, text};
  };
  for (std::size_t i = 0; i < slots; ++i) {
    set_name(table.correction_name[i], corrections.table[i]);
    set_name(head.correction_name[i], corrections.head[i]);
  }
  set_name(parameter::base_correction_name, corrections.base);
  Parameters all;
  all.values = values;
  make_chain(all, channel);
  return values;
}

std::vector<CorrectionElement> correction_elements(const Parameters& parameters, std::uint16_t channel) {
  std::vector<CorrectionElement> elements;
  const auto add = [&](const TextParameter& name, const RealParameter& vector, double sign) {
    const auto text = parameters.text(name, channel);
    if (!text.empty()) elements.push_back({text, vector.number(channel), sign});
  };
  for (std::size_t i = 0; i < slots; ++i) add(table.correction_name[i], table.correction[i], 1);
  add(parameter::base_correction_name, parameter::base_correction, 1);
  for (std::size_t i = 0; i < slots; ++i) add(head.correction_name[i], head.correction[i], -1);
  return elements;
}

bool is_chain_parameter(std::uint32_t number) {
  if (number / 10000 != 4) return false;
  const auto offset = number % 1000;
  return (offset >= 400 && offset <= 402) || (offset >= 410 && offset <= 422) ||
         (offset >= 425 && offset <= 437) || (offset >= 905 && offset <= 907) ||
         (offset >= 920 && offset <= 943) || (offset >= 960 && offset <= 988);
}

}  // namespace trunnion::machine
