// SPDX-License-Identifier: Apache-2.0
// Curves as chords.
#include <gtest/gtest.h>

#include <cmath>

#include "language/nurbs_curve.hpp"
#include "test_machine.hpp"

namespace trunnion::language::test {
namespace {

TEST(Nurbs, QuarterCircleIsOneWithinTheTolerance) {
  TestMachine machine;
  // Weights 1, cos 45, 1 make a quarter circle of radius 10 out of a corner.
  const Interpretation result = run(machine,
                                    "G0 X10\nG6.2 P3 K0 X10 Y0 R1 F100\nK0 X10 Y10 R0.70710678118\n"
                                    "K0 X0 Y10 R1\nK1\nK1\nK1\nG1 Z5\n");
  ASSERT_EQ(result.last, Step::end) << result.alarm.text.data();
  double x = 10;
  double y = 0;
  std::size_t chords = 0;
  for (const Command& command : result.commands) {
    if (command.kind != CommandKind::line || command.target[Z] != 0) continue;
    ++chords;
    EXPECT_EQ(command.chord, std::abs(command.target[X]) > 1e-12) << "all but the last go on";
    EXPECT_EQ(command.modal.feed, 100);
    EXPECT_NEAR(std::hypot(command.target[X], command.target[Y]), 10, 1e-9);
    const double middle = std::hypot((x + command.target[X]) / 2, (y + command.target[Y]) / 2);
    EXPECT_LE(10 - middle, 0.005 + 1e-9);
    EXPECT_GT(command.target[Y], y);
    x = command.target[X];
    y = command.target[Y];
  }
  EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(y, 10, 1e-12);
  // A chord of error e spans 2 acos(1 - e / r) = 3.62 degrees, so a quarter needs at least 25.
  EXPECT_GE(chords, 25u);
  EXPECT_LE(chords, 60u);
  EXPECT_FALSE(result.commands[result.commands.size() - 2].chord);
}

TEST(Nurbs, CubicFollowsBernsteinsPolynomial) {
  NurbsCurve curve;
  curve.start(4, 0.001);
  const Vector3 points[] = {{0, 0, 0}, {10, 30, 5}, {40, -20, 5}, {50, 0, -10}};
  for (const Vector3& point : points) EXPECT_EQ(curve.add(0, {point, 1}), AlarmNumber::none);
  Vector3 end{};
  Vector3 last{};
  int chords = 0;
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(curve.add(2), AlarmNumber::none);
    while (curve.next(end)) {
      last = end;
      ++chords;
      // The parameter from x, which rises all the way: bisect.
      double low = 0, high = 1;
      const auto bernstein = [&](double t, std::size_t i) {
        const double s = 1 - t;
        return s * s * s * points[0][i] + 3 * s * s * t * points[1][i] + 3 * s * t * t * points[2][i] +
               t * t * t * points[3][i];
      };
      for (int i = 0; i < 60; ++i) (bernstein((low + high) / 2, 0) < end[0] ? low : high) = (low + high) / 2;
      EXPECT_NEAR(end[1], bernstein(low, 1), 1e-9);
      EXPECT_NEAR(end[2], bernstein(low, 2), 1e-9);
    }
  }
  EXPECT_FALSE(curve.active());
  EXPECT_GT(chords, 10);
  EXPECT_EQ(last, points[3]);
}

TEST(Nurbs, LongCurvesNeedAWindowOfThemselves) {
  // A thousand control points on a line x = i: the curve runs along it and ends at the last one.
  NurbsCurve curve;
  curve.start(4, 0.001);
  const int count = 1000;
  Vector3 end{};
  double x = 0;
  int chords = 0;
  const auto take = [&] {
    while (curve.next(end)) {
      EXPECT_GT(end[0], x);
      EXPECT_NEAR(end[1], 2 * end[0], 1e-9);
      x = end[0];
      ++chords;
    }
  };
  for (int i = 0; i < count; ++i) {
    ASSERT_EQ(curve.add(std::max(0, i - 3), {{i * 1.0, i * 2.0, 0}, 1}), AlarmNumber::none);
    take();
  }
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(curve.add(count - 3), AlarmNumber::none);
    take();
  }
  EXPECT_FALSE(curve.active());
  EXPECT_NEAR(x, count - 1, 1e-9);
  EXPECT_EQ(chords, count - 3);  // one per span
}

}  // namespace
}  // namespace trunnion::language::test
