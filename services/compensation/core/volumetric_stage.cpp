// SPDX-License-Identifier: Apache-2.0
#include "volumetric_stage.hpp"

#include "machine/parameter_constants.hpp"

namespace trunnion::compensation {

void VolumetricStage::configure(std::optional<volumetric::VolumetricCompensation> compensation,
                                const machine::Parameters& p, std::uint16_t channel) {
  compensation_ = std::move(compensation);
  const double cycle = p.integer(parameter::interpolation_cycle) * 1e-3;  // ms
  share_ = cycle / (p.get(parameter::volumetric_smoothing_time, channel) + cycle);
  revision_ = static_cast<double>(p.revision);
}

VolumetricStage::Rows VolumetricStage::correction(const Rows& positions, const Directions& directions,
                                                  double tool_length) const {
  if (!compensation_) return {};
  volumetric::MachinePose pose;
  pose.positions = positions;
  pose.approach = directions;
  pose.tool_length = tool_length;
  const auto result = compensation_->correction(pose);
  // Where no correction exists the newest one holds.
  return result.converged ? result.added : correction_;
}

const VolumetricStage::Rows& VolumetricStage::step(const Rows& positions, const Directions& before,
                                                   const Directions& now, double tool_length, bool moved) {
  if (moved) clear();
  const Rows wanted = correction(positions, now, tool_length);
  Rows old = wanted;
  const bool other_model = state_revision_ != revision_;
  if (other_model)
    old = correction_;
  else if (before != now || tool_length_ != tool_length)
    old = correction(positions, before, tool_length_);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    auto& transition = transitions_[i];
    if (old[i] != wanted[i]) transition.absorb(wanted[i] - old[i]);
    transition.step(share_);
    added_[i] = wanted[i] + transition.value();
  }
  correction_ = wanted;
  state_revision_ = revision_;
  tool_length_ = tool_length;
  return added_;
}

void VolumetricStage::clear() {
  correction_ = {};
  for (auto& transition : transitions_) transition.clear();
  state_revision_ = -1;
}

void VolumetricStage::load(std::span<const double> state, std::span<const std::uint8_t> letters) {
  clear();
  tool_length_ = state[0];
  state_revision_ = state[1];
  std::size_t at = 2;
  for (const auto letter : letters) {
    correction_[letter] = state[at++];
    for (double& rest : transitions_[letter].rest()) rest = state[at++];
  }
}

void VolumetricStage::save(std::vector<double>& state, std::span<const std::uint8_t> letters) const {
  state.push_back(tool_length_);
  state.push_back(state_revision_);
  for (const auto letter : letters) {
    state.push_back(correction_[letter]);
    for (const double rest : transitions_[letter].rest()) state.push_back(rest);
  }
}

}  // namespace trunnion::compensation
