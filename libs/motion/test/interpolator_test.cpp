#include "motion/interpolator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trunnion::motion {
namespace {

TEST(Interpolator, output_is_the_mean_of_the_last_n_positions) {
  Interpolator average(4);
  average.reset({});
  // Positions 4, 8, 12 after a standstill at 0: means 1, 3, 6.
  EXPECT_EQ(average.step({4})[0], 1);
  EXPECT_EQ(average.step({8})[0], 3);
  EXPECT_EQ(average.step({12})[0], 6);
}

TEST(Interpolator, at_rest_the_position_comes_out_bit_for_bit_after_n_cycles_and_after_millions_of_others) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> position(-1e4, 1e4);
  for (int n : {1, 3, 7, 64}) {
    Interpolator average(n);
    average.reset({});
    for (int i = 0; i < 100000; ++i) average.step({position(random), position(random)});
    const AxisValues target{0.1 + 1e-13, -1234.56789, 1.0 / 3};
    AxisValues out{};
    for (int i = 0; i < n; ++i) out = average.step(target);
    EXPECT_EQ(out, target) << n;
  }
}

TEST(Interpolator, output_depends_on_the_last_n_positions_only) {
  Interpolator a(5), b(5);
  a.reset({1, 2, 3});
  b.reset({9, 8, 7});
  for (int i = 0; i < 3; ++i) b.step({0.1 * i});  // the rings stand at different places now
  AxisValues from_a{}, from_b{};
  for (int i = 0; i < 5; ++i) {
    const AxisValues p{std::sin(i), 1e3 * std::cos(i), 1e-3 * i};
    from_a = a.step(p);
    from_b = b.step(p);
  }
  EXPECT_EQ(from_a, from_b);
}

// Speed ramp of a = 1000 mm/s^2 to 40 mm/s with N = 20 cycles of 1 ms: the jerk may reach 2 a / T = 1e5
// mm/s^3.
TEST(Interpolator, jerk_of_an_accelerated_move_is_below_2a_over_t) {
  const double dt = 0.001, a = 1000;
  const int n = 20;
  Interpolator average(n);
  average.reset({});
  double v = 0, x = 0, x1 = 0, x2 = 0, x3 = 0, worst = 0;
  for (int k = 0; k < 200; ++k) {
    v += k < 40 ? a * dt : (k >= 60 && k < 100 ? -a * dt : 0);
    x += v * dt;
    const double y = average.step({x})[0];
    worst = std::max(worst, std::abs(y - 3 * x1 + 3 * x2 - x3) / (dt * dt * dt));
    x3 = x2;
    x2 = x1;
    x1 = y;
  }
  EXPECT_LE(worst, 2 * a / (n * dt) * (1 + 1e-6));
  EXPECT_GE(worst, a / (n * dt) * (1 - 1e-6));  // it does reach a / T at the first step
}

TEST(Interpolator, number_of_cycles_is_kept_within_its_range) {
  EXPECT_EQ(Interpolator(0).cycles(), 1);
  EXPECT_EQ(Interpolator(1000).cycles(), 64);
}

}  // namespace
}  // namespace trunnion::motion
