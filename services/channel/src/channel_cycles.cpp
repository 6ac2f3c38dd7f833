// Moves that are more than a path: those a skip input ends, and those a spindle follows.
#include "channel_core.hpp"

namespace trunnion::channel {

// The axes stand, and nothing is read on before the move has ended.
void ChannelCore::begin_skip() {
  const auto input = flow().pending().number;
  if (flow().push_pending() != FlowState::alarm) skip_.begin(input);
}

void ChannelCore::finish_skip() {
  SkipResult result;
  result.stopped = result.touched = trajectory_->position();
  if (const auto& touch = skip_.touch()) {
    // The path at the cycle of the edge, and how far the axes were off it when the input came on.
    AxisValues at = written_[touch->cycle % history].position;
    const bool tip = frame_ == language::Transformation::rtcp;
    if (tip) at = machine_.machine_from_tip(at, frame_tool_length_);
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += touch->deviation[i];
    result.touched = tip ? machine_.tip_from_machine(at, frame_tool_length_) : at;
  }
  skip_.end();
  flow().skip_ended(result);
}

void ChannelCore::begin_tapping() {
  const auto& spindle = machine_.tapping_spindle(flow().pending().number);
  if (!spindle.axis) {
    flow().refuse_pending(language::AlarmNumber::tapping_spindle_missing);
    return;
  }
  tapping_.begin(trajectory_->position(), flow().pending());
  trajectory_->set_limits(tapping_.limits(path_limits_, spindle.acceleration));
  trajectory_->start(trajectory_->position(), frame_, frame_tool_length_);
  flow().set_tapping(true);
}

void ChannelCore::finish_tapping() {
  if (!tapping_.active()) return;
  tapping_.end();
  flow().set_tapping(false);
  trajectory_->set_limits(path_limits_);
  trajectory_->start(trajectory_->position(), frame_, frame_tool_length_);
}

}  // namespace trunnion::channel
