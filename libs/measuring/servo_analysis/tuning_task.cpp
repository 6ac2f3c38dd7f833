// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/tuning_task.hpp"

#include <algorithm>

#include "machine/parameter_constants.hpp"

namespace trunnion::servo_analysis {

const TestedAxis* partner_of(const std::vector<TestedAxis>& axes, const TestedAxis& axis) {
  if (axis.turns || axis.letter < 'X' || axis.letter > 'Z') return nullptr;
  for (const auto& other : axes)
    if (other.number != axis.number && other.letter >= 'X' && other.letter <= 'Z' && !other.turns)
      return &other;
  return nullptr;
}

TuningTask tuning_task(const machine::Parameters& p, const TestedAxis& axis, const TestedAxis* partner,
                       double amplitude) {
  TuningTask task;
  task.current = ServoSettings::from(p, axis.number);
  task.amplitude = amplitude;
  task.acceleration = axis.acceleration;
  task.rated_acceleration = 1.5 * axis.acceleration;
  task.highest_feed = axis.highest_feed;
  task.current_time_constant = p.get(parameter::current_time_constant, axis.number);
  task.full_closed_loop = p.integer(parameter::full_closed_loop, axis.number) != 0;
  task.travel = std::min(40.0, std::max(axis.high - axis.place, axis.place - axis.low));
  task.circles = partner != nullptr;
  if (partner != nullptr) {
    const double space = std::min(partner->high - partner->place, partner->place - partner->low);
    task.circles = space >= 5;
    if (task.circles) task.travel = std::min(task.travel, 2 * space);
  }
  return task;
}

}  // namespace trunnion::servo_analysis
