// SPDX-License-Identifier: Apache-2.0
// Slave axes of a gantry follow their master. What keeps them together is the work of the drive: the
// alignment when it is switched on, and the compensation of the synchronization error in its loops.
// Source: HNC-8 parameters 010050.., 10a100..10a131.
#pragma once

#include <vector>

#include "machine/gantry_pairs.hpp"
#include "stream/stage_core.hpp"

namespace trunnion::gantry {

/// A slave with a column of its own in the batches was compensated on its own: the column is its setpoint.
/// Otherwise the setpoint is made from the master's. State, when slaves have columns of their own: the
/// compensated offset of each slave of the channel, mm.
class GantryCore : public stream::StageCore<idl::stream::AxisBatch> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisBatch& out) override;
  void load(std::span<const double> state) override;
  void save(stream::StateValues& state) const override;

 private:
  std::vector<machine::GantryPair> pairs_;
  std::vector<std::size_t> master_index_;  // column of each master in the channel's batches
  std::vector<double> offsets_;
  bool own_columns_ = false;  // in the newest batch
};

}  // namespace trunnion::gantry
