#include "machine/axes.hpp"

#include <stdexcept>

namespace trunnion::machine {
namespace {

std::vector<AxisInfo> axes_where(const Parameters& parameters, bool spindle) {
  std::vector<AxisInfo> result;
  for (std::uint16_t a = 0; a < 32; ++a) {
    const auto name = parameters.text("axis_name", a);
    const int type = parameters.integer("axis_type", a);
    if (!name.empty() && (type == axis_type_spindle) == spindle) result.push_back({a, name, type});
  }
  return result;
}

geometry::Vec3 vector(const Parameters& parameters, const std::string& name, std::uint16_t channel) {
  return {parameters.get(name, channel, 0), parameters.get(name, channel, 1),
          parameters.get(name, channel, 2)};
}

geometry::RotaryAxis rotary(const Parameters& parameters, const std::string& side, int slot, int digit,
                            std::uint16_t channel) {
  const auto suffix = "_" + std::to_string(slot);
  if (digit < 3 || digit > 5)
    throw std::runtime_error(
        "parameter " + number_text(Catalogue::instance().by_name(side + "_type").number(channel)) + " (" +
        side + "_type): digit " + std::to_string(digit) + " is not 3 (A), 4 (B) or 5 (C)");
  return {vector(parameters, side + "_direction" + suffix, channel),
          vector(parameters, side + "_offset" + suffix, channel), static_cast<std::size_t>(digit - 3)};
}

}  // namespace

std::vector<AxisInfo> drive_axes(const Parameters& parameters) { return axes_where(parameters, false); }
std::vector<AxisInfo> spindles(const Parameters& parameters) { return axes_where(parameters, true); }

int column_of(const std::vector<AxisInfo>& axes, std::uint16_t number) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].number == number) return static_cast<int>(i);
  return -1;
}

ChannelAxes channel_axes(const Parameters& parameters, std::uint16_t channel) {
  ChannelAxes result;
  for (std::uint8_t i = 0; i < 9; ++i) {
    const int number = parameters.integer("channel_axis", channel, i);
    if (number < 0) continue;
    result.index.push_back(i);
    result.number.push_back(static_cast<std::uint16_t>(number));
    result.letters += "XYZABCUVW"[i];
  }
  return result;
}

geometry::Chain make_chain(const Parameters& parameters, std::uint16_t channel) {
  geometry::ChainParameters p;
  p.tool_direction = vector(parameters, "tool_direction", channel);
  const int head = parameters.integer("head_type", channel),
            table = parameters.integer("table_type", channel);
  if (head >= 10) p.head_1 = rotary(parameters, "head", 1, head / 10, channel);
  if (head > 0) p.head_2 = rotary(parameters, "head", 2, head % 10, channel);
  if (table >= 10) p.table_1 = rotary(parameters, "table", 1, table / 10, channel);
  if (table > 0) p.table_2 = rotary(parameters, "table", 2, table % 10, channel);
  auto made = geometry::Chain::make(p);
  if (const auto* error = std::get_if<geometry::ChainError>(&made)) {
    const std::string where = "channel " + std::to_string(channel) + ", parameters " +
                              number_text(40400 + channel * 1000u) + " .. " +
                              number_text(40437 + channel * 1000u) + ": ";
    switch (*error) {
      case geometry::ChainError::not_finite:
        throw std::runtime_error(where + "a value is not finite");
      case geometry::ChainError::zero_direction:
        throw std::runtime_error(where + "the direction of a rotary axis is zero");
      case geometry::ChainError::bad_angle:
        throw std::runtime_error(where + "a rotary axis is not A, B or C");
      case geometry::ChainError::shared_angle:
        throw std::runtime_error(where + "two rotary axes have the same letter");
    }
  }
  return std::get<geometry::Chain>(std::move(made));
}

}  // namespace trunnion::machine
