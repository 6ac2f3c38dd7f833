// SPDX-License-Identifier: Apache-2.0
// Tool tip in the workpiece to machine axes (RTCP), by the chain of parameters 04c400..04c437.
#pragma once

#include <optional>

#include "geometry/chain.hpp"
#include "machine/axes.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::kinematics {

/// Stateless: the same batch gives the same axes, whatever came before.
class KinematicsCore : public stream::StageCore<idl::stream::PathBatch> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::PathBatch& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisBatch& out) override;
  void load(std::span<const double>) override {}
  void save(stream::StateValues& state) const override { state.clear(); }

 private:
  machine::ChannelAxes axes_;
  std::optional<geometry::Chain> chain_;
};

}  // namespace trunnion::kinematics
