// SPDX-License-Identifier: Apache-2.0
#include "motion/interpolation.hpp"

#include <cmath>

namespace trunnion::motion {

using canonical::axis_count;

void Interpolation::start(const AxisValues& position) {
  position_ = position;
  line_ = sequence_ = 0;
  fraction_ = 0;
  tail_.reset();
}

void Interpolation::pass_cycle() {
  if (!tail_) return;
  tail_->motion.time -= cycle_;
  if (tail_->motion.time <= 0) tail_.reset();
}

Setpoint Interpolation::follow(const BlendedPath& path, const PathPlace& place) {
  const PathBlock& block = path[place.block];
  const AxisValues before = position_;
  if (place.started) position_ = path.position(place.block, place.s);
  if (tail_) {
    const Tail& tail = tail_->motion;
    const double rest = tail.jerk * tail.time * tail.time * tail.time / 6;
    const AxisValues near = path.position(tail_->block, tail.end - rest);
    const AxisValues corner = path.position(tail_->block, tail.end);
    for (std::size_t i = 0; i < axis_count; ++i) position_[i] += near[i] - corner[i];
  }
  const double done =
      place.s >= block.end() ? (place.waiting ? 0 : 1) : (place.s - block.at) / block.path.length();
  line_ = block.line;
  sequence_ = block.sequence;
  fraction_ = block.fraction_offset + (block.fraction_end - block.fraction_offset) * done;
  Setpoint setpoint;
  setpoint.position = position_;
  for (std::size_t i = 0; i < axis_count; ++i)
    setpoint.distance_to_go[i] = block.path.target()[i] - position_[i];
  setpoint.line = line_;
  setpoint.sequence = sequence_;
  setpoint.fraction = fraction_;
  setpoint.feed =
      std::hypot(position_[0] - before[0], position_[1] - before[1], position_[2] - before[2]) / cycle_;
  setpoint.path_speed = place.speed;
  setpoint.programmed_speed = block.rapid ? 0 : block.feed;
  setpoint.rapid = block.rapid;
  setpoint.dwelling = place.waiting;
  return setpoint;
}

Setpoint Interpolation::stay() {
  Setpoint setpoint;
  setpoint.position = position_;
  setpoint.line = line_;
  setpoint.sequence = sequence_;
  setpoint.fraction = fraction_;
  return setpoint;
}

}  // namespace trunnion::motion
