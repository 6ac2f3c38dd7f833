// SPDX-License-Identifier: Apache-2.0
#include "thread_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trunnion::channel {
namespace {

// Of S; the highest is that of the path. With the lowest override the PLC orders half of S, less the part of
// 1/min, and the spindle may be slower than that.
constexpr double least_share = 0.45, least_share_of_low_speeds = 0.25;
constexpr double part_of_order = 1;         // 1/min
constexpr double standing_rate = 1.0 / 60;  // rev/s
constexpr double standing_seconds = 1, wrong_seconds = 10;
constexpr double turns_to_mark = 2;  // in which the index mark must have passed

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
  standing_ = wrong_ = unmarked_ = 0;
  turned_ = 0;
  newest_.reset();
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

double ThreadRun::speed_of(const Prediction& prediction) const {
  const double speed = prediction.rate / spindle_.cycle_seconds * 60;
  return spindle_.clockwise ? speed : -speed;
}

bool ThreadRun::at_speed(const Prediction& prediction) const {
  const double speed = speed_of(prediction), nominal = spindle_.speed;
  const double least = std::max(least_share * nominal - part_of_order, least_share_of_low_speeds * nominal);
  return speed >= least && speed <= path_.highest_share() * nominal;
}

std::string ThreadRun::waits_for() const {
  if (phase_ != Phase::waiting || !newest_ || !broken_.empty()) return "";
  if (!at_speed(*newest_))
    return "the thread waits for the spindle: it turns at " + speed_text(speed_of(*newest_)) + ", S is " +
           speed_text(spindle_.speed);
  return unmarked_ > 0 ? "the thread waits for the index mark of the spindle" : "";
}

std::uint64_t ThreadRun::cycles(double seconds) const {
  return static_cast<std::uint64_t>(std::lround(seconds / spindle_.cycle_seconds));
}

void ThreadRun::break_off(std::string why) {
  if (broken_.empty()) broken_ = std::move(why);
}

// The mark passes in every revolution. A slow spindle may take longer than a wrong speed is waited for.
void ThreadRun::await_mark(std::uint64_t cycle, const Prediction& prediction) {
  const bool passed = homed(cycle);
  unmarked_ = passed ? 0 : unmarked_ + 1;
  turned_ = passed ? 0 : turned_ + std::abs(prediction.rate);
  if (unmarked_ > cycles(wrong_seconds) && turned_ > turns_to_mark)
    break_off("no index mark of the spindle has passed in " + std::to_string(std::lround(turned_)) +
              " revolutions: see its encoder");
}

void ThreadRun::supervise(std::uint64_t cycle, const Prediction& prediction) {
  newest_ = prediction;
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
  if (phase_ == Phase::waiting) await_mark(cycle, prediction);
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
    supervise(cycle, *prediction);
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
