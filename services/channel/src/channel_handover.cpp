// SPDX-License-Identifier: Apache-2.0
// The state that a channel at rest hands over to the process that takes its place.
#include "channel_core.hpp"

namespace trunnion::channel {

std::optional<HandOver> ChannelCore::hand_over() const {
  if (homing_) return std::nullopt;
  if (states_.busy() && !states_.in<Held>() && !states_.in<Interrupted>()) return std::nullopt;
  HandOver state;
  state.mode = mode_;
  state.program = selected_.name;
  state.program_revision = selected_.revision;
  state.modal = mdi_.modal;
  state.tool = tool_;
  state.feed_override = switches_.feed_override;
  state.rapid_override = switches_.rapid_override;
  state.spindle_override = switches_.spindle_override;
  state.spindle_programmed = spindle_programmed_;
  state.single_block = switches_.single_block;
  state.optional_stop = switches_.optional_stop;
  state.reset_count = reset_count_;
  return state;
}

void ChannelCore::take_over(const HandOver& from) {
  mode_ = from.mode;
  mdi_.modal = from.modal;
  tool_ = from.tool;
  switches_.feed_override = from.feed_override;
  switches_.rapid_override = from.rapid_override;
  switches_.spindle_override = from.spindle_override;
  spindle_programmed_ = from.spindle_programmed;
  switches_.single_block = from.single_block;
  switches_.optional_stop = from.optional_stop;
  reset_count_ = from.reset_count;
  for (const auto& entry : programs_.programs)
    if (entry.name == from.program) selected_ = entry;
}

}  // namespace trunnion::channel
