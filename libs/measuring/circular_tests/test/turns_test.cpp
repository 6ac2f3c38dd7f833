// SPDX-License-Identifier: Apache-2.0
#include "circular_tests/turns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include "radians.hpp"

namespace trunnion::circular_tests {
namespace {

const ProgrammedCircle programmed_circle{{10, -20}, 50};

PlanePoint at(double angle, double radius = programmed_circle.radius) {
  return {programmed_circle.centre.first + radius * std::cos(angle * radians),
          programmed_circle.centre.second + radius * std::sin(angle * radians)};
}

// From the centre to the circle at `from`, along it to `to` in steps of 0.1 deg, and back to the centre.
void go(std::vector<PlanePoint>& path, double from, double to) {
  for (int i = 0; i < 100; ++i) path.push_back(at(from, programmed_circle.radius * i / 100.0));
  const int n = static_cast<int>(std::lround(std::abs(to - from) * 10));
  for (int i = 0; i <= n; ++i) path.push_back(at(from + (to - from) * i / n));
  for (int i = 99; i >= 0; --i) path.push_back(at(to, programmed_circle.radius * i / 100.0));
}

TEST(Turns, OfBothSensesAreCutOutBetweenEqualOverruns) {
  std::vector<PlanePoint> path;
  go(path, 30 - 45, 30 + 360 + 45);
  go(path, 30 + 45, 30 - 360 - 45);
  go(path, 0, 200);
  const auto turns = turns_on(path, programmed_circle);
  ASSERT_EQ(turns.size(), 2u) << "200 degrees are no turn";
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(turns[k].sense, k == 0 ? 1 : -1);
    EXPECT_NEAR(turns[k].start, 30, 0.11);
    EXPECT_NEAR(turns[k].overrun, 45, 0.11);
    EXPECT_NEAR(static_cast<double>(turns[k].end - turns[k].begin), 3600, 1);
    const auto readings = readings_of(path, turns[k], programmed_circle);
    for (const auto& r : readings) EXPECT_NEAR(r.deviation, 0, 1e-9);
  }
}

TEST(Turns, OfOneCircleAfterTheOtherWithoutAPauseAreBothFound) {
  std::vector<PlanePoint> path;
  for (int i = -900; i <= 3600 + 900; ++i) path.push_back(at(i * 0.1));
  for (int i = 3600 + 900; i >= -900; --i) path.push_back(at(i * 0.1));
  const auto turns = turns_on(path, programmed_circle);
  ASSERT_EQ(turns.size(), 2u);
  EXPECT_EQ(turns[0].sense, 1);
  EXPECT_EQ(turns[1].sense, -1);
  EXPECT_NEAR(turns[1].overrun, 90, 0.11);
}

TEST(Turns, TheProgrammedCircleIsFoundInAMotion) {
  std::vector<PlanePoint> path;
  for (int i = 0; i < 500; ++i) path.push_back({0.1 * i, 0.05 * i});
  go(path, 10, 60);
  go(path, -45, 405);
  const auto found = find_circle(path, 1e-6);
  EXPECT_NEAR(found.centre.first, programmed_circle.centre.first, 1e-6);
  EXPECT_NEAR(found.centre.second, programmed_circle.centre.second, 1e-6);
  EXPECT_NEAR(found.radius, programmed_circle.radius, 1e-6);
  path.resize(1000);
  EXPECT_THROW(find_circle(path, 1e-6), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::circular_tests
