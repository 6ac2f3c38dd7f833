// SPDX-License-Identifier: Apache-2.0
#include "compensation/channel_compensation.hpp"

#include <algorithm>

#include "compensation/model_parameters.hpp"
#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {
namespace {

const TableParameters pitch_table{
    parameter::pitch_type,    parameter::pitch_start,     parameter::pitch_points, parameter::pitch_interval,
    &parameter::pitch_modulo, &parameter::pitch_override, parameter::pitch_table};

AxisCompensation read_axis(TableReader& reader, std::uint32_t a) {
  AxisCompensation axis;
  axis.backlash = Backlash::read(reader.parameters(), a);
  axis.pitch = reader.read(pitch_table, a);
  reader.check_turns(axis.pitch, pitch_table, a, static_cast<std::uint16_t>(a));
  axis.thermal = Thermal::read(reader, a);
  axis.jump = ReversalJump::read(reader.parameters(), a);
  return axis;
}

void count_volumetric(TableReader& reader, const std::vector<std::uint16_t>& axes) {
  const auto& p = reader.parameters();
  for (const auto a : axes)
    reader.count(static_cast<std::size_t>(p.integer(parameter::volumetric_points, a)) *
                 volumetric::component_count *
                 (p.integer(parameter::volumetric_direction, a) % 2 == 0 ? 2 : 1));
}

}  // namespace

ChannelCompensation ChannelCompensation::read(const machine::Parameters& p, std::uint16_t channel) {
  ChannelCompensation all;
  const auto own = machine::channel_axes(p, channel);
  ChannelColumns columns{own.number, channel};
  TableReader reader(p);
  all.letters = own.index;
  const auto read_references = [&](AxisCompensation& axis, std::uint32_t number) {
    axis.squareness = read_squareness(p, number, columns);
    axis.straightness = read_straightness(reader, number, columns);
    auto found = read_angles(reader, number, columns);
    std::move(found.begin(), found.end(), std::back_inserter(all.angles));
  };
  for (const auto number : own.number) {
    all.axes.push_back(read_axis(reader, number));
    read_references(all.axes.back(), number);
  }
  for (const auto& pair : machine::gantry_pairs(p, channel)) {
    const auto master = static_cast<std::size_t>(
        std::find(own.number.begin(), own.number.end(), pair.master) - own.number.begin());
    auto axis = read_axis(reader, pair.slave);
    columns.numbers.push_back(pair.slave);
    const auto before = all.angles.size();
    read_references(axis, pair.slave);
    const bool by_angle = std::any_of(all.angles.begin(), all.angles.end(),
                                      [&](const auto& angle) { return angle.compensated == master; });
    if (!axis.active() && !all.axes[master].active() && !by_angle && all.angles.size() == before) {
      columns.numbers.pop_back();
      continue;
    }
    all.axes.push_back(std::move(axis));
    all.slaves.push_back({pair, master});
  }
  if (all.axes.size() > most_axes)
    throw machine::KinematicsError(
        alarm::compensation_invalid,
        "channel " + std::to_string(channel) + " has more than " + std::to_string(most_axes) + " axes");
  all.volumetric = volumetric::compensation_of(p, channel);
  if (all.volumetric) count_volumetric(reader, own.number);
  return all;
}

}  // namespace trunnion::compensation
