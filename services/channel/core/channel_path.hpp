// SPDX-License-Identifier: Apache-2.0
// A trajectory together with the frame its positions are in.
#pragma once

#include <memory>

#include "channel_setup/channel_setup.hpp"
#include "motion/trajectory.hpp"

namespace trunnion::channel {

using language::AxisValues;

class ChannelPath {
 public:
  /// `machine` must outlive the path and be configured before build().
  explicit ChannelPath(const channel_setup::ChannelSetup& machine) : machine_(machine) {}

  /// A new trajectory within `limits`; start() before it is used.
  void build(const motion::Limits& limits);
  /// At rest at `position`, in the frame of `transformation` and `tool_length` (mm).
  void start(const AxisValues& position, language::Transformation transformation, double tool_length);
  /// At rest in machine coordinates.
  void start(const AxisValues& machine) { start(machine, language::Transformation::none, 0); }
  /// At rest where it is: what was executed cannot be retraced any more.
  void restart() { start(trajectory_->position(), transformation_, tool_length_); }
  /// The trajectory was started by the program flow, in this frame.
  void adopt_frame(language::Transformation transformation, double tool_length);

  motion::Trajectory& trajectory() { return *trajectory_; }
  const motion::Trajectory& trajectory() const { return *trajectory_; }
  language::Transformation transformation() const { return transformation_; }
  bool rtcp() const { return transformation_ == language::Transformation::rtcp; }
  double tool_length() const { return tool_length_; }
  /// Last setpoint, in the path's frame.
  const AxisValues& position() const { return trajectory_->position(); }
  /// The same in machine coordinates.
  AxisValues machine_position() const { return machine_of(position()); }
  AxisValues machine_of(const AxisValues& path) const;
  AxisValues path_of(const AxisValues& machine) const;

 private:
  const channel_setup::ChannelSetup& machine_;
  std::unique_ptr<motion::Trajectory> trajectory_;
  language::Transformation transformation_ = language::Transformation::none;
  double tool_length_ = 0;
};

}  // namespace trunnion::channel
