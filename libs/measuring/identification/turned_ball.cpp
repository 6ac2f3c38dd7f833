// SPDX-License-Identifier: Apache-2.0
#include "identification/turned_ball.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/angle.hpp"

namespace trunnion::identification {
namespace {

using servo_analysis::ChannelMotion;
using truth::Vec3;

constexpr double still = 1e-6;                      // deg between two samples
constexpr double rest_time = 0.2, mean_time = 0.1;  // s
constexpr double near_ball = 1;                     // mm: more than compensations move an axis
constexpr double whole_way = 0.01;                  // deg
constexpr double at_stop = 1e-3;                    // deg
// Of the largest speed of an axis: slower axes have no servo to identify.
constexpr double least_share_of_speed = 0.02;

// Highest speed of each axis, of a rotary one that of the ball on its circle.
std::array<double, canonical::axis_count> highest_speeds(const ChannelMotion& motion, double radius) {
  std::array<double, canonical::axis_count> speeds{};
  for (std::size_t axis = 0; axis < canonical::axis_count; ++axis) {
    for (const double v : motion.traces[axis].speed) speeds[axis] = std::max(speeds[axis], std::abs(v));
    if (axis > 2) speeds[axis] *= radius * geometry::radians_per_degree;
  }
  return speeds;
}

bool is_at_ball(const ChannelMotion& motion, const Vec3& ball, std::size_t i) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(motion.commanded(k, i) - ball[static_cast<Eigen::Index>(k)]) > near_ball) return false;
  return true;
}

// `end`: behind the motion that begins at `begin`; `rest`: samples of the rest before it.
BallTurn turn_of(const std::vector<BallSample>& samples, double interval, std::size_t begin, std::size_t end,
                 std::size_t rest) {
  BallTurn turn;
  turn.interval = interval;
  turn.samples.assign(samples.begin() + static_cast<std::ptrdiff_t>(begin - 1),
                      samples.begin() + static_cast<std::ptrdiff_t>(end));
  const auto middle = turn.samples.size() / 2;
  turn.speed = (turn.samples[middle].turned - turn.samples[middle - 1].turned) / interval *
               geometry::radians_per_degree;
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  for (std::size_t i = begin - rest; i < begin - 1; ++i) {
    sum += samples[i].deviation, squares += samples[i].deviation.cwiseAbs2();
  }
  const auto n = static_cast<double>(rest - 1);
  turn.noise = (squares / n - (sum / n).cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  return turn;
}

}  // namespace

PredictedMotion predict_servos(const ChannelMotion& motion, double radius) {
  PredictedMotion predicted;
  const auto speeds = highest_speeds(motion, radius);
  const double fastest = *std::max_element(speeds.begin(), speeds.end());
  for (std::size_t axis = 0; axis < canonical::axis_count; ++axis) {
    const auto& trace = motion.traces[axis];
    if (trace.size() == 0 || speeds[axis] < least_share_of_speed * fastest) continue;
    ServoOfAxis servo{canonical::axis_letters[axis], servo_analysis::fit_servo_response(trace), 0};
    auto& positions = predicted.positions[axis];
    positions = servo_analysis::predicted_positions(servo.response, trace.setpoint, trace.interval);
    for (std::size_t i = 0; i < trace.size(); ++i)
      servo.prediction_error += std::pow(positions[i] - trace.feedback[i], 2);
    servo.prediction_error = std::sqrt(servo.prediction_error / static_cast<double>(trace.size()));
    predicted.servos.push_back(servo);
  }
  return predicted;
}

