// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/ballbar_causes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include "radians.hpp"

namespace trunnion::circular_tests {
namespace {

constexpr double radius = 100;

// Both paths from a machine that is computed by its positions, not by the closed forms: `x`, `y` are the
// positions that are reached, from the commanded position and the sign of the speed.
template <class X, class Y>
std::array<std::vector<RadialReading>, 2> run(X&& x, Y&& y, double squareness = 0) {
  std::array<std::vector<RadialReading>, 2> paths;
  constexpr int n = 3600;
  for (const int sense : {1, -1})
    for (int i = 0; i < n; ++i) {
      const double angle = sense * 360.0 * (i + 0.5) / n, t = angle * radians;
      const double px = x(radius * std::cos(t), -sense * std::sin(t) > 0 ? 1 : -1);
      const double py = y(radius * std::sin(t), sense * std::cos(t) > 0 ? 1 : -1);
      // The Y axis leans by the squareness towards -X: the angle between the axes is more than 90 degrees.
      const double ex = px - py * std::sin(squareness), ey = py * std::cos(squareness);
      paths[sense < 0].push_back({angle, std::hypot(ex, ey) - radius});
    }
  return paths;
}

double as_commanded(double p, int) { return p; }

TEST(BallbarCauses, ABacklashOfTenMicrometresOnXGivesStepsOfThatSizeAtBothEndsOfX) {
  // The axis stands half of its backlash behind the command.
  const auto paths = run([](double p, int direction) { return p - direction * 5e-3; }, as_commanded);
  const auto& ccw = paths[0];
  // Readings around 0 and 180 deg: the last and the first, and the middle ones.
  EXPECT_NEAR(ccw.front().deviation - ccw.back().deviation, 10e-3, 1e-6);
  EXPECT_NEAR(ccw[1800].deviation - ccw[1799].deviation, 10e-3, 1e-6);
  EXPECT_NEAR(ccw[900].deviation - ccw[899].deviation, 0, 2e-5) << "X does not reverse at 90 deg";
  const auto causes = ballbar_causes(paths[0], paths[1], radius);
  EXPECT_NEAR(causes.reversal_first, 10e-3, 1e-6);
  EXPECT_NEAR(causes.reversal_second, 0, 1e-6);
  EXPECT_NEAR(causes.lag_mismatch, 0, 1e-6);
  const auto f = circular_figures(paths[0], paths[1], radius);
  // +-5 um cos t with steps at 0 and 180 deg: four extremes in alternation, so no other centre is better.
  EXPECT_NEAR(f.deviation_ccw, 10e-3, 2e-6);
  EXPECT_NEAR(f.hysteresis, 10e-3, 1e-6);
  const auto shares = cause_shares(causes, radius);
  EXPECT_EQ(shares.front().name, "lost motion 1");
  EXPECT_GT(shares.front().share, 0.99);
}

TEST(BallbarCauses, ASquarenessOfTwentyMicrometresInAMetreMakesAnEllipseOfTwoMicrometres) {
  const auto paths = run(as_commanded, as_commanded, 20e-6);
  const auto f = circular_figures(paths[0], paths[1], radius);
  // The half axes are R (1 +- g / 2), at 135 and 45 deg.
  EXPECT_NEAR(f.deviation_ccw, radius * 20e-6, 1e-8);
  EXPECT_NEAR(f.bidirectional, radius * 20e-6, 1e-8);
  EXPECT_NEAR(f.hysteresis, 0, 1e-9);
  const auto causes = ballbar_causes(paths[0], paths[1], radius);
  EXPECT_NEAR(causes.squareness, 20e-6, 1e-9);
  EXPECT_NEAR(causes.rest, 0, radius * 20e-6 * 20e-6) << "terms of second order";
}

TEST(BallbarCauses, DifferentScalesMakeAnEllipseAlongTheAxes) {
  const auto paths =
      run([](double p, int) { return p * (1 + 30e-6); }, [](double p, int) { return p * (1 - 10e-6); });
  const auto causes = ballbar_causes(paths[0], paths[1], radius);
  EXPECT_NEAR(causes.scale_mismatch, 40e-6, 1e-9);
  EXPECT_NEAR(causes.radius, 1e-3, 1e-7) << "the mean of 30 and -10 um/m";
  EXPECT_NEAR(circular_figures(paths[0], paths[1], radius).deviation_ccw, 4e-3, 1e-7);
}

TEST(BallbarCauses, ASpikeBehindAReversalIsFoundWhereItIsAndWithItsSign) {
  // X stands still for a degree behind its reversals: it overshoots the circle outwards, by at most
  // R (1 - cos 1 deg) = 15.2 um, and jumps back.
  auto paths = run(as_commanded, as_commanded);
  for (auto& path : paths)
    for (auto& r : path) {
      const int sense = &path == &paths[0] ? 1 : -1;
      const double past = sense * (r.angle - 180 * std::round(r.angle / 180));
      if (past > 0 && past < 1) r.deviation = std::hypot(radius, radius * std::sin(past * radians)) - radius;
    }
  const auto causes = ballbar_causes(paths[0], paths[1], radius);
  for (const auto* spikes : {&causes.spike_ccw, &causes.spike_cw}) {
    // At the last reading of the degree, 0.95 deg: R (sqrt(1 + sin^2) - 1).
    const double expected = radius * (std::sqrt(1 + std::pow(std::sin(0.95 * radians), 2)) - 1);
    EXPECT_NEAR((*spikes)[0], expected, 1e-5);
    EXPECT_NEAR((*spikes)[2], expected, 1e-5);
    EXPECT_NEAR((*spikes)[1], 0, 1e-5);
    EXPECT_NEAR((*spikes)[3], 0, 1e-5);
  }
  EXPECT_EQ(cause_shares(causes, radius).front().name, "spike 1");
}

}  // namespace
}  // namespace trunnion::circular_tests
