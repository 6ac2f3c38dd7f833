// SPDX-License-Identifier: Apache-2.0
// The state that a channel at rest hands over to the process that takes its place.
#include "channel_core.hpp"

namespace trunnion::channel {

std::optional<HandOver> ChannelCore::hand_over() const {
  if (homing_.active()) return std::nullopt;
  if (states_.busy() && !states_.in<Held>() && !states_.in<Interrupted>()) return std::nullopt;
  HandOver state;
  state.mode = mode_;
  state.program = selected().name;
  state.program_revision = selected().revision;
  state.modal = mdi_.modal();
  state.before_temporary = selection_.before_temporary();
  state.tool = tool_;
  state.switches = switches_;
  state.spindle_programmed = spindle_programmed_;
  state.reset_count = reset_count_;
  return state;
}

void ChannelCore::take_over(const HandOver& from) {
  mode_ = from.mode;
  mdi_.set_modal(from.modal);
  tool_ = from.tool;
  switches_ = from.switches;
  spindle_programmed_ = from.spindle_programmed;
  reset_count_ = from.reset_count;
  selection_.take_over(from.program, from.before_temporary);
}

}  // namespace trunnion::channel
