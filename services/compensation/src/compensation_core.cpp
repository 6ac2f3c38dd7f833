// SPDX-License-Identifier: Apache-2.0
#include "compensation_core.hpp"

#include <algorithm>

#include "machine/alarm_constants.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {
namespace {

const TableParameters pitch_table{
    parameter::pitch_type,    parameter::pitch_start,     parameter::pitch_points, parameter::pitch_interval,
    &parameter::pitch_modulo, &parameter::pitch_override, parameter::pitch_table};

}  // namespace

CompensationCore::Axis CompensationCore::read_axis(TableReader& reader, std::uint32_t a) {
  const auto& p = reader.parameters();
  Axis axis;
  axis.backlash = Backlash::read(p, a);
  axis.pitch = reader.read(pitch_table, a);
  axis.thermal = Thermal::read(reader, a);
  axis.jump = ReversalJump::read(p, a);
  return axis;
}

void CompensationCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  const auto own = machine::channel_axes(p, channel);
  ChannelColumns columns{own.number, channel};
  TableReader reader(p);
  std::vector<Axis> axes;
  std::vector<Slave> slaves;
  for (const auto number : own.number) axes.push_back(read_axis(reader, number));
  for (std::size_t i = 0; i < axes.size(); ++i) {
    axes[i].squareness = read_squareness(p, own.number[i], columns);
    axes[i].straightness = read_straightness(reader, own.number[i], columns);
  }
  auto angles = std::vector<AngleCompensation>();
  const auto add_angles = [&](std::uint32_t number) {
    auto found = read_angles(reader, number, columns);
    std::move(found.begin(), found.end(), std::back_inserter(angles));
  };
  for (const auto number : own.number) add_angles(number);
  for (const auto& pair : machine::gantry_pairs(p, channel)) {
    const auto master = static_cast<std::size_t>(
        std::find(own.number.begin(), own.number.end(), pair.master) - own.number.begin());
    auto axis = read_axis(reader, pair.slave);
    columns.numbers.push_back(pair.slave);
    axis.squareness = read_squareness(p, pair.slave, columns);
    axis.straightness = read_straightness(reader, pair.slave, columns);
    const auto before = angles.size();
    add_angles(pair.slave);
    const bool by_angle = std::any_of(angles.begin(), angles.end(), [&](const AngleCompensation& angle) {
      return angle.compensated == master || angle.compensated + 1 == columns.numbers.size();
    });
    if (!axis.active() && !axes[master].active() && !by_angle && angles.size() == before) {
      columns.numbers.pop_back();
      continue;
    }
    axes.push_back(std::move(axis));
    slaves.push_back({pair, master});
  }
  if (axes.size() > most_axes)
    throw machine::KinematicsError(alarm::compensation_invalid,
                                   "channel " + std::to_string(channel) + " has more than 32 axes");
  volume_.configure(p, channel, reader);
  cross_tables_ = std::any_of(axes.begin(), axes.end(), [](const Axis& axis) {
    return axis.thermal.enabled || axis.jump.amount != 0 || !axis.squareness.empty() ||
           !axis.straightness.empty();
  });
  needs_further_ = volume_.enabled() ||
                   std::any_of(axes.begin(), axes.end(), [](const Axis& a) { return a.has_further_state(); });
  further_ = needs_further_;
  axes_ = std::move(axes);
  slaves_ = std::move(slaves);
  angles_ = std::move(angles);
  letters_ = own.index;
}

// `x` and `to` have a value for each of axes_.
void CompensationCore::compensate(const double* x, double* to) {
  std::array<bool, most_axes> reversed{};
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    auto& axis = axes_[i];
    if (!primed_) axis.motion.last = x[i];
    reversed[i] = axis.motion.follow(x[i]);
    const double direction = axis.motion.direction;
    const double added = axis.backlash.add(direction, std::abs(x[i] - axis.previous));
    to[i] = x[i] + added + axis.pitch.at(x[i], direction >= 0);
  }
  if (cross_tables_)
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      auto& axis = axes_[i];
      if (axis.thermal.enabled) to[i] += axis.thermal.add(x[i]);
      if (axis.jump.amount != 0) to[i] += axis.jump.add(reversed[i], axis.motion.direction);
      for (const auto& squareness : axis.squareness) to[i] += squareness.at(x);
      for (const auto& straightness : axis.straightness)
        to[i] += straightness.at(x, axes_[straightness.reference].motion.direction);
    }
  for (const auto& angle : angles_)
    to[angle.compensated] += angle.at(x, axes_[angle.reference].motion.direction);
  for (std::size_t i = 0; i < axes_.size(); ++i) axes_[i].previous = x[i];
}

