// SPDX-License-Identifier: Apache-2.0
#include "machine/axes.hpp"

#include <cmath>

#include "canonical/axes.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

std::vector<AxisInfo> axes_where(const Parameters& parameters, bool spindle) {
  std::vector<AxisInfo> result;
  const int count = parameters.integer(parameter::maximum_axes);
  for (std::uint16_t a = 0; a < count; ++a) {
    const auto name = parameters.text(parameter::axis_name, a);
    const int type = parameters.integer(parameter::axis_type, a);
    if (!name.empty() && (type == axis_type_spindle) == spindle) result.push_back({a, name, type});
  }
  return result;
}

}  // namespace

std::vector<AxisInfo> drive_axes(const Parameters& parameters) { return axes_where(parameters, false); }
std::vector<AxisInfo> spindles(const Parameters& parameters) { return axes_where(parameters, true); }

int column_of(const std::vector<AxisInfo>& axes, std::uint16_t number) {
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (axes[i].number == number) return static_cast<int>(i);
  return -1;
}

canonical::RotaryWay rotary_way(const Parameters& parameters, std::uint16_t axis) {
  if (parameters.integer(parameter::axis_type, axis) != axis_type_rotary) return canonical::RotaryWay::linear;
  return static_cast<canonical::RotaryWay>(parameters.integer(parameter::rotary_way, axis));
}

bool holds_at_every_turn(const Parameters& parameters, std::uint16_t axis, bool repeats, double period) {
  if (rotary_way(parameters, axis) == canonical::RotaryWay::linear) return true;
  const double in_a_turn = 360 / period;
  return repeats && in_a_turn > 0.5 && std::abs(in_a_turn - std::round(in_a_turn)) < 1e-9;
}

geometry::AngleTravel travel_of(const Parameters& parameters, std::uint16_t axis) {
  constexpr double endless = 1e12;
  if (rotary_way(parameters, axis) != canonical::RotaryWay::linear) return {-endless, endless};
  return {parameters.get(parameter::negative_limit, axis), parameters.get(parameter::positive_limit, axis)};
}

ChannelAxes channel_axes(const Parameters& parameters, std::uint16_t channel) {
  ChannelAxes result;
  for (std::uint8_t i = 0; i < 9; ++i) {
    const int number = parameters.integer(parameter::channel_axis, channel, i);
    if (number < 0 || number >= parameters.integer(parameter::maximum_axes)) continue;
    result.index.push_back(i);
    result.number.push_back(static_cast<std::uint16_t>(number));
    result.letters += canonical::axis_letters[i];
  }
  return result;
}

}  // namespace trunnion::machine
