// SPDX-License-Identifier: Apache-2.0
#include "servo_analysis/contour_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "trace.hpp"

namespace trunnion::servo_analysis {
namespace {

constexpr double radius = 100, feed = 1000.0 / 60, dt = 0.001;
constexpr double omega = feed / radius;

struct Circle {
  AxisTrace x, y;
};

// Two turns; each axis follows its setpoint with a time lag and the error of its function of the angle, deg.
template <class ErrorX>
Circle circle(double lag_x, double lag_y, double sense, const ErrorX& error_x) {
  Circle c;
  c.x.interval = c.y.interval = dt;
  const int n = static_cast<int>(4 * std::numbers::pi / omega / dt) + 2;
  for (int i = 0; i < n; ++i) {
    const double t = i * dt;
    const auto px = [&](double s) { return radius * (std::cos(omega * s) - 1); };
    const auto py = [&](double s) { return sense * radius * std::sin(omega * s); };
    const double angle = std::fmod(omega * t * 180 / std::numbers::pi, 360);
    add(c.x, px(t), px(t - lag_x) + error_x(angle));
    add(c.y, py(t), py(t - lag_y));
  }
  return c;
}

TEST(Roundness, TheMismatchIsTheDifferenceOfTheTimeLags) {
  for (const double sense : {1.0, -1.0})
    for (const double mismatch : {-1e-3, 0.4e-3, 1e-3}) {
      const auto c = circle(0.012 + mismatch, 0.012, sense, [](double) { return 0.0; });
      const auto f = roundness(c.x, c.y);
      EXPECT_NEAR(f.radius, radius, 1e-6);
      // In ms; what is left of second order in omega * lag = 0.002.
      EXPECT_NEAR(f.mismatch, mismatch * 1e3, 0.005 * std::abs(mismatch) * 1e3);
      // R w (tx - ty) / 2 in both directions of the second harmonic.
      EXPECT_NEAR(f.deviation, feed * std::abs(mismatch), 0.02 * feed * std::abs(mismatch));
    }
}

TEST(Roundness, AQuadrantJumpIsFoundAtItsPlace) {
  // X reverses at 0 and 180 deg; at 180 deg it stays back by 10 um over 3 deg.
  const auto c = circle(0.012, 0.012, 1, [](double angle) {
    const double past = angle - 180;
    return past >= 0 && past < 3 ? -0.01 * std::sin(std::numbers::pi * past / 3) : 0.0;
  });
  const auto f = roundness(c.x, c.y);
  // At 180 deg a deviation of X is one of the radius. The harmonics take up to 3 % of it (its width is 3 of
  // 360 deg).
  EXPECT_NEAR(f.quadrant_jump[2], 0.01, 0.0004);
  for (const int other : {0, 1, 3}) EXPECT_LT(f.quadrant_jump[static_cast<std::size_t>(other)], 0.0004);
}

TEST(Roundness, LessThanATurnIsRefused) {
  auto c = circle(0, 0, 1, [](double) { return 0.0; });
  for (auto* t : {&c.x, &c.y}) t->setpoint.resize(t->size() / 3), t->feedback.resize(t->setpoint.size());
  EXPECT_THROW(roundness(c.x, c.y), std::runtime_error);
  EXPECT_THROW(roundness({}, {}), std::runtime_error);
}

TEST(SimultaneousMotion, MismatchIsTheDifferenceOfTheLagsTimesTheSpeed) {
  // C turns with 1000 deg/min, X and Y keep a tip at 100 mm: their speed is 100 * 0.2909 = 29.09 mm/s.
  const double turn = 1000.0 / 60 * std::numbers::pi / 180, speed = 100 * turn;
  AxisTrace x, y, z, c;
  x.interval = y.interval = z.interval = c.interval = dt;
  for (int i = 0; i < 22000; ++i) {
    const double t = i * dt;
    const auto angle = [&](double s) { return turn * s; };
    add(x, 100 * std::cos(angle(t)), 100 * std::cos(angle(t - 0.0100)));
    add(y, 100 * std::sin(angle(t)), 100 * std::sin(angle(t - 0.01002)));
    add(z, 5, 5 + 1e-5 * (i % 2));
    add(c, angle(t) * 180 / std::numbers::pi, angle(t - 0.01005) * 180 / std::numbers::pi);
  }
  const auto f = simultaneous_motion({x, y, z}, c);
  EXPECT_NEAR(f.linear, 0.00002 * speed, 0.02 * 0.00002 * speed);
  EXPECT_NEAR(f.rotary, 0.00004 * speed, 0.02 * 0.00004 * speed);
  EXPECT_NEAR(f.lags[0], 0.01, 1e-6);
}

}  // namespace
}  // namespace trunnion::servo_analysis
