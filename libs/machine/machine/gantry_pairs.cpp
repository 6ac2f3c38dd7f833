// SPDX-License-Identifier: Apache-2.0
#include "machine/gantry_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine {

DriveSynchronization DriveSynchronization::from(const Parameters& p, std::uint32_t axis) {
  const int first = p.integer(parameter::drive_synchronization, axis);
  const int second = p.integer(parameter::drive_synchronization_functions, axis);
  const auto digit = [](int word, int unit) { return word / unit % 10 != 0; };
  DriveSynchronization s;
  s.on = digit(first, 1), s.slave = digit(first, 10), s.torque_follow = digit(first, 100);
  s.current_checked = !digit(first, 1000), s.inverted = digit(first, 10000);
  s.compensates = digit(second, 1), s.common_stop = digit(second, 10);
  s.gain = p.get(parameter::drive_synchronization_gain, axis) / 100;
  return s;
}

bool is_gantry_slave(const Parameters& p, int axis) {
  return p.integer(parameter::gantry_synchronous, static_cast<std::uint32_t>(axis)) == 1;
}

std::optional<ParameterFault> gantry_fault(const Parameters& p, const std::vector<AxisInfo>& axes,
                                           int slave) {
  const auto number = parameter::gantry_master.number(static_cast<std::uint32_t>(slave));
  const int master = p.integer(parameter::gantry_master, static_cast<std::uint32_t>(slave));
  const auto exists = [&](int axis) {
    return axis >= 0 && column_of(axes, static_cast<std::uint16_t>(axis)) >= 0;
  };
  std::string what;
  if (!exists(slave) || !exists(master))
    what = "one of them does not exist";
  else if (slave == master)
    what = "an axis cannot follow itself";
  else
    return std::nullopt;
  return ParameterFault{{number},
                        "parameter " + number_text(number) + " (" + parameter::gantry_master.name +
                            "): axis " + std::to_string(slave) + " follows axis " + std::to_string(master) +
                            ", and " + what};
}

std::vector<GantryPair> gantry_pairs(const Parameters& p) {
  std::vector<GantryPair> pairs;
  const auto axes = drive_axes(p);
  const int slaves = p.integer(parameter::gantry_slaves);
  for (int i = 0; i < slaves; ++i) {
    const int slave = p.integer(parameter::gantry_slave_axis, 0, static_cast<std::uint32_t>(i));
    if (slave < 0 || !is_gantry_slave(p, slave)) continue;
    if (const auto fault = gantry_fault(p, axes, slave)) throw std::runtime_error(fault->text);
    const auto a = static_cast<std::uint32_t>(slave);
    GantryPair pair;
    pair.slave = static_cast<std::uint16_t>(slave);
    pair.master = static_cast<std::uint16_t>(p.integer(parameter::gantry_master, a));
    pair.slave_column = column_of(axes, pair.slave);
    pair.master_column = column_of(axes, pair.master);
    const bool mirrored = p.integer(parameter::gantry_mirror, a) == 1;
    pair.sign = mirrored != (p.integer(parameter::gantry_reversed, a) == 1) ? -1 : 1;
    pair.zero_deviation = p.get(parameter::gantry_zero_deviation, a);
    pair.limit = p.get(parameter::synchronization_error_limit, a);
    pair.speed_limit = p.get(parameter::synchronization_speed_limit, a);
    if (DriveSynchronization::from(p, a).current_checked)
      pair.current_limit = p.get(parameter::synchronization_current_limit, a);
    pair.master_current = p.get(parameter::rated_current, pair.master);
    pair.slave_current = p.get(parameter::rated_current, a);
    pair.aligns = p.integer(parameter::gantry_alignment, a) == 1;
    pair.alignment_rate = p.get(parameter::alignment_rate, a);
    pair.alignment_limit = p.get(parameter::alignment_maximum, a);
    for (const double limit : {pair.limit, p.get(parameter::alignment_limit, a)})
      if (limit > 0) pair.alignment_limit = std::min(pair.alignment_limit, limit);
    pairs.push_back(pair);
  }
  return pairs;
}

std::vector<GantryPair> gantry_pairs(const Parameters& parameters, std::uint16_t channel) {
  auto pairs = gantry_pairs(parameters);
  const auto numbers = channel_axes(parameters, channel).number;
  std::erase_if(pairs, [&](const GantryPair& pair) {
    return std::find(numbers.begin(), numbers.end(), pair.master) == numbers.end();
  });
  return pairs;
}

AutoOffset auto_offset(const Parameters& p, const GantryPair& pair, double error) {
  // Of an absolute encoder the position is kept and has no reference coordinate any longer.
  const bool absolute = p.integer(parameter::homing_direction, pair.slave) == 0;
  const auto& key = absolute ? parameter::gantry_zero_deviation : parameter::reference_coordinate;
  AutoOffset offset{key.number(pair.slave), p.get(key, pair.slave), 0};
  offset.proposal = std::round((offset.now + (absolute ? error : -error)) * 1e6) / 1e6;
  return offset;
}

bool axis_moves_with(const Parameters& parameters, std::uint16_t axis, std::uint16_t channel) try {
  const auto numbers = channel_axes(parameters, channel).number;
  if (std::find(numbers.begin(), numbers.end(), axis) != numbers.end()) return true;
  const auto pairs = gantry_pairs(parameters, channel);
  return std::any_of(pairs.begin(), pairs.end(), [&](const GantryPair& pair) { return pair.slave == axis; });
} catch (const std::runtime_error&) {
  return false;
}

}  // namespace trunnion::machine
