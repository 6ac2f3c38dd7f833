// SPDX-License-Identifier: Apache-2.0
// Programs of every kind of path, random limits, with and without rtcp, under an override that jumps: each
// must end on its target, keep every axis within its limits and the tip within the tolerance.
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "motion_fixture.hpp"

namespace trunnion::motion::test {
namespace {

using canonical::Transformation;

struct Scenario {
  Limits limits;
  bool rtcp = false, jumping_override = false, arcs = false;
  std::vector<AxisValues> points{{}};
  std::vector<Command> program;
};

Limits random_limits(std::mt19937_64& random, bool rtcp) {
  std::uniform_real_distribution<double> unit(0, 1);
  Limits limits =
      uniform_limits(50 + 200 * unit(random), 500 + 3000 * unit(random), static_cast<int>(1 + random() % 64));
  limits.contour_tolerance = std::pow(10, -3.2 + 2.4 * unit(random));
  limits.arc_tolerance = std::min(limits.contour_tolerance, 0.01);
  limits.orientation_tolerance = std::pow(10, -2 + 2 * unit(random));
  for (std::size_t i = 0; i < 9; ++i) {
    if (!rtcp) limits.axes[i].acceleration *= std::pow(10, unit(random) - 0.5);
    if (rtcp && i >= canonical::A && i <= canonical::C) {
      limits.axes[i] = {30 + 80 * unit(random), 200, 200 + 600 * unit(random)};
    }
  }
  return limits;
}

Scenario random_scenario(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  Scenario s;
  s.rtcp = random() % 2 == 0;
  s.arcs = random() % 3 == 0;
  s.jumping_override = seed % 3 == 0;
  s.limits = random_limits(random, s.rtcp);
  double size = 1, direction = 0, bend = 0;
  AxisValues p{};
  // Cycles on arcs take the planner ten times as long as others, so those programs are shorter.
  const int of_a_kind = s.arcs ? 10 : 30;
  for (int i = 0; i < 4 * of_a_kind; ++i) {
    // scattered, smooth, nearly straight
    const auto kind = (static_cast<std::uint64_t>(i / of_a_kind) + seed) % 3;
    if (i % of_a_kind == 0) {
      size = std::pow(10, -0.3 + unit(random));
      bend = 0.5 * unit(random);
    }
    if (s.arcs && random() % 4 == 0) {
      const double cx = p[0] + size * unit(random), cy = p[1] + size * unit(random);
      const double radius = std::hypot(p[0] - cx, p[1] - cy), sweep = 160 + 140 * unit(random);
      const double end = std::atan2(p[1] - cy, p[0] - cx) + sweep * std::numbers::pi / 180;
      p[0] = cx + radius * std::cos(end);
      p[1] = cy + radius * std::sin(end);
      s.program.push_back(arc_to(p, cx, cy, sweep, false, 6000));
    } else {
      if (kind == 0) {
        for (std::size_t k = 0; k < 3; ++k) p[k] += size * unit(random);
      } else if (kind == 1) {
        direction += bend * 0.3;
        p[0] += size * 0.2 * std::cos(direction);
        p[1] += size * 0.2 * std::sin(direction);
      } else {
        p[0] += size;
        p[1] += 0.01 * size * unit(random);
      }
      if (s.rtcp || kind == 0) {
        p[canonical::A] = std::clamp(
            p[canonical::A] + size * (kind == 0 ? 3 * unit(random) : 0.3 * std::sin(i * 0.2)), -60., 60.);
        p[canonical::C] += kind == 0 ? size * 4 * unit(random) : size * 0.5;
      }
      s.program.push_back(line_to(p, 5000 + 4000 * unit(random)));
    }
    s.points.push_back(p);
  }
  return s;
}

class RandomProgram : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomProgram, ends_on_its_target_within_every_limit_and_the_tolerance) {
  const Scenario s = random_scenario(GetParam());
  const geometry::Chain chain = ac_table();
  const geometry::Chain* used = s.rtcp ? &chain : nullptr;
  Trajectory t(s.limits, used, cycle);
  t.start({}, s.rtcp ? Transformation::rtcp : Transformation::none, 80);
  std::mt19937_64 changes(GetParam());
  double value = 1;
  const Motion result = run(t, s.program, 400000, [&](std::size_t) {
    if (s.jumping_override && changes() % 50 == 0) value = 1.5 * static_cast<double>(changes() % 5) / 4;
    return value;
  });
  ASSERT_TRUE(result.stopped);
  EXPECT_EQ(t.position(), s.points.back());
  const Ratios ratios = axis_ratios(result, {}, s.limits, used, 80);
  EXPECT_LE(ratios.velocity, 1.001);
  EXPECT_LE(ratios.acceleration, 1.001);
  EXPECT_LE(ratios.jerk, 1.001);
  if (!s.arcs) {
    EXPECT_LE(contour_error(result, s.points), s.limits.contour_tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(seeds, RandomProgram, testing::Range<std::uint64_t>(0, 42));

}  // namespace
}  // namespace trunnion::motion::test
