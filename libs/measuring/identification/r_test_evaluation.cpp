// SPDX-License-Identifier: Apache-2.0
#include "identification/r_test_evaluation.hpp"

#include <algorithm>
#include <cmath>

namespace trunnion::identification {
namespace {

using truth::Vec3;
constexpr std::size_t highest_order = 200, most_readings = 2000;

// Any direction across `axis`.
Vec3 across(const Vec3& axis) {
  const Vec3 other = std::abs(axis.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  return (other - axis * axis.dot(other)).normalized();
}

Vec3 tangent(const TurnedBall& set, const Vec3& place) {
  Vec3 radial = place - set.centre;
  radial -= set.direction * set.direction.dot(radial);
  return set.direction.cross(radial).normalized();
}

std::vector<Vec3> filtered(const TurnedBall& set, const BallTurn& turn, const std::vector<Vec3>& deviations,
                           double cutoff) {
  Vec3 mean = Vec3::Zero();
  for (const auto& d : deviations) mean += d / static_cast<double>(deviations.size());
  const Vec3 first = across(set.direction), second = set.direction.cross(first);
  circular_tests::RotatingErrorFilter::Settings settings;
  settings.interval = turn.interval, settings.speed = turn.speed, settings.cutoff = cutoff;
  settings.variance_x = std::pow(first.cwiseAbs().dot(turn.noise), 2) + 1e-18;
  settings.variance_y = std::pow(second.cwiseAbs().dot(turn.noise), 2) + 1e-18;
  circular_tests::RotatingErrorFilter filter(settings);
  std::vector<Vec3> out;
  out.reserve(deviations.size());
  for (const auto& d : deviations) {
    const Vec3 about = d - mean;
    const auto [x, y] = filter.next(first.dot(about), second.dot(about));
    out.push_back(mean + first * x + second * y + set.direction * set.direction.dot(about));
  }
  return out;
}

}  // namespace

RTestResult evaluate_turn(const TurnedBall& set, const BallTurn& turn, const RTestSettings& settings) {
  RTestResult r;
  std::vector<Vec3> without_servo;
  const double begin = turn.samples.front().turned;
  for (const auto& s : turn.samples) {
    r.angles.push_back(s.turned - begin);
    r.read.push_back(s.deviation);
    without_servo.push_back(s.deviation - s.following);
  }
  r.cleaned = filtered(set, turn, without_servo, settings.cutoff);
  if (std::abs(std::abs(set.sweep) - 360) < 1e-6) {
    std::vector<double> tangential;
    for (std::size_t i = 0; i < r.cleaned.size(); ++i)
      tangential.push_back(tangent(set, turn.samples[i].place).dot(r.cleaned[i]));
    r.tangential = circular_tests::turn_harmonics(r.angles, tangential, highest_order);
    r.pitch = circular_tests::harmonic_peaks(r.tangential, settings.least_harmonic);
    for (std::size_t i = 0; i < r.cleaned.size(); ++i)
      r.cleaned[i] -= tangent(set, turn.samples[i].place) * circular_tests::value_at(r.pitch, r.angles[i]);
  }
  std::vector<BallDeviation> readings;
  const std::size_t step = r.cleaned.size() / most_readings + 1;
  for (std::size_t i = 0; i < r.cleaned.size(); i += step)
    readings.push_back({turn.samples[i].angles, r.cleaned[i]});
  r.location = locate_axis(set.machine, set.model, set.axis, set.ball, set.tool_length, readings);
  return r;
}

AxisLocation locate_from_stops(const TurnedBall& set, const std::vector<BallSample>& stops) {
  std::vector<BallDeviation> readings;
  for (const auto& s : stops) readings.push_back({s.angles, s.deviation});
  return locate_axis(set.machine, set.model, set.axis, set.ball, set.tool_length, readings);
}

Vec3 dynamic_less_static(const std::vector<double>& angles, const std::vector<Vec3>& dynamic,
                         const std::vector<BallSample>& stops) {
  const double sense = angles.back() > angles.front() ? 1 : -1;
  Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
  std::size_t i = 0;
  for (const auto& stop : stops) {
    while (i + 2 < angles.size() && sense * angles[i + 1] < sense * stop.turned) ++i;
    const double gap = angles[i + 1] - angles[i];
    const double share = gap == 0 ? 0 : std::clamp((stop.turned - angles[i]) / gap, 0.0, 1.0);
    const Vec3 difference = dynamic[i] + share * (dynamic[i + 1] - dynamic[i]) - stop.deviation;
    sum += difference, squares += difference.cwiseAbs2();
  }
  const auto n = static_cast<double>(stops.size());
  if (stops.size() < 2) return Vec3::Zero();
  return ((squares - sum.cwiseAbs2() / n) / (n - 1)).cwiseMax(0).cwiseSqrt();
}

StaticComparison compare(const TurnedBall& set, const RTestResult& dynamic,
                         const std::vector<BallSample>& stops) {
  return {locate_from_stops(set, stops), dynamic_less_static(dynamic.angles, dynamic.read, stops),
          dynamic_less_static(dynamic.angles, dynamic.cleaned, stops)};
}

Vec3 span_of(const std::vector<Vec3>& deviations) {
  if (deviations.empty()) return Vec3::Zero();
  Vec3 low = deviations.front(), high = low;
  for (const auto& d : deviations) low = low.cwiseMin(d), high = high.cwiseMax(d);
  return high - low;
}

}  // namespace trunnion::identification
