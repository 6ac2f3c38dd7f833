// SPDX-License-Identifier: Apache-2.0
// A stage whose arithmetic is wrong in one bit: what verification must find.
#pragma once

#include <bit>

#include "stream/stage_service.hpp"

namespace trunnion::variants {

/// The first cycle that is wrong, and every `wrong_again` cycles one more.
inline constexpr std::uint64_t wrong_cycle = 700, wrong_again = 1000;

/// As `Core`, but the last bit of the first axis's setpoint of those cycles is flipped.
template <class Core, class In>
class OneBitOff : public Core {
 public:
  bool process(const In& in, const stream::FeedbackWindow& feedback, idl::stream::AxisBatch& out) override {
    if (!Core::process(in, feedback, out)) return false;
    for (std::uint64_t row = 0; row < in.count && in.channel == 0; ++row) {
      if ((in.first + row) % wrong_again != wrong_cycle) continue;
      auto& value = out.setpoints[row * out.axes.size()];
      value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1);
    }
    return true;
  }
};

}  // namespace trunnion::variants
