#include "motion/interpolator.hpp"

#include <algorithm>

namespace trunnion::motion {

Interpolator::Interpolator(int cycles) : cycles_(std::clamp(cycles, 1, max_smoothing_cycles)) {}

void Interpolator::reset(const AxisValues& position) { ring_.fill(position); }

AxisValues Interpolator::step(const AxisValues& position) {
  ring_[static_cast<std::size_t>(next_)] = position;
  next_ = next_ + 1 == cycles_ ? 0 : next_ + 1;
  AxisValues sum{};
  int slot = next_;  // the oldest first, wherever the ring stands, so that the order never depends on history
  for (int k = 0; k < cycles_; ++k) {
    const AxisValues& entry = ring_[static_cast<std::size_t>(slot)];
    for (std::size_t i = 0; i < language::axis_count; ++i) sum[i] += entry[i] - position[i];
    slot = slot + 1 == cycles_ ? 0 : slot + 1;
  }
  AxisValues mean = position;
  for (std::size_t i = 0; i < language::axis_count; ++i) mean[i] += sum[i] / cycles_;
  return mean;
}

}  // namespace trunnion::motion
