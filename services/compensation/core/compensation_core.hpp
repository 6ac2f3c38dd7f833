// SPDX-License-Identifier: Apache-2.0
// Compensation of errors in machine setpoints: positive values move the axis in positive direction.
// docs/compensation.md has the formulas and their sources.
#pragma once

#include <array>
#include <vector>

#include "compensation/axis_motion.hpp"
#include "compensation/channel_compensation.hpp"
#include "stream/stage_core.hpp"
#include "volumetric_stage.hpp"

namespace trunnion::compensation {

/// The slave of a gantry has its own tables. When it or its master is compensated, its compensated setpoint
/// becomes a column of the batches, behind the channel's axes; gantry then only corrects it.
/// State per axis, slaves last: last uncompensated setpoint, direction of the last move (-1, 0, 1), backlash
/// added now. With thermal, rapid-traverse, reversal or volumetric compensation in addition: for each axis
/// the setpoint of the newest cycle, thermal offset and slope, cycles since the reversal; the epoch; the
/// volumetric state; the number of axes.
class CompensationCore : public stream::StageCore<idl::stream::AxisBatch> {
 public:
  void configure(const machine::Parameters& parameters, std::uint16_t channel) override;
  bool process(const idl::stream::AxisBatch& in, const stream::FeedbackWindow& feedback,
               idl::stream::AxisBatch& out) override;
  void load(std::span<const double> state) override;
  void save(stream::StateValues& state) const override;

 private:
  static constexpr std::size_t most_axes = ChannelCompensation::most_axes;
  static constexpr std::size_t base_state = 3, further_state = 4;

  struct Axis : AxisCompensation {
    AxisMotion motion;
    double previous = 0;  // setpoint of the newest cycle
  };

  void compensate(const double* x, double* to);
  std::size_t further_count() const;

  std::vector<Axis> axes_;                 // of the channel, then the slaves
  std::vector<CompensatedSlave> slaves_;   // those that are compensated
  std::vector<AngleCompensation> angles_;  // of all axes
  std::vector<std::uint8_t> letters_;      // 0 .. 8 of the channel's axes
  VolumetricStage volume_;
  bool cross_tables_ = false;
  bool primed_ = false;                           // false until the first setpoint gives the axes' positions
  bool needs_further_ = false, further_ = false;  // the parameters need, the state has the additional part
  double epoch_ = 0;
};

}  // namespace trunnion::compensation
