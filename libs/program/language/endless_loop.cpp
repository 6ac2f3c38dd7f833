// SPDX-License-Identifier: Apache-2.0
#include "language/endless_loop.hpp"

namespace trunnion::language {

EndlessLoop::EndlessLoop(bool travel) : travel_(travel) {}

bool EndlessLoop::returns(const ReadingPlace& place, std::uint32_t main_line, const Variables& variables,
                          const AxisValues& position, const ModalState& modal) {
  ++count_;
  const bool same = place == place_ && (!travel_ || position == position_) && variables.same_as(*image_);
  // The first pass may begin in another modal state, and an alarm may be in the second. Frames are counted:
  // what makes one in each pass is never in the same state.
  if (same && (modal == modal_ || ++matches_ == 2)) {
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
