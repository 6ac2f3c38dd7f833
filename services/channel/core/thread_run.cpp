// SPDX-License-Identifier: Apache-2.0
#include "thread_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trunnion::channel {
namespace {

constexpr double least_share = 0.5;         // of S; the highest is that of the path
constexpr double standing_rate = 1.0 / 60;  // rev/s
constexpr double standing_seconds = 1, wrong_seconds = 10;

std::string speed_text(double speed) { return std::to_string(std::lround(speed)) + " 1/min"; }

}  // namespace

void ThreadRun::end() {
  phase_ = Phase::none;
  ended_ = braked_ = false;
  broken_.clear();
}

ThreadPath::Fault ThreadRun::begin(const AxisValues& start, std::span<const ThreadLeg> legs,
                                   const motion::Limits& limits, const ThreadSpindle& spindle) {
  const auto fault = path_.build(start, legs, spindle.speed, spindle.clockwise, limits);
  if (fault != ThreadPath::Fault::none) return fault;
  spindle_ = spindle;
  position_ = start;
  std::fill(rows_.begin(), rows_.end(), Row{});
  standing_ = wrong_ = 0;
  end();
  phase_ = Phase::waiting;
  return fault;
}

void ThreadRun::on_feedback(const idl::stream::Feedback& feedback) {
  const std::size_t spindles = feedback.spindle_speed.size();
  if (!cutting() || spindle_.column >= spindles) return;
  const bool counts = spindle_.column >= feedback.spindles.size() || feedback.spindles[spindle_.column].homed;
  for (std::uint32_t i = 0; i < feedback.count; ++i) {
    if ((i + 1) * spindles > feedback.spindle_angle.size()) break;
    const std::uint64_t cycle = feedback.first + i;
    rows_[cycle % rows] = {cycle, feedback.spindle_angle[i * spindles + spindle_.column], counts};
  }
}

// A straight line through the newest rows, least squares; angles are taken from the first of them, so that
// many turns cost no precision. The abscissas are -7.5 .. 7.5, whose squares add up to 340.
std::optional<ThreadRun::Prediction> ThreadRun::predict(std::uint64_t cycle) const {
  const std::uint64_t age = spindle_.lead + fitted;
  if (cycle < first_ + age) return std::nullopt;
  const std::uint64_t oldest = cycle - age;
  constexpr double middle = (fitted - 1) / 2.0, squares = fitted * (fitted * fitted - 1.0) / 12;
  const double from = rows_[oldest % rows].angle;
  double sum = 0, moment = 0;
  for (std::size_t i = 0; i < fitted; ++i) {
    const Row& row = rows_[(oldest + i) % rows];
    if (row.cycle != oldest + i) return std::nullopt;
    sum += row.angle - from;
    moment += (static_cast<double>(i) - middle) * (row.angle - from);
  }
  const double rate = moment / squares;
  return Prediction{from + sum / static_cast<double>(fitted) + rate * (static_cast<double>(age) - middle),
                    rate};
}

bool ThreadRun::homed(std::uint64_t cycle) const {
  return rows_[(cycle - spindle_.lead - fitted) % rows].homed;
}

bool ThreadRun::at_speed(const Prediction& prediction) const {
  const double nominal = spindle_.speed / 60 * spindle_.cycle_seconds;
  const double share = (spindle_.clockwise ? prediction.rate : -prediction.rate) / nominal;
  return share >= least_share && share <= path_.highest_share();
}

std::uint64_t ThreadRun::cycles(double seconds) const {
  return static_cast<std::uint64_t>(std::lround(seconds / spindle_.cycle_seconds));
}

void ThreadRun::break_off(std::string why) {
  if (broken_.empty()) broken_ = std::move(why);
}

void ThreadRun::supervise(const Prediction& prediction) {
  const double per_second = prediction.rate / spindle_.cycle_seconds;
  standing_ = std::abs(per_second) < standing_rate ? standing_ + 1 : 0;
  wrong_ = at_speed(prediction) ? 0 : wrong_ + 1;
  if (!broken_.empty()) return;
  if (standing_ > cycles(standing_seconds)) break_off("the spindle is at rest");
  if (phase_ == Phase::following ? wrong_ > 0 : wrong_ > cycles(wrong_seconds)) {
    const double speed = spindle_.clockwise ? spindle_.speed : -spindle_.speed;
    const double highest = path_.highest_share();
    break_off("the spindle turns at " + speed_text(per_second * 60) + ", S is " + speed_text(speed) +
              (highest < ThreadPath::speed_margin ? ", the axes can follow " + speed_text(highest * speed)
                                                  : std::string()));
  }
}

// The drive has the angles of a lead before the tool moves.
void ThreadRun::begin_batch(std::uint64_t cycle, bool stays) {
  if (phase_ != Phase::waiting || stays || !broken_.empty()) return;
  const auto prediction = predict(cycle);
  if (!prediction || !homed(cycle) || !at_speed(*prediction)) return;
  const double ahead = std::abs(prediction->rate) * static_cast<double>(spindle_.lead + spindle_.batch);
  path_.set_origin(path_.first_origin(prediction->angle, ahead));
  phase_ = Phase::following;
}

ThreadCycle ThreadRun::step(std::uint64_t cycle, bool abandoned, bool held) {
  ThreadCycle out;
  out.position = position_;
  const auto prediction = predict(cycle);
  if (prediction)
    supervise(*prediction);
  else if (cycle > first_ + cycles(standing_seconds))
    break_off("the drive reports no angles of the spindle");
  if (phase_ == Phase::waiting) {
    ended_ = ended_ || !broken_.empty();
    out.at_rest = abandoned || held || ended_;
    return out;
  }
  if (!prediction) {  // a hole in the feedback
    break_off("angles of the spindle are missing in the feedback");
    out.angle = angle_;
    out.at_rest = ended_ = true;
    return out;
  }
  if ((abandoned || !broken_.empty()) && !braked_) {
    path_.brake_from(prediction->angle);
    braked_ = true;
  }
  const ThreadPlace place = path_.at(prediction->angle);
  double square = 0;
  for (const double velocity : place.velocity) square += velocity * velocity;
  position_ = out.position = place.position;
  out.angle = angle_ = prediction->angle;
  out.leg = place.leg;
  out.fraction = place.fraction;
  out.speed = std::sqrt(square) * std::abs(prediction->rate) / spindle_.cycle_seconds;
  const bool stands = braked_ && std::abs(prediction->rate) / spindle_.cycle_seconds < standing_rate;
  ended_ = ended_ || path_.done(prediction->angle) || (stands && standing_ > fitted);
  out.at_rest = ended_;
  return out;
}

}  // namespace trunnion::channel
