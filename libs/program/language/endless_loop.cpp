// SPDX-License-Identifier: Apache-2.0
#include "language/endless_loop.hpp"

namespace trunnion::language {

EndlessLoop::EndlessLoop(bool travel, std::uint64_t most_returns)
    : travel_(travel), most_returns_(most_returns) {}

bool EndlessLoop::returns(const ReadingPlace& place, std::uint32_t main_line, const Variables& variables,
                          const AxisValues& position, const ModalState& modal) {
  ++count_;
  const bool reads_own = variables.own_state_read_since(*image_);
  const bool everywhere = !travel_ && !reads_own;
  const bool same = place == place_ && (everywhere || position == position_) && variables.same_as(*image_);
  // The first pass may begin in another modal state, and an alarm may be in the second. Frames are counted:
  // what makes one in each pass is never in the same state.
  const bool certain = same && (modal == modal_ || (!reads_own && ++matches_ == 2));
  gave_up_ = !certain && count_ > most_returns_;
  if (certain || gave_up_) {
    line_ = main_line;
    return true;
  }
  if (count_ == next_) {
    next_ *= 2;
    matches_ = 0;
    place_ = place;
    position_ = position;
    modal_ = modal;
    variables.copy_to(*image_);
  }
  return false;
}

}  // namespace trunnion::language
