// SPDX-License-Identifier: Apache-2.0
#include "spindle_watch.hpp"

#include <cmath>

namespace trunnion::channel {

void SpindleWatch::on_feedback(const idl::stream::Feedback& feedback) {
  speeds_.assign(feedback.spindle_speed.begin(), feedback.spindle_speed.end());
  gears_.clear();
  for (const auto& spindle : feedback.spindles) gears_.push_back(spindle.gear);
  if (waits_) ++messages_;
}

// Two messages of a drive that have travelled to two processes may arrive in another order than theirs.
SpindleWatch::Rest SpindleWatch::rest(std::size_t column) {
  const bool rests = std::abs(speed(column)) <= standstill;
  if (!waits_) messages_ = 0;
  waits_ = !rests && messages_ < most_waits;
  return rests ? Rest::rests : waits_ ? Rest::waits : Rest::turns;
}

}  // namespace trunnion::channel
