// A stage whose arithmetic is wrong in one bit: what verification must find.
#pragma once

#include <bit>

#include "stream/stage_service.hpp"

namespace trunnion::variants {

inline constexpr std::uint64_t wrong_cycle = 700;

/// As `Core`, but the last bit of the first axis's setpoint of one cycle is flipped.
template <class Core, class In>
class OneBitOff : public Core {
 public:
  bool process(const In& in, const stream::FeedbackWindow& feedback, idl::stream::AxisFrame& out) override {
    if (!Core::process(in, feedback, out)) return false;
    if (in.channel == 0 && wrong_cycle >= in.first && wrong_cycle < in.first + in.count) {
      auto& value = out.setpoints[(wrong_cycle - in.first) * out.axes.size()];
      value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1);
    }
    return true;
  }
};

}  // namespace trunnion::variants
