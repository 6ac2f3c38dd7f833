// SPDX-License-Identifier: Apache-2.0
// Slave axes of a gantry follow their master; the synchronization error is corrected slowly.
// Source: HNC-8 parameters 010050.., 10a100..10a131.
#pragma once

#include <vector>

#include "machine/gantry_pairs.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::gantry {

/// Slave minus the position that belongs to its master's, mm, from encoder positions.
double synchronization_error(const machine::GantryPair& pair, const double* actual);

/// The part of each slave's offset from its master that the compensation of the two axes accounts for, mm,
/// from the state of a core with `pairs` pairs: 0 for each when no slave is compensated.
std::vector<double> compensated_offsets(std::size_t pairs, std::span<const double> state);

/// A slave with a column of its own in the frames was compensated on its own: the column is its setpoint
/// before the correction. Otherwise the setpoint is made from the master's. State: the correction of each
/// slave of the channel, mm; then, when slaves have columns of their own, their compensated offsets.
class GantryCore : public stream::StageCore<idl::stream::AxisFrame> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisFrame& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisFrame& out) override;
  void load(std::span<const double> state) override;
  void save(stream::StateValues& state) const override;

 private:
  std::uint64_t lead_ = 32;
  std::vector<machine::GantryPair> pairs_;
  std::vector<std::size_t> master_index_;  // column of each master in the channel's frames
  std::vector<double> corrections_, offsets_;
  bool own_columns_ = false;  // in the newest frame
};

}  // namespace trunnion::gantry
