// SPDX-License-Identifier: Apache-2.0
#include "compensation_core.hpp"

#include <algorithm>

namespace trunnion::compensation {
void CompensationCore::configure(const machine::Parameters& p, std::uint16_t channel) {
  auto read = ChannelCompensation::read(p, channel);
  axes_.clear();
  for (auto& axis : read.axes) axes_.push_back({std::move(axis), {}, 0});
  slaves_ = std::move(read.slaves);
  angles_ = std::move(read.angles);
  letters_ = std::move(read.letters);
  cross_tables_ = std::any_of(axes_.begin(), axes_.end(), [](const Axis& axis) {
    return axis.thermal.enabled || axis.jump.amount != 0 || !axis.squareness.empty() ||
           !axis.straightness.empty();
  });
  volume_.configure(std::move(read.volumetric), p, channel);
  needs_further_ = volume_.enabled() || std::any_of(axes_.begin(), axes_.end(),
                                                    [](const Axis& a) { return a.has_further_state(); });
  further_ = needs_further_;
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

bool CompensationCore::process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow&,
                               idl::stream::AxisBatch& out) {
  const std::size_t in_width = in.axes.size(), own = axes_.size() - slaves_.size();
  out.axes = in.axes;
  if (in_width != own) {  // no batch of a configured channel
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
