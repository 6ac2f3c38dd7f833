#include "machine/kinematics.hpp"

#include <array>
#include <cmath>

namespace trunnion::machine {
namespace {

using geometry::ChainError;
using geometry::Vec3;

// The slots of one side, beginning with the one next to the tool or the workpiece.
constexpr std::array<const char*, 3> slots{"_2", "_1", "_0"};

Vec3 vector(const Parameters& parameters, const std::string& name, std::uint16_t channel,
            std::uint32_t first = 0) {
  return {parameters.get(name, channel, first), parameters.get(name, channel, first + 1),
          parameters.get(name, channel, first + 2)};
}

std::string number_of(const std::string& name, std::uint16_t channel, std::uint32_t index = 0) {
  return number_text(Catalogue::instance().by_name(name).number(channel, index));
}

[[noreturn]] void fail_type(const std::string& side, std::uint16_t channel, const std::string& what) {
  const std::string name = side + "_type";
  std::string text = "parameter ";
  text.append(number_of(name, channel)).append(" (").append(name).append("): ").append(what);
  throw KinematicsError("kinematics_invalid", text);
}

// Digits of a structure type, the last one first: one for each slot in use.
std::vector<int> digits_of(const Parameters& parameters, const std::string& side, std::uint16_t channel) {
  std::vector<int> digits;
  for (int type = parameters.integer(side + "_type", channel); type > 0; type /= 10)
    digits.push_back(type % 10);
  if (digits.size() > slots.size()) fail_type(side, channel, "more than three rotary axes");
  return digits;
}

void read_side(const Parameters& parameters, const std::string& side, std::uint16_t channel,
               std::array<std::optional<geometry::RotaryAxis>*, 3> axes) {
  const auto digits = digits_of(parameters, side, channel);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (digits[i] < 3 || digits[i] > 8)
      fail_type(side, channel,
                "digit " + std::to_string(digits[i]) + " is not 3 (A), 4 (B), 5 (C), 6 (U), 7 (V) or 8 (W)");
    *axes[i] = {vector(parameters, side + "_direction" + slots[i], channel),
                vector(parameters, side + "_offset" + slots[i], channel),
                static_cast<std::size_t>(digits[i] - 3),
                vector(parameters, side + "_correction" + slots[i], channel)};
  }
}

std::string alarm_name(ChainError error) {
  switch (error) {
    case ChainError::not_finite:
      return "kinematics_not_finite";
    case ChainError::zero_direction:
      return "kinematics_zero_direction";
    case ChainError::parallel_axes:
      return "kinematics_parallel_axes";
    default:
      return "kinematics_invalid";
  }
}

// The name and the first number of every direction vector in use.
template <class Visit>
void visit_directions(const Parameters& parameters, std::uint16_t channel, Visit&& visit) {
  visit("tool_direction", 0u);
  for (const char* side : {"head", "table"}) {
    const auto count = digits_of(parameters, side, channel).size();
    for (std::size_t i = 0; i < count; ++i) visit(std::string(side) + "_direction" + slots[i], 0u);
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) visit("linear_direction", axis * 3);
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

std::string alarm_of(const std::exception& error) {
  const auto* kinematics = dynamic_cast<const KinematicsError*>(&error);
  return kinematics != nullptr ? kinematics->alarm() : "kinematics_invalid";
}

geometry::Chain make_chain(const Parameters& parameters, std::uint16_t channel) {
  geometry::ChainParameters p;
  p.tool_direction = vector(parameters, "tool_direction", channel);
  read_side(parameters, "head", channel, {&p.head_2, &p.head_1, &p.head_0});
  read_side(parameters, "table", channel, {&p.table_2, &p.table_1, &p.table_0});
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    p.linear_direction.col(axis) = vector(parameters, "linear_direction", channel, axis * 3);
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    p.linear_carriers[axis] = parameters.integer("linear_carriers", channel, axis);
  p.origin = vector(parameters, "chain_origin", channel);
  p.open = parameters.integer("chain_open", channel) != 0;
  p.base_correction = vector(parameters, "base_correction", channel);
  auto made = geometry::Chain::make(p);
  if (const auto* error = std::get_if<ChainError>(&made)) {
    std::string where =
        number_of("tool_direction", channel) + " .. " + number_of("table_offset_2", channel, 2);
    // One vector can be named.
    if (*error == ChainError::zero_direction)
      visit_directions(parameters, channel, [&](const std::string& name, std::uint32_t first) {
        if (vector(parameters, name, channel, first).isZero(0))
          where = number_of(name, channel, first) + " .. " + number_of(name, channel, first + 2);
      });
    if (*error == ChainError::bad_carrier)
      where = number_of("linear_carriers", channel) + " .. " + number_of("linear_carriers", channel, 2);
    throw KinematicsError(alarm_name(*error), "channel " + std::to_string(channel) + ", parameters " + where +
                                                  ": " + to_string(*error));
  }
  return std::get<geometry::Chain>(std::move(made));
}

std::vector<std::string> kinematics_warnings(const Parameters& parameters, std::uint16_t channel) {
  std::vector<std::string> lines;
  visit_directions(parameters, channel, [&](const std::string& name, std::uint32_t first) {
    const double length = vector(parameters, name, channel, first).norm();
    if (std::abs(length - 1) <= 1e-4) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", length);
    lines.push_back("parameters " + number_of(name, channel, first) + " .. " +
                    number_of(name, channel, first + 2) + " (" + name + "): the direction is " + text +
                    " long and is normalized");
  });
  return lines;
}

geometry::AngleTravels rotary_travels(const Parameters& parameters, std::uint16_t channel) {
  geometry::AngleTravels travels;
  for (std::uint32_t i = 0; i < geometry::angle_count; ++i) {
    const int axis = parameters.integer("channel_axis", channel, 3 + i);
    if (axis < 0) continue;
    const auto number = static_cast<std::uint32_t>(axis);
    travels[i] = {parameters.get("negative_limit", number), parameters.get("positive_limit", number)};
  }
  return travels;
}

std::map<std::uint32_t, ParameterValue> parameters_of_chain(const geometry::ChainDescription& description,
                                                            std::uint16_t channel) {
  const auto made = geometry::parameters_of(description);
  if (const auto* error = std::get_if<ChainError>(&made))
    throw KinematicsError(alarm_name(*error), to_string(*error));
  const auto& p = std::get<geometry::ChainParameters>(made);
  std::map<std::uint32_t, ParameterValue> values;
  const auto set = [&](const std::string& name, std::uint32_t index, double value) {
    const auto number = Catalogue::instance().by_name(name).number(channel, index);
    if (const auto refused = Catalogue::instance().check(number, value, ""); !refused.empty())
      throw KinematicsError(std::isfinite(value) ? "kinematics_invalid" : "kinematics_not_finite", refused);
    values[number] = {value, ""};
  };
  const auto set_vector = [&](const std::string& name, std::uint32_t first, const Vec3& v) {
    for (std::uint32_t i = 0; i < 3; ++i) set(name, first + i, v[i]);
  };
  const auto set_side = [&](const std::string& side,
                            std::array<const std::optional<geometry::RotaryAxis>*, 3> axes) {
    double type = 0, place = 1;
    for (std::size_t i = 0; i < axes.size() && *axes[i]; ++i, place *= 10) {
      const auto& axis = **axes[i];
      type += place * static_cast<double>(axis.angle + 3);
      set_vector(side + "_direction" + slots[i], 0, axis.direction);
      set_vector(side + "_offset" + slots[i], 0, axis.offset);
      set_vector(side + "_correction" + slots[i], 0, axis.correction);
    }
    set(side + "_type", 0, type);
  };
  set_vector("tool_direction", 0, p.tool_direction);
  set_side("head", {&p.head_2, &p.head_1, &p.head_0});
  set_side("table", {&p.table_2, &p.table_1, &p.table_0});
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    set_vector("linear_direction", axis * 3, p.linear_direction.col(axis));
  for (std::uint32_t axis = 0; axis < 3; ++axis) set("linear_carriers", axis, p.linear_carriers[axis]);
  set_vector("chain_origin", 0, p.origin);
  set_vector("base_correction", 0, p.base_correction);
  set("chain_open", 0, p.open ? 1 : 0);
  const auto names = geometry::correction_names(description);
  const auto set_name = [&](const std::string& name, const std::string& text) {
    if (text.empty()) return;
    const auto number = Catalogue::instance().by_name(name).number(channel);
    if (const auto refused = Catalogue::instance().check(number, 0, text); !refused.empty())
      throw KinematicsError("kinematics_invalid", refused);
    values[number] = {0, text};
  };
  for (std::size_t i = 0; i < slots.size(); ++i) {
    set_name(std::string("table_correction_name") + slots[i], names.table[i]);
    set_name(std::string("head_correction_name") + slots[i], names.head[i]);
  }
  set_name("base_correction_name", names.base);
  Parameters all;
  all.values = values;
  make_chain(all, channel);
  return values;
}

std::vector<CorrectionElement> correction_elements(const Parameters& parameters, std::uint16_t channel) {
  std::vector<CorrectionElement> elements;
  const auto add = [&](const std::string& name, const std::string& vector_name, double sign) {
    const auto text = parameters.text(name, channel);
    if (!text.empty())
      elements.push_back({text, Catalogue::instance().by_name(vector_name).number(channel), sign});
  };
  for (const char* slot : slots)
    add(std::string("table_correction_name") + slot, std::string("table_correction") + slot, 1);
  add("base_correction_name", "base_correction", 1);
  for (const char* slot : slots)
    add(std::string("head_correction_name") + slot, std::string("head_correction") + slot, -1);
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
