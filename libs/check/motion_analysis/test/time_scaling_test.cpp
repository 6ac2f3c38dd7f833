// SPDX-License-Identifier: Apache-2.0
// The least time of a motion on its own path, against times known otherwise.
#include "motion_analysis/time_scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "motion_analysis/limit_check.hpp"

namespace trunnion::analysis {
namespace {

constexpr double cycle = 0.001;

motion::Limits axes(double velocity, double acceleration, double jerk) {
  motion::Limits limits;
  limits.axes.fill({velocity, velocity, acceleration, jerk});
  return limits;
}

// From rest to rest over `length` in `duration` with the jerk +j, -j, -j, +j for a quarter each: the length
// is j duration^3 / 32. `of` gives the axes at a length.
std::vector<MotionSample> slow_motion(double length, double duration, double feed,
                                      const std::function<AxisValues(double)>& of) {
  std::vector<MotionSample> samples;
  const int cycles = static_cast<int>(duration / cycle);
  const auto way = [&](double t) {
    const double x = std::min(t, 1 - t), cubic = x * x * x / 6, late = std::max(0.0, x - 0.25);
    const double s = 32 * length * (cubic - 2 * late * late * late / 6);
    return t < 0.5 ? s : length - s;
  };
  double before = 0;
  for (int k = -3; k <= cycles + 3; ++k) {
    const double s = way(std::clamp(static_cast<double>(k) / cycles, 0.0, 1.0));
    samples.push_back({of(s), feed > 0 ? (s - before) / cycle / feed : 0, false});
    before = s;
  }
  return samples;
}

double least_time(const std::vector<MotionSample>& samples, const motion::Limits& limits) {
  LeastTime least(limits, cycle);
  for (const MotionSample& sample : samples) least.add(sample);
  return least.finish();
}

// Of a whole motion, from rest to rest.
std::vector<double> scaling_of(const std::vector<MotionSample>& samples, const motion::Limits& limits) {
  return least_time_scaling(samples, limits, cycle, std::vector<double>(samples.size(), 0.97), false, true);
}

AxisValues line(double s) { return {0.8 * s, 0.6 * s}; }

// The stronger axis goes 80 mm: v^2 / a + v a / j = 80 with the peak v = 420.6 mm/s, in 2 (v / a + a / j) =
// 0.3804 s. Two cycles and half of a percent are for the samples and the barrier.
TEST(TimeScaling, a_line_from_rest_to_rest_takes_the_time_of_its_s_curve) {
  const double t = least_time(slow_motion(100, 0.8, 0, line), axes(500, 3000, 60000));
  EXPECT_NEAR(t, 0.3804, 0.004);
}

// At 50 mm/s: ramps of 2 sqrt(v / j') with j' = j / 0.8, each as long as a way at half the speed.
TEST(TimeScaling, the_programmed_speed_is_kept) {
  const double t = least_time(slow_motion(100, 4, 50, line), axes(500, 3000, 60000));
  EXPECT_NEAR(t, 100.0 / 50 + 2 * std::sqrt(50 * 0.8 / 60000), 0.008);
}

// The least times of docs/motion.md, from a barrier method over the square of the speed by path length.
TEST(TimeScaling, full_circles_take_the_least_time_of_another_method) {
  for (const auto& [radius, time] :
       {std::pair{1.0, 0.2205}, {3.0, 0.3179}, {10.0, 0.4832}, {30.0, 0.7711}, {100.0, 1.4712}}) {
    const auto circle = [r = radius](double s) {
      return AxisValues{r * std::cos(s / r), r * std::sin(s / r)};
    };
    const auto samples = slow_motion(2 * std::numbers::pi * radius, 2 * time, 500, circle);
    EXPECT_NEAR(least_time(samples, axes(500, 3000, 60000)), time, 0.005 * time + 0.002) << radius;
  }
}

// What the scaling gives is played back: the time of each place is the integral of dT / sqrt(b), and the axes
// at full cycles of the new time are interpolated.
TEST(TimeScaling, the_motion_that_it_finds_keeps_the_limits_at_every_cycle) {
  const auto wave = [](double s) {
    return AxisValues{s, 3 * std::sin(0.4 * s), std::sin(1.1 * s + 1) - std::sin(1.0)};
  };
  const motion::Limits limits = axes(300, 2500, 50000);
  auto samples = slow_motion(60, 5, 0, wave);
  const std::vector<double> b = scaling_of(samples, limits);
  std::vector<double> at(b.size(), 0);
  for (std::size_t k = 1; k < b.size(); ++k)
    at[k] = at[k - 1] + 2 * cycle / (std::sqrt(b[k - 1]) + std::sqrt(b[k]));
  EXPECT_LT(at.back(), 2.5);
  LimitCheck check(limits, samples.front().machine, cycle);
  std::size_t k = 1;
  for (double t = 0; t < at.back(); t += cycle) {
    while (k + 3 < b.size() && at[k + 1] < t) ++k;
    AxisValues q{};  // the cubic through four samples
    for (std::size_t i = 0; i < 4; ++i) {
      double weight = 1;
      for (std::size_t m = 0; m < 4; ++m)
        if (m != i) weight *= (t - at[k - 1 + m]) / (at[k - 1 + i] - at[k - 1 + m]);
      for (std::size_t x = 0; x < 3; ++x) q[x] += weight * samples[k - 1 + i].machine[x];
    }
    check.add(q, false);
  }
  EXPECT_LE(check.worst().velocity, 1.001);
  EXPECT_LE(check.worst().acceleration, 1.001);
  // The jerk of an interpolation of third degree is not continuous.
  EXPECT_LE(check.worst().jerk, 1.05);
}

TEST(TimeScaling, windows_take_the_time_of_the_whole) {
  const auto wave = [](double s) { return AxisValues{s, 3 * std::sin(0.4 * s)}; };
  const motion::Limits limits = axes(100, 2500, 50000);
  auto samples = slow_motion(200, 6, 0, wave);
  const std::vector<double> b = scaling_of(samples, limits);
  double whole = 0;
  for (const double x : b) whole += cycle / std::sqrt(x);
  EXPECT_NEAR(least_time(samples, limits), whole, 0.01 * whole);
}

// A line at 50 mm/s, three times slowed to half of it for 0.4 s by a cosine. The line itself needs no
// slowing, so the least time is the one at the programmed speed, with ramps as above; the stretches between
// are not solved.
TEST(TimeScaling, stretches_at_the_programmed_speed_take_their_own_time) {
  const double feed = 50, ramp = 0.2, slow = 0.4, whole = 6;
  std::vector<MotionSample> samples;
  double s = 0;
  for (int k = -3; k <= static_cast<int>(whole / cycle) + 3; ++k) {
    const double t = k * cycle, end = std::min(t, whole - t);
    double share = 1;
    if (end < ramp) share = end <= 0 ? 0 : 0.5 - 0.5 * std::cos(std::numbers::pi * end / ramp);
    for (const double begin : {1.0, 2.6, 4.2})
      if (t > begin && t < begin + slow)
        share = 0.75 + 0.25 * std::cos(2 * std::numbers::pi * (t - begin) / slow);
    s += share * feed * cycle;
    samples.push_back({line(s), share, false});
  }
  const motion::Limits limits = axes(500, 3000, 60000);
  const double least = least_time(samples, limits);
  EXPECT_NEAR(least, s / feed + 2 * std::sqrt(feed * 0.8 / 60000), 0.008);
  double together = 0;
  for (const double b : scaling_of(samples, limits)) together += cycle / std::sqrt(b);
  EXPECT_NEAR(least, together, 0.003);
}

}  // namespace
}  // namespace trunnion::analysis
