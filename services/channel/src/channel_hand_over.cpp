// What the process that takes a channel's place at rest is told, and what it does with it.
#include "channel_core.hpp"

namespace trunnion::channel {

std::optional<HandOver> ChannelCore::hand_over() const {
  if (activity_ != Activity::none && run_ != RunState::HELD && run_ != RunState::INTERRUPTED)
    return std::nullopt;
  return HandOver{
      mode_,           selected_.name,    selected_.revision,  modal_,        tool_,          feed_override_,
      rapid_override_, spindle_override_, spindle_programmed_, single_block_, optional_stop_, reset_count_};
}

void ChannelCore::take_over(const HandOver& from) {
  mode_ = from.mode;
  modal_ = from.modal;
  tool_ = from.tool;
  feed_override_ = from.feed_override, rapid_override_ = from.rapid_override;
  spindle_override_ = from.spindle_override, spindle_programmed_ = from.spindle_programmed;
  single_block_ = from.single_block, optional_stop_ = from.optional_stop;
  reset_count_ = from.reset_count;
  for (const auto& entry : programs_.programs)
    if (entry.name == from.program) selected_ = entry;
}

}  // namespace trunnion::channel