std::vector<BallSample> read_ball(const TurnedBall& set, const ChannelMotion& motion,
                                  const std::vector<Vec3>& tips, truth::Instrument& sensor,
                                  const PredictedMotion* predicted) {
  const auto nest = truth::Nest::at(Vec3::Zero());
  std::vector<BallSample> samples(motion.count);
  double turned = 0;
  for (std::size_t i = 0; i < motion.count; ++i) {
    auto& s = samples[i];
    geometry::Angles real{}, model_angles{};
    Vec3 at, model_at, commanded;
    for (std::size_t axis = 0; axis < canonical::axis_count; ++axis) {
      const bool has_model = predicted != nullptr && !predicted->positions[axis].empty();
      const double modelled = has_model ? predicted->positions[axis][i] : motion.commanded(axis, i);
      if (axis < 3) {
        const auto k = static_cast<Eigen::Index>(axis);
        at[k] = motion.feedback(axis, i), model_at[k] = modelled, commanded[k] = motion.commanded(axis, i);
      } else {
        s.angles[axis - 3] = motion.commanded(axis, i);
        real[axis - 3] = motion.feedback(axis, i), model_angles[axis - 3] = modelled;
      }
    }
    if (i > 0) {
      const double step = s.angles[set.axis - 3] - samples[i - 1].angles[set.axis - 3];
      turned += step - 360 * std::round(step / 360);
    }
    s.turned = turned;
    s.place = set.model.machine_from_tip(set.ball, s.angles, set.tool_length);
    s.at_ball = is_at_ball(motion, s.place, i);
    const Vec3 tip = tips.empty() ? set.model.tip_from_machine(at, real, set.tool_length) : tips[i];
    auto sensors = nest.readings(set.model.machine_from_tip(tip, s.angles, set.tool_length) - s.place);
    for (double& reading : sensors) reading = sensor.read(reading);
    s.deviation = nest.place(sensors);
    if (predicted == nullptr) continue;
    const Vec3 lagging = set.model.tip_from_machine(model_at, model_angles, set.tool_length);
    s.following = set.model.machine_from_tip(lagging, s.angles, set.tool_length) - commanded;
  }
  return samples;
}

std::optional<BallTurn> turn_between_rests(const std::vector<BallSample>& samples, double interval,
                                           double way) {
  const auto moves_at = [&](std::size_t i) {
    return i > 0 && std::abs(samples[i].turned - samples[i - 1].turned) > still;
  };
  const auto rest = static_cast<std::size_t>(rest_time / interval);
  std::size_t begin = 0;
  while (begin < samples.size()) {
    while (begin < samples.size() && !moves_at(begin)) ++begin;
    std::size_t end = begin;
    std::size_t quiet = 0;
    while (end < samples.size() && quiet < rest) quiet = moves_at(end) ? 0 : quiet + 1, ++end;
    const std::size_t last = end - quiet;
    if (begin == 0 || last <= begin) break;
    const double moved = samples[last - 1].turned - samples[begin - 1].turned;
    if (begin > rest && std::abs(moved - way) < whole_way)
      return turn_of(samples, interval, begin, last, rest);
    begin = end;
  }
  return std::nullopt;
}

std::vector<BallSample> means_at_stops(const TurnedBall& set, const std::vector<BallSample>& samples,
                                       double interval, double start, std::size_t stops) {
  const auto mean = static_cast<std::size_t>(mean_time / interval);
  const auto rest = static_cast<std::size_t>(rest_time / interval);
  std::vector<BallSample> means;
  std::size_t quiet = 0;
  for (std::size_t i = 1; i < samples.size() && means.size() < stops; ++i) {
    const bool moving = std::abs(samples[i].turned - samples[i - 1].turned) > still ||
                        (samples[i].place - samples[i - 1].place).norm() > 0;
    const double wanted = set.sweep * static_cast<double>(means.size()) / static_cast<double>(stops);
    const double off = samples[i].angles[set.axis - 3] - start - wanted;
    quiet = moving || std::abs(off - 360 * std::round(off / 360)) > at_stop || !samples[i].at_ball
                ? 0
                : quiet + 1;
    if (quiet < rest) continue;
    BallSample sample = samples[i];
    sample.deviation.setZero();
    for (std::size_t k = i + 1 - mean; k <= i; ++k)
      sample.deviation += samples[k].deviation / static_cast<double>(mean);
    sample.turned = wanted;
    means.push_back(sample);
    quiet = 0;
  }
  return means;
}

}  // namespace trunnion::identification