bool CompensationCore::process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow&,
                               idl::stream::AxisFrame& out) {
  const std::size_t in_width = in.axes.size(), own = axes_.size() - slaves_.size();
  out.axes = in.axes;
  if (in_width != own) {  // no frame of a configured channel
    out.setpoints = in.setpoints;
    return true;
  }
  for (const auto& slave : slaves_) out.axes.push_back(slave.pair.slave);
  const std::size_t out_width = axes_.size();
  const std::size_t rows = own == 0 ? 0 : std::min<std::size_t>(in.count, in.setpoints.size() / own);
  out.setpoints.resize(rows * out_width);
  const double tool_length = in.snapshot.tool_length;
  bool moved = static_cast<double>(in.epoch) != epoch_;
  epoch_ = static_cast<double>(in.epoch);
  if (moved)
    for (auto& axis : axes_) axis.thermal.offset = axis.thermal.slope = 0;
  std::array<double, most_axes> x;
  for (std::size_t row = 0; row < rows; ++row) {
    const double* from = &in.setpoints[row * in_width];
    double* to = &out.setpoints[row * out_width];
    std::copy_n(from, own, x.begin());
    for (std::size_t k = 0; k < slaves_.size(); ++k)
      x[own + k] = slaves_[k].pair.slave_position(from[slaves_[k].master]);
    if (!primed_)
      for (std::size_t i = 0; i < out_width; ++i) axes_[i].previous = x[i];
    if (!further_) {
      compensate(x.data(), to);
    } else {
      VolumetricStage::Rows positions{};
      VolumetricStage::Directions before{}, now{};
      for (std::size_t i = 0; i < own; ++i) before[letters_[i]] = static_cast<int>(axes_[i].motion.direction);
      compensate(x.data(), to);
      for (std::size_t i = 0; i < own; ++i) {
        positions[letters_[i]] = x[i];
        now[letters_[i]] = static_cast<int>(axes_[i].motion.direction);
      }
      const auto& added = volume_.step(positions, before, now, tool_length, moved);
      for (std::size_t i = 0; i < own; ++i) to[i] += added[letters_[i]];
      for (std::size_t k = 0; k < slaves_.size(); ++k)
        to[own + k] += slaves_[k].pair.sign * added[letters_[slaves_[k].master]];
    }
    moved = false;
    primed_ = true;
  }
  return true;
}

std::size_t CompensationCore::further_count() const {
  return further_state * axes_.size() + 1 + VolumetricStage::state_count(letters_) + 1;
}

void CompensationCore::load(std::span<const double> state) {
  const std::size_t n = axes_.size(), base = base_state * n;
  const bool whole = state.size() == base + further_count() && state.back() == static_cast<double>(n);
  primed_ = !state.empty() && (state.size() == base || whole);
  volume_.clear();
  epoch_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    auto& axis = axes_[i];
    axis.motion.last = primed_ ? state[base_state * i] : 0;
    axis.motion.direction = primed_ ? state[base_state * i + 1] : 0;
    axis.backlash.added = primed_ ? state[base_state * i + 2] : 0;
    axis.previous = axis.motion.last;
    axis.thermal.offset = axis.thermal.slope = 0;
    axis.jump.age = -1;
    if (!whole) continue;
    const double* further = &state[base + further_state * i];
    axis.previous = further[0];
    axis.thermal.offset = further[1], axis.thermal.slope = further[2];
    axis.jump.age = further[3];
  }
  further_ = needs_further_ || whole;
  if (!whole) return;
  epoch_ = state[base + further_state * n];
  volume_.load(state.subspan(base + further_state * n + 1, VolumetricStage::state_count(letters_)), letters_);
}

void CompensationCore::save(stream::StateValues& state) const {
  state.clear();
  if (!primed_) return;
  state.reserve(base_state * axes_.size() + (further_ ? further_count() : 0));
  for (const auto& axis : axes_)
    for (const double value : {axis.motion.last, axis.motion.direction, axis.backlash.added})
      state.push_back(value);
  if (!further_) return;
  for (const auto& axis : axes_)
    for (const double value : {axis.previous, axis.thermal.offset, axis.thermal.slope, axis.jump.age})
      state.push_back(value);
  state.push_back(epoch_);
  volume_.save(state, letters_);
  state.push_back(static_cast<double>(axes_.size()));
}

}  // namespace trunnion::compensation
