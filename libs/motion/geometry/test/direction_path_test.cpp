// SPDX-License-Identifier: Apache-2.0
#include "geometry/direction_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/angle.hpp"
#include "machines.hpp"

namespace trunnion::geometry {
namespace {

constexpr std::size_t a = 0, b = 1, c = 2;
const double infinity = std::numeric_limits<double>::infinity();

// Leans `lean` degrees from +Z towards the azimuth (from +X towards +Y).
Vec3 leaning(double lean, double towards) {
  const auto l = sine_cosine(lean), t = sine_cosine(towards);
  return {l.sine * t.cosine, l.sine * t.sine, l.cosine};
}

DirectionPathRequest request_between(const Vec3& from, const Vec3& to, const Angles& present = {}) {
  DirectionPathRequest request;
  request.from = from;
  request.to = to;
  request.present = present;
  return request;
}

DirectionPath path(const ChainParameters& p, const DirectionPathRequest& request) {
  auto made = DirectionPath::make(OrientationSolver(make(p)), request);
  if (const auto* fault = std::get_if<DirectionPathFault>(&made)) {
    ADD_FAILURE() << "fault " << int{fault->kind} << " at " << fault->s;
    return path(p, request_between(Vec3::UnitZ(), Vec3::UnitZ()));
  }
  return std::get<DirectionPath>(made);
}

DirectionPathFault fault(const ChainParameters& p, const DirectionPathRequest& request) {
  const auto made = DirectionPath::make(OrientationSolver(make(p)), request);
  return std::holds_alternative<DirectionPathFault>(made)
             ? std::get<DirectionPathFault>(made)
             : DirectionPathFault{DirectionPathFault::Kind{99}, 0, {}};
}

struct Observed {
  double off_circle = 0;  // degrees, largest angle to the great circle
  double step = 0;        // degrees, largest step of an axis
  Angles steps{};
};

Observed observe(const Chain& chain, const DirectionPath& p, int places = 4000) {
  Observed seen;
  Angles before = p.angles(0);
  for (int n = 0; n <= places; ++n) {
    const double s = static_cast<double>(n) / places;
    const Angles now = p.angles(s);
    seen.off_circle =
        std::max(seen.off_circle,
                 angle_between(chain.tool_direction_in_workpiece(now), p.arc().at(s)) / radians_per_degree);
    for (std::size_t k = 0; k < angle_count; ++k) {
      seen.steps[k] = std::max(seen.steps[k], std::abs(now[k] - before[k]));
      seen.step = std::max(seen.step, seen.steps[k]);
    }
    before = now;
  }
  return seen;
}

// From 30 degrees towards -Y to 30 degrees towards +X: half request_between the unit vector (1, -1, 2 / tan
// 30) normalized.
TEST(DirectionArc, is_an_even_turn_in_the_plane_of_both_vectors) {
  const auto arc = *DirectionArc::make(2 * leaning(30, -90), 0.5 * leaning(30, 0));
  EXPECT_LT((arc.at(0.5) - Vec3(1, -1, 2 * std::sqrt(3.0)).normalized()).norm(), 1e-15);
  EXPECT_LT((arc.at(1) - leaning(30, 0)).norm(), 1e-15);
  EXPECT_NEAR(std::cos(arc.length()), 0.75, 1e-15) << "sin 30 cos 90 + cos^2 30";
  EXPECT_FALSE(DirectionArc::make(Vec3(0, 0, 1), Vec3(0, 0, -1)));
  EXPECT_FALSE(DirectionArc::make(Vec3(0, 0, 0), Vec3(0, 0, 1)));
  EXPECT_TRUE(DirectionArc::make(Vec3(0, 0, 1), Vec3(0, 0, 1)));
}

TEST(DirectionArc, derivatives_agree_with_central_differences) {
  const auto arc = *DirectionArc::make(leaning(30, -90), leaning(50, 20));
  const double h = 1e-5;
  for (const double s : {0.0, 0.3, 1.0}) {
    const auto low = arc.derivatives(s - h), here = arc.derivatives(s), high = arc.derivatives(s + h);
    for (std::size_t n = 1; n < 4; ++n)
      EXPECT_LT(((high[n - 1] - low[n - 1]) / (2 * h) - here[n]).norm(), 1e-9) << n;
  }
}

// A leans the tool to -Y, C turns that to +X: A30 C0 -> A30 C90.
TEST(DirectionPath, an_ac_table_goes_from_a30_c0_to_a30_c90_over_the_great_circle) {
  const auto p = path(ac_table(), request_between(leaning(30, -90), leaning(30, 0), {30, 0, 0}));
  EXPECT_NEAR(p.angles(0)[a], 30, 1e-12);
  EXPECT_NEAR(p.angles(0)[c], 0, 1e-12);
  EXPECT_NEAR(p.angles(0.5)[c], 45, 1e-12);
  // The middle of the great circle is steeper: cos A = 2 sqrt 3 / sqrt 14.
  EXPECT_NEAR(p.angles(0.5)[a], std::acos(2 * std::sqrt(3.0 / 14)) / radians_per_degree, 1e-12);
  EXPECT_NEAR(p.angles(1)[a], 30, 1e-12);
  EXPECT_NEAR(p.angles(1)[c], 90, 1e-12);
  EXPECT_EQ(p.windows(), 0u);
}

// Straight across the pole: A runs from 20 through 0 to -20 with C at rest.
TEST(DirectionPath, through_the_pole_the_table_stands_and_the_trunnion_goes_on) {
  const auto p = path(ac_table(), request_between(leaning(20, -90), leaning(20, 90), {20, 0, 0}));
  const auto seen = observe(make(ac_table()), p);
  EXPECT_LT(seen.off_circle, 1e-9);
  EXPECT_LT(seen.steps[c], 1e-9);
  EXPECT_NEAR(p.angles(1)[a], -20, 1e-9);
  EXPECT_LT(seen.steps[a], 1.2 * 40 / 4000);
}

// Past the pole at 0.03 degrees, within the tolerance of 0.05: C no longer swings by half a turn.
TEST(DirectionPath, near_the_pole_the_tolerance_keeps_the_table_slow) {
  const Vec3 side = std::tan(0.03 * radians_per_degree) * Vec3::UnitX();
  const auto request = request_between(Vec3(0, -0.4, 1) + side, Vec3(0, 0.4, 1) + side, {21, 0, 0});
  const auto p = path(ac_table(), request);
  EXPECT_EQ(p.windows(), 1u);
  const auto seen = observe(make(ac_table()), p);
  EXPECT_LE(seen.off_circle, 0.05);
  EXPECT_GT(seen.off_circle, 0.005) << "it did leave the great circle";
  EXPECT_LT(std::abs(p.angles(1)[c] - p.angles(0)[c]), 1);
  const double even = p.arc().length() / radians_per_degree / 4000;
  // From -h to h over the window, leaving and arriving at the rate -h per half window, which is that of the
  // direction: the polynomial of degree five peaks at 15/8 of the mean rate plus 7/8 of the end rates.
  EXPECT_LT(seen.steps[c], 4 * even) << "C turns hardly faster than the direction";
  EXPECT_LT(seen.steps[a], 2 * even);
  // Without tolerance C swings by nearly half a turn, as fast as 1 / sin 0.03 degrees allows.
  auto exact = request;
  exact.tolerance = 0.001;
  const auto q = path(ac_table(), exact);
  EXPECT_EQ(q.windows(), 0u);
  EXPECT_GT(std::abs(q.angles(1)[c] - q.angles(0)[c]), 170);
  EXPECT_LT(observe(make(ac_table()), q).off_circle, 1e-9);
}

// Upright, C at 17: the request_between to +X needs C90 first, or C-90 with A the other request_between: 73
// or 107 degrees.
TEST(DirectionPath, a_path_that_begins_at_the_pole_says_where_the_table_must_stand) {
  const auto p = path(ac_table(), request_between(Vec3::UnitZ(), leaning(40, 0), {0, 0, 17}));
  EXPECT_NEAR(p.start()[c], 90, 1e-9);
  EXPECT_NEAR(p.start()[a], 0, 1e-9);
  EXPECT_NEAR(p.angles(1)[a], 40, 1e-9);
  const auto seen = observe(make(ac_table()), p);
  EXPECT_LT(seen.off_circle, 1e-9);
  EXPECT_LT(seen.steps[c], 1e-9);
  // And one that ends there arrives with C where it was.
  const auto back = path(ac_table(), request_between(leaning(40, 0), Vec3::UnitZ(), {40, 0, 450}));
  EXPECT_NEAR(back.angles(1)[c], 450, 1e-9);
  EXPECT_NEAR(back.angles(1)[a], 0, 1e-9);
}

TEST(DirectionPath, faults_are_found_before_motion_and_say_where) {
  EXPECT_EQ(fault(ac_table(), request_between(Vec3::Zero(), Vec3::UnitZ())).kind,
            DirectionPathFault::not_a_direction);
  EXPECT_EQ(fault(ac_table(), request_between(Vec3::UnitZ(), Vec3(infinity, 0, 0))).kind,
            DirectionPathFault::not_a_direction);
  EXPECT_EQ(fault(ac_table(), request_between(Vec3::UnitX(), -Vec3::UnitX())).kind,
            DirectionPathFault::opposite);
  // The 45 degree head reaches down to the horizon.
  const auto low = fault(nutating_b_head_c_table(), request_between(leaning(80, 0), leaning(100, 0)));
  EXPECT_EQ(low.kind, DirectionPathFault::unreachable);
  EXPECT_EQ(low.s, 1);
  EXPECT_LT((low.nearest - Vec3::UnitX()).norm(), 1e-9);
  // A from 30 to 40 passes its limit of 35 half request_between.
  auto request = request_between(leaning(30, -90), leaning(40, -90), {30, 0, 0});
  request.travel[a] = {-35, 35};
  const auto travel = fault(ac_table(), request);
  EXPECT_EQ(travel.kind, DirectionPathFault::outside_travel);
  EXPECT_GT(travel.s, 0.5) << "at the next of the checked places, a degree apart";
  EXPECT_LE(travel.s, 0.6);
  request = request_between(leaning(20, -90), leaning(20, 90), {20, 0, 0});
  request.avoid_poles = true;
  const auto pole = fault(ac_table(), request);
  EXPECT_EQ(pole.kind, DirectionPathFault::pole);
  EXPECT_NEAR(pole.s, 0.5, 1e-9);
  request = request_between(leaning(20, -90), leaning(20, 0), {20, 0, 0});
  request.avoid_poles = true;
  EXPECT_LT(path(ac_table(), request).angles(0)[a] - 20, 1e-9);
}

// Only one solution has A within 0 .. 100: the path changes over before it begins, and says so by start().
TEST(DirectionPath, takes_the_other_solution_when_the_travel_demands_it) {
  auto request = request_between(leaning(5, -90), leaning(20, 90), {5, 0, 0});
  request.travel[a] = {-10, 100};
  const auto p = path(ac_table(), request);
  EXPECT_NEAR(p.start()[a], -5, 1e-9);
  EXPECT_NEAR(std::abs(p.start()[c]), 180, 1e-9);
  EXPECT_NEAR(p.angles(1)[a], 20, 1e-9);
}

TEST(DirectionPath, one_rotary_axis_goes_along_its_own_circle_only) {
  const auto p = path(a_table(), request_between(leaning(10, -90), leaning(50, 90), {10, 0, 0}));
  EXPECT_NEAR(p.angles(0.5)[a], -20, 1e-9);
  EXPECT_NEAR(p.derivatives(0.5)[1][a], -60, 1e-9);
  EXPECT_EQ(fault(a_table(), request_between(leaning(10, -90), leaning(10, 0))).kind,
            DirectionPathFault::unreachable);
}

TEST(DirectionPath, equal_directions_stand_still) {
  const auto p = path(ac_table(), request_between(leaning(30, -90), 3 * leaning(30, -90), {30, 0, 720}));
  EXPECT_NEAR(p.angles(0.7)[c], 720, 1e-9);
  EXPECT_EQ(p.derivatives(0.5)[1][c], 0);
}

// Between any two directions of a machine: on the great circle to 1e-9 degrees away from windows and within
// the tolerance in them, continuous (no step is longer than the largest rate allows), ends as asked, and the
// derivatives are those of central differences (h = 1e-6; truncation h^2/6 of the third derivative,
// relative).
TEST(DirectionPath, holds_its_promises_between_random_directions) {
  std::mt19937_64 random(51);
  std::uniform_real_distribution<double> lean(0, 89), turn(-180, 180), unit(0, 1);
  int windows = 0, paths = 0;
  for (const auto& p : {ac_table(), bc_table(), cb_head(), b_head_c_table(), nutating_b_head_c_table(),
                        skewed_ac_table(), skewed_head(), ac_table_with_b_head()}) {
    const Chain chain = make(p);
    const OrientationSolver solver(chain);
    for (int i = 0; i < 300; ++i) {
      DirectionPathRequest request;
      request.from = leaning(lean(random), turn(random));
      request.to = leaning(lean(random), turn(random));
      if (i % 3 == 0) {  // aims at the pole, and misses it by 0 .. 0.1 degrees
        const Vec3 back = leaning(lean(random), turn(random));
        const Vec3 aside = Vec3::UnitZ().cross(back).normalized();
        request.from = back;
        request.to = -back + (back.z() + unit(random)) * Vec3::UnitZ() +
                     0.1 * radians_per_degree * unit(random) * aside;
      }
      const auto at_rest =
          solver.best({request.from, {}, request.travel, SolutionChoice::continuous, request.tolerance});
      if (at_rest.status != OrientationStatus::found) continue;
      request.present = at_rest.best.angles;
      const auto made = DirectionPath::make(solver, request);
      if (!std::holds_alternative<DirectionPath>(made)) continue;
      const auto& path = std::get<DirectionPath>(made);
      ++paths;
      windows += static_cast<int>(path.windows());
      ASSERT_LT(angle_between(chain.tool_direction_in_workpiece(path.angles(1)), request.to),
                0.051 * radians_per_degree);
      constexpr int places = 500;
      auto before = path.derivatives(0);
      for (int n = 0; n <= places; ++n) {
        const double s = static_cast<double>(n) / places;
        const auto now = path.derivatives(s);
        ASSERT_LE(angle_between(chain.tool_direction_in_workpiece(now[0]), path.arc().at(s)),
                  0.0501 * radians_per_degree);
        for (std::size_t k = 0; k < angle_count; ++k) {
          ASSERT_TRUE(std::isfinite(now[0][k]) && std::isfinite(now[1][k]));
          // Regular places only: where a rate itself changes slowly.
          const double rate = std::max(std::abs(now[1][k]), std::abs(before[1][k]));
          if (std::abs(now[2][k]) / places < 0.2 * rate && std::abs(before[2][k]) / places < 0.2 * rate) {
            ASSERT_LE(std::abs(now[0][k] - before[0][k]), 2 * rate / places + 1e-7) << n << " axis " << k;
          }
        }
        before = now;
        const double h = 1e-6;
        if (n % 5 != 2 || std::abs(now[1][c]) > 5000 || std::abs(now[1][b]) > 5000) continue;
        const auto low = path.derivatives(s - h), high = path.derivatives(s + h);
        for (std::size_t order = 1; order < 4; ++order)
          for (std::size_t k = 0; k < angle_count; ++k) {
            const double difference = (high[order - 1][k] - low[order - 1][k]) / (2 * h);
            const double size = 1 + std::abs(now[order][k]) + std::abs(now[order - 1][k]);
            // Across a window's border the third derivative jumps.
            if (order == 3 && path.windows() > 0) continue;
            ASSERT_NEAR(difference, now[order][k], 1e-3 * size)
                << "order " << order << " axis " << k << " s " << s;
          }
      }
    }
  }
  EXPECT_GT(paths, 1500);
  EXPECT_GT(windows, 100);
}

}  // namespace
}  // namespace trunnion::geometry
