// SPDX-License-Identifier: Apache-2.0
#include "probe_input.hpp"

#include <algorithm>

#include "machine/gantry_pairs.hpp"

namespace trunnion::drive {
ProbeInput::ProbeInput(const ProbeSetup& setup)
    : geometry_(setup.geometry),
      orientation_(setup.design),
      lobes_(setup.probe.lobing != 0),
      length_(setup.probe.length),
      probe_(setup.probe, setup.solids) {
  columns_.fill(-1);
  for (const auto& source : geometry_.errors().heat)
    warms_ = warms_ || source.rise_per_speed != 0 || source.constant_rise != 0;
}

void ProbeInput::configure(const machine::Parameters& parameters,
                           const std::vector<machine::AxisInfo>& axes) {
  columns_.fill(-1);
  const auto letters = machine::channel_axes(parameters, 0);
  for (std::size_t i = 0; i < letters.index.size(); ++i)
    columns_[letters.index[i]] = machine::column_of(axes, letters.number[i]);
  slave_column_ = -1;
  const auto& beam = geometry_.errors().beam;
  if (!beam) return;
  for (const auto& pair : machine::gantry_pairs(parameters, 0)) {
    if (machine::column_of(axes, pair.master) != columns_[beam->axis]) continue;
    slave_column_ = machine::column_of(axes, pair.slave);
    slave_sign_ = pair.sign, slave_zero_ = pair.zero_deviation;
  }
}

touch_probe::ProbePose ProbeInput::pose(const std::vector<SimulatedAxis>& servos) const {
  truth::MachinePose machine;
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i] >= 0) machine.positions[i] = servos[static_cast<std::size_t>(columns_[i])].load();
  machine.approach = approach_;
  machine.tool_length = length_;
  if (slave_column_ >= 0)
    machine.slave_lead =
        slave_sign_ * (servos[static_cast<std::size_t>(slave_column_)].load() - slave_zero_) -
        machine.positions[geometry_.errors().beam->axis];
  machine.temperatures = warm_up_.temperatures();
  const auto tool = geometry_.pose(machine);
  touch_probe::ProbePose out{tool.tip, truth::Vec3::UnitX(), tool.axis};
  if (lobes_) {
    geometry::Angles degrees{};
    std::copy(machine.positions.begin() + 3, machine.positions.end(), degrees.begin());
    out.across = orientation_.across(degrees);
  }
  return out;
}

void ProbeInput::step(const SetpointRow& row, double period, const std::vector<SimulatedAxis>& servos,
                      const std::vector<SimulatedSpindle>& spindles, EncoderRowSink& rows) {
  truth::Temperatures speeds{};
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i] < 0) continue;
    const auto column = static_cast<std::size_t>(columns_[i]);
    speeds[i] = servos[column].velocity();
    if (const double v = row.axes[column].velocity; v != 0) approach_[i] = v > 0 ? 1 : -1;
  }
  if (warms_) {
    if (!spindles.empty()) speeds[truth::spindle_source] = spindles.front().speed();
    warm_up_.step(geometry_.errors().heat, speeds, period);
  }
  if (!row.probe_on) {
    if (switched_on_) probe_.switch_off();
  } else if (!switched_on_) {
    probe_.place(pose(servos));
  } else if (const auto share = probe_.move(pose(servos), period)) {
    idl::stream::SkipEdge edge;
    edge.input = 1;
    for (std::size_t i = 0; i < servos.size(); ++i)
      edge.position.push_back(encoder_[i] + *share * (servos[i].encoder() - encoder_[i]));
    rows.skip_edge(row.number + 1, edge);
  }
  switched_on_ = row.probe_on;
  encoder_.resize(servos.size());
  for (std::size_t i = 0; i < servos.size(); ++i) encoder_[i] = servos[i].encoder();
}

}  // namespace trunnion::drive
