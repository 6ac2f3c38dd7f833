// SPDX-License-Identifier: Apache-2.0
// How the speed stage gains speed on cells written by hand that leave less to acceleration the faster they
// are run over.
#include <gtest/gtest.h>

#include "motion/speed_stage.hpp"

namespace trunnion::motion::speed_gain_test {
namespace {

constexpr double cycle = 0.001;

/// A stretch of a curve: half of the acceleration is left at the highest speed, all of it at the slowest
/// level.
LimitCell curved(double at, double end, double speed) {
  LimitCell cell;
  cell.at = at;
  cell.end = end;
  cell.speed = cell.top = cell.feed = speed;
  cell.ramps = {{{1500, 60000}, {2000, 60000}, {2500, 60000}, {3000, 60000}}};
  return cell;
}

std::size_t cycles_to_the_end(SpeedStage& stage, std::size_t most) {
  std::size_t cycles = 0;
  while (!stage.at_end() && cycles < most) stage.step({}), ++cycles;
  return cycles;
}

// 600 mm in cells of 0.1 mm, each of which allows 0.002 mm/s more than the one before, from 300 mm/s on: as a
// spiral that opens. 600 mm at 306 mm/s on the average take 1.961 s. Speed comes up and down in steps to 0.4,
// 0.65, 0.85 and 1 of it; the steps of 122, 77, 61 and 46 mm/s (the mean speeds 61, 161, 230 and 283) take
// 91, 69, 64 and 55 ms with their jerk of 60000 mm/s3 (each 2 sqrt(v / j) or v / a + a / j), in which
// 5.6, 11.1, 14.7 and 15.6 of the 85 ms * 306 mm are travelled: each ramp loses 279 - 47 / 0.306 = 125 ms.
TEST(SpeedGain, speed_reaches_the_fastest_level_where_each_cell_allows_a_little_more_than_the_one_before) {
  SpeedStage stage(cycle);
  for (int k = 0; k < 6000; ++k) stage.cells().push(curved(0.1 * k, 0.1 * (k + 1), 300 + 0.002 * k));
  stage.set_finished(true);
  stage.extended();
  const std::size_t cycles = cycles_to_the_end(stage, 20000);
  EXPECT_LE(static_cast<double>(cycles) * cycle, 1.961 + 2 * 0.125);
}

}  // namespace
}  // namespace trunnion::motion::speed_gain_test
