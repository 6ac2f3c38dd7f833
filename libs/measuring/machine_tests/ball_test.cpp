// SPDX-License-Identifier: Apache-2.0
#include "machine_tests/ball_test.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "canonical/axes.hpp"
#include "identification/true_tips.hpp"
#include "machine/kinematics.hpp"
#include "machine_tests/sampled_motion.hpp"

namespace trunnion::machine_tests {
namespace {

using canonical::axis_letters;
using identification::BallSample;
using servo_analysis::ChannelMotion;
using truth::Vec3;

constexpr std::uint16_t turn_decimation = 4, stop_decimation = 40;  // 2 kHz, 200 Hz
constexpr double share_of_travel = 0.9;

geometry::Chain chain_of(const ServoSession& session, std::uint16_t channel) {
  return machine::make_chain(session.parameters(), channel);
}

}  // namespace

BallTest::BallTest(ServoSession& session, const BallOptions& options)
    : session_(session),
      options_(options),
      machine_(identification::load_true_machine(session.machine_directory(), options.channel, {})),
      set_{machine_.outline, chain_of(session, options.channel)} {
  const auto& axis = session_.axis(options_.axis);
  set_.axis = axis_letters.find(axis.letter);
  if (set_.axis == std::string_view::npos || set_.axis < 3 || !set_.model.turns(set_.axis - 3))
    throw std::runtime_error("--axis " + options_.axis + ": no rotary axis of the transformation");
  for (const auto& a : session_.axes())
    if (const auto index = axis_letters.find(a.letter); index > 2 && index < axis_letters.size())
      set_.held[index - 3] = a.place;
  for (const auto& word : options_.hold)
    if (!identification::hold_axis(set_, word))
      throw std::runtime_error("--hold " + word + ": expected another rotary axis and its angle, as A-30");
  set_.tool_length = session_.tool_length(options_.tool);
  const double low = axis.low, high = axis.high;
  const bool endless = !(high - low < 360);
  set_.sweep = options_.sweep.value_or(endless ? 360 : share_of_travel * (high - low));
  start_ = options_.start.value_or(endless ? 0 : low + (high - low) * (1 - share_of_travel) / 2);
  if (!endless && (start_ < low || start_ > high || start_ + set_.sweep < low || start_ + set_.sweep > high))
    throw std::runtime_error(
        fmt::format("axis {} cannot turn from {:.3f} to {:.3f} deg: its travel is {:.3f} .. {:.3f}",
                    axis.letter, start_, start_ + set_.sweep, low, high));
  find_circle();
  check_travel(start_);
  take_model(machine_, session_.parameters(), options_.channel);
  machine_.report->tool_length = set_.tool_length;
  sensor_.emplace(options_.source == "true" ? identification::instrument(machine_, "rtest")
                                            : truth::InstrumentTruth{});
}

void BallTest::find_circle() {
  if (const auto error = identification::place_ball(set_, options_.ball, start_, linear_place(session_)))
    throw std::runtime_error("--axis " + options_.axis +
                             ": the ball has no circle about the axis: " + metrology::to_string(*error));
}

void BallTest::check_travel(double start) const {
  if (const auto left = identification::left_travel(set_, linear_axes(session_), start))
    throw std::runtime_error(fmt::format(
        "axis {} would go to {:.3f} mm at {}{:.1f}, its travel is {:.3f} .. {:.3f}: choose "
        "--ball, --radius, --start or --sweep",
        left->axis.letter, left->place, options_.axis[0], left->angle, left->axis.low, left->axis.high));
}

ChannelMotion BallTest::sampled(const std::string& program, std::uint16_t decimation) {
  auto motion = run_sampled(session_, program, "XYZ" + options_.axis, decimation);
  std::copy(set_.held.begin(), set_.held.end(), motion.resting.begin() + 3);
  return motion;
}

BallMotion BallTest::run(double feed, double start) {
  check_travel(start);
  const auto& axis = session_.axis(options_.axis);
  const double turning = feed / set_.radius * 180 / std::numbers::pi;  // deg/min
  if (turning > axis.highest_feed)
    throw std::runtime_error(
        fmt::format("--feed {:g}: axis {} would turn with {:.0f} deg/min, its limit is {:.0f}", feed,
                    axis.letter, turning, axis.highest_feed));
  const auto motion =
      sampled(identification::ball_turn_program(set_, program(), start, turning), turn_decimation);
  auto predicted = identification::predict_servos(motion, set_.radius);
  const auto samples = read(motion, &predicted);
  const double way = set_.sweep > 0 ? std::abs(set_.sweep) : -std::abs(set_.sweep);
  BallMotion result;
  result.servos = std::move(predicted.servos);
  result.there = turned_by(way, samples, motion.interval);
  result.back = turned_by(-way, samples, motion.interval);
  return result;
}

std::vector<BallSample> BallTest::read(const ChannelMotion& motion,
                                       const identification::PredictedMotion* predicted) {
  const auto tips =
      options_.source == "true" ? identification::true_tips(motion, *machine_.report) : std::vector<Vec3>{};
  return identification::read_ball(set_, motion, tips, *sensor_, predicted);
}

identification::BallTurn BallTest::turned_by(double way, const std::vector<BallSample>& samples,
                                             double interval) const {
  auto turn = identification::turn_between_rests(samples, interval, way);
  if (!turn)
    throw std::runtime_error(
        fmt::format("axis {} has not turned by {:.1f} deg between two rests", options_.axis, way));
  return *std::move(turn);
}

std::vector<BallSample> BallTest::stop(std::size_t stops, double start) {
  check_travel(start);
  const auto motion =
      sampled(identification::ball_stops_program(set_, program(), start, stops), stop_decimation);
  const auto samples = read(motion, nullptr);
  auto means = identification::means_at_stops(set_, samples, motion.interval, start, stops);
  if (means.size() != stops) throw std::runtime_error("the axis did not come to rest at every stop");
  return means;
}

}  // namespace trunnion::machine_tests
