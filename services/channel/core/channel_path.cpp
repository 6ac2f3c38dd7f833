// SPDX-License-Identifier: Apache-2.0
#include "channel_path.hpp"

namespace trunnion::channel {

void ChannelPath::build(const motion::Limits& limits) {
  trajectory_ = std::make_unique<motion::Trajectory>(limits, &machine_.chain(), machine_.cycle_seconds());
  adopt_frame(language::Transformation::none, 0);
}

void ChannelPath::start(const AxisValues& position, language::Transformation transformation,
                        double tool_length) {
  adopt_frame(transformation, tool_length);
  // `position` may be the trajectory's own, which start() writes.
  const AxisValues from = position;
  trajectory_->start(from, transformation, tool_length);
}

void ChannelPath::adopt_frame(language::Transformation transformation, double tool_length) {
  transformation_ = transformation;
  tool_length_ = tool_length;
}

AxisValues ChannelPath::machine_of(const AxisValues& path) const {
  return rtcp() ? machine_.machine_from_tip(path, tool_length_) : path;
}

AxisValues ChannelPath::path_of(const AxisValues& machine) const {
  return rtcp() ? machine_.tip_from_machine(machine, tool_length_) : machine;
}

}  // namespace trunnion::channel
