// SPDX-License-Identifier: Apache-2.0
#include "geometry/orientation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "geometry/angle.hpp"
#include "machines.hpp"

namespace trunnion::geometry {
namespace {

const double half = 0.5, root_half = std::sqrt(0.5), root_three_quarters = std::sqrt(0.75);
constexpr std::size_t a = 0, b = 1, c = 2;

OrientationRequest towards(const Vec3& direction) {
  OrientationRequest request;
  request.direction = direction;
  return request;
}

std::vector<Orientation> every(const ChainParameters& p, const OrientationRequest& request) {
  const OrientationSolver solver(make(p));
  std::vector<Orientation> out(OrientationSolver::most_solutions);
  OrientationAnswer answer;
  out.resize(solver.all(request, out, answer));
  return out;
}

OrientationAnswer best(const ChainParameters& p, const OrientationRequest& request) {
  return OrientationSolver(make(p)).best(request);
}

// A turns the table about -X: the tool leans to (0, -sin A, cos A). The other solution leans the other way
// and turns the table by half a turn. C of this machine is endless, so each is listed once.
TEST(Orientation, ac_table_has_two_solutions_and_prefers_the_shorter_way_of_c) {
  const auto solutions = every(ac_table(), towards(Vec3(0, -half, root_three_quarters)));
  ASSERT_EQ(solutions.size(), 2u);
  EXPECT_NEAR(solutions[0].angles[a], 30, 1e-12);
  EXPECT_NEAR(solutions[0].angles[c], 0, 1e-12);
  EXPECT_NEAR(solutions[1].angles[a], -30, 1e-12);
  EXPECT_NEAR(std::abs(solutions[1].angles[c]), 180, 1e-12);
  EXPECT_NEAR(solutions[0].regularity, half, 1e-12) << "sin 30";
}

// B30 with C0 or a full turn away; B-30 with C half a turn to either side. All of B's ways are 30.
TEST(Orientation, full_turns_within_the_travel_are_solutions_of_their_own) {
  auto request = towards(Vec3(half, 0, root_three_quarters));
  request.travel[b] = {-110, 110};
  request.travel[c] = {-380, 380};
  const auto solutions = every(cb_head(), request);
  const double expected[][2] = {{30, 0}, {-30, 180}, {-30, -180}, {30, 360}, {30, -360}};
  ASSERT_EQ(solutions.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(solutions[i].angles[b], expected[i][0], 1e-12) << i;
    EXPECT_NEAR(solutions[i].angles[c], expected[i][1], 1e-12) << i;
  }
}

// From A45, where A30 and A-30 are both in the negative direction.
TEST(Orientation, p1_and_p2_choose_the_solution_by_the_sign_of_the_axis_nearest_the_tool) {
  auto request = towards(Vec3(0, -half, root_three_quarters));
  request.travel[a] = {-110, 110};
  for (const double present : {45.0, 0.0, -45.0}) {
    request.present[a] = present;
    request.choice = SolutionChoice::positive;
    EXPECT_NEAR(best(ac_table(), request).best.angles[a], 30, 1e-12) << present;
    request.choice = SolutionChoice::negative;
    EXPECT_NEAR(best(ac_table(), request).best.angles[a], -30, 1e-12) << present;
  }
}

TEST(Orientation, p1_and_p2_turn_an_endless_axis_only_one_way) {
  auto request = towards(Vec3(0, -half, root_three_quarters));
  request.present[a] = -10;
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], 30, 1e-12) << "40 degrees of A instead of 180 of C";
  request.choice = SolutionChoice::positive;
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], 30, 1e-12);
  request.choice = SolutionChoice::negative;
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], -30, 1e-12);
  request.travel[a] = {-20, 110};
  EXPECT_EQ(best(ac_table(), request).status, OrientationStatus::outside_travel);
  request.choice = SolutionChoice::shortest;
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], 30, 1e-12) << "all that the travel leaves";
}

// From A20 C170 to the direction of A25 C30, which is also that of A-25 C-150 or C210: A turns 5 and C 140
// degrees, or A 45 and C 40. With C 14 times as fast as A the first takes 10 degrees of A, the second 45.
TEST(Orientation, p0_takes_the_least_time_of_both_axes) {
  auto request = towards(make(ac_table()).tool_direction_in_workpiece({25, 0, 30}));
  request.present = {20, 0, 170};
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], -25, 1e-9);
  EXPECT_NEAR(best(ac_table(), request).best.angles[c], 210, 1e-9);
  request.rate[c] = 14 * request.rate[a];
  EXPECT_NEAR(best(ac_table(), request).best.angles[a], 25, 1e-9);
  EXPECT_NEAR(best(ac_table(), request).best.angles[c], 30, 1e-9);
}

// From A-5 C0 to the direction of A2 C100, which is also that of A-2 C-80: 7 + 100 or 3 + 80 degrees. From A5
// C90: 3 + 10 or 7 + 170.
TEST(Orientation, continuity_keeps_the_branch_the_rotary_axes_are_on) {
  auto request = towards(make(ac_table()).tool_direction_in_workpiece({2, 0, 100}));
  request.choice = SolutionChoice::continuous;
  request.present = {-5, 0, 0};
  EXPECT_NEAR(best(ac_table(), request).best.angles[c], -80, 1e-9);
  request.present = {5, 0, 90};
  EXPECT_NEAR(best(ac_table(), request).best.angles[c], 100, 1e-9);
  request.present = {5, 0, 3690};
  EXPECT_NEAR(best(ac_table(), request).best.angles[c], 3700, 1e-9) << "ten turns on, still near";
}

TEST(Orientation, at_the_pole_the_axis_under_the_workpiece_stays_where_it_is) {
  auto request = towards(Vec3(0, 0, 1));
  request.present = {25, 0, 123};
  const auto answer = best(ac_table(), request);
  ASSERT_EQ(answer.status, OrientationStatus::found);
  EXPECT_NEAR(answer.best.angles[a], 0, 1e-12);
  EXPECT_EQ(answer.best.angles[c], 123);
  EXPECT_EQ(answer.best.regularity, 0);
  EXPECT_EQ(every(ac_table(), request).size(), 1u);
}

// One degree of direction across needs at most 1/regularity degrees of an axis: compared with the solution
// for a direction 1e-6 degrees away in the worst of many senses.
TEST(Orientation, regularity_bounds_how_far_the_axes_turn) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> lean(5, 85), turn(-180, 180);
  for (const auto& p : {ac_table(), cb_head(), nutating_b_head_c_table(), skewed_head()}) {
    const Chain chain = make(p);
    const OrientationSolver solver(chain);
    for (int i = 0; i < 200; ++i) {
      OrientationRequest request;
      request.choice = SolutionChoice::continuous;
      for (auto& angle : request.present) angle = lean(random);
      const Vec3 u = chain.tool_direction_in_workpiece(request.present);
      const auto here = solver.best(towards(u)), same = solver.best([&] {
        auto r = request;
        r.direction = u;
        return r;
      }());
      ASSERT_EQ(here.status, OrientationStatus::found);
      const double eps = 1e-6 * radians_per_degree;
      for (int k = 0; k < 8; ++k) {
        Vec3 across = u.cross(Vec3(std::cos(k), std::sin(k), 0.3 * k));
        request.direction = u + eps * across.normalized();
        const auto there = solver.best(request);
        for (std::size_t n = 0; n < angle_count; ++n)
          ASSERT_LE(std::abs(there.best.angles[n] - same.best.angles[n]),
                    1.01e-6 / same.best.regularity + 1e-12);
      }
    }
  }
}

// About (0, 1, 1) by 90 degrees: k x z + (k.z) k = (sqrt 1/2, 0, 0) + (0, 1/2, 1/2). By 180: 2 (k.z) k - z =
// (0, 1, 0). It reaches no lower than that: straight down the nearest is horizontal.
TEST(Orientation, nutating_head_by_hand) {
  auto request = towards(Vec3(root_half, half, half));
  request.travel[b] = {-1, 181};
  auto answer = best(nutating_b_head_c_table(), request);
  ASSERT_EQ(answer.status, OrientationStatus::found);
  EXPECT_NEAR(answer.best.angles[b], 90, 1e-12);
  EXPECT_NEAR(answer.best.angles[c], 0, 1e-12);
  request.direction = Vec3(0, 1, 0);
  answer = best(nutating_b_head_c_table(), request);
  EXPECT_NEAR(answer.best.angles[b], 180, 1e-6) << "the border: B turns with the root of the direction";
  EXPECT_NEAR(answer.best.angles[c], 0, 1e-6);
  request.direction = Vec3(1e-3, 0, -1);
  answer = best(nutating_b_head_c_table(), request);
  EXPECT_EQ(answer.status, OrientationStatus::unreachable);
  EXPECT_NEAR((answer.nearest - Vec3(1, 0, 0)).norm(), 0, 1e-12);
}

// A four-axis machine reaches only directions across its axis: of (0.6, -0.4, 0.6928) the part across X,
// whose lean is atan(0.4 / 0.6928) = 30 degrees.
TEST(Orientation, one_rotary_axis_reaches_a_circle_and_names_the_nearest_on_it) {
  const double w = 0.4 * std::sqrt(3.0);
  auto answer = best(a_table(), towards(Vec3(0, -0.4, w)));
  ASSERT_EQ(answer.status, OrientationStatus::found);
  EXPECT_NEAR(answer.best.angles[a], 30, 1e-12);
  answer = best(a_table(), towards(Vec3(0.6, -0.4, w)));
  EXPECT_EQ(answer.status, OrientationStatus::unreachable);
  EXPECT_LT((answer.nearest - Vec3(0, -half, root_three_quarters)).norm(), 1e-12);
}

TEST(Orientation, a_machine_without_rotary_axes_has_one_direction) {
  EXPECT_EQ(best({}, towards(Vec3(0, 0, 3))).status, OrientationStatus::found);
  const auto answer = best({}, towards(Vec3(0, 1, 1)));
  EXPECT_EQ(answer.status, OrientationStatus::unreachable);
  EXPECT_EQ(answer.nearest, Vec3(0, 0, 1));
}

// C and A under the workpiece, B in the head: A and B are the pair nearest the tool. With B shut, C and B
// come next and cannot, then C and A lean the tool to +X as A30 with C turned: the tool leans to (sin A sin
// C, -sin A cos C, cos A), so C90.
TEST(Orientation, redundant_axes_stay_and_the_pair_nearest_the_tool_moves) {
  auto request = towards(Vec3(half, 0, root_three_quarters));
  auto answer = best(ac_table_with_b_head(), request);
  ASSERT_EQ(answer.status, OrientationStatus::found);
  EXPECT_NEAR(answer.best.angles[a], 0, 1e-12);
  EXPECT_NEAR(answer.best.angles[b], 30, 1e-12);
  EXPECT_EQ(answer.best.angles[c], 0);
  request.travel[b] = {-10, 10};
  answer = best(ac_table_with_b_head(), request);
  ASSERT_EQ(answer.status, OrientationStatus::found);
  EXPECT_NEAR(answer.best.angles[a], 30, 1e-12);
  EXPECT_EQ(answer.best.angles[b], 0);
  EXPECT_NEAR(answer.best.angles[c], 90, 1e-12);
}

TEST(Orientation, refuses_what_is_no_direction) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const Vec3& d : {Vec3(0, 0, 0), Vec3(nan, 0, 1), Vec3(0, inf, 1), Vec3(-inf, inf, nan)})
    EXPECT_EQ(best(ac_table(), towards(d)).status, OrientationStatus::not_a_direction);
  EXPECT_EQ(best(ac_table(), towards(Vec3(0, 0, 1e-300))).status, OrientationStatus::found);
  EXPECT_EQ(best(ac_table(), towards(Vec3(0, 1e300, 1e300))).status, OrientationStatus::found);
}

// On the machine whose axes are as a calibration found them, the direction of the C axis itself is out of
// reach by the 1e-4 by which A and the tool are not perpendicular to it: an orientation tolerance closes
// that.
TEST(Orientation, a_tolerance_accepts_the_nearest_direction) {
  auto request = towards(Vec3(-2e-4, -1e-5, 1));
  EXPECT_EQ(best(skewed_ac_table(), request).status, OrientationStatus::unreachable);
  request.tolerance = 0.05;
  const auto answer = best(skewed_ac_table(), request);
  ASSERT_EQ(answer.status, OrientationStatus::found);
  const Vec3 reached = make(skewed_ac_table()).tool_direction_in_workpiece(answer.best.angles);
  EXPECT_LT(angle_between(reached, request.direction), 0.05 * radians_per_degree);
}

// Every solution lies within the travel, has the direction, comes in order of its way, differs from the
// others, and the first is best(); the position the direction was made from is among them.
TEST(Orientation, lists_hold_what_they_promise_over_random_poses) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> any(-400, 400), width(30, 800);
  for (const Machine& m : machines()) {
    const Chain chain = make(m.parameters);
    if (chain.rotary_count() > 2) continue;
    const OrientationSolver solver(chain);
    std::vector<Orientation> list(OrientationSolver::most_solutions);
    for (int i = 0; i < 3000; ++i) {
      OrientationRequest request;
      Angles target{};
      for (std::size_t n = 0; n < angle_count; ++n) {
        const double low = any(random), high = low + width(random);
        request.travel[n] = {low, high};
        target[n] = std::uniform_real_distribution<double>(low, high)(random);
        request.present[n] = std::uniform_real_distribution<double>(low, high)(random);
      }
      request.direction = chain.tool_direction_in_workpiece(target);
      const auto longest = [&](const Orientation& o) {
        double travel = 0;
        for (std::size_t n = 0; n < angle_count; ++n)
          travel = std::max(travel, std::abs(o.angles[n] - request.present[n]));
        return travel;
      };
      OrientationAnswer answer;
      const auto count = solver.all(request, list, answer);
      ASSERT_EQ(answer.status, OrientationStatus::found) << m.name;
      bool target_there = false;
      for (std::size_t k = 0; k < count; ++k) {
        bool same = true;
        for (std::size_t n = 0; n < chain.rotary_count(); ++n) {
          const auto axis = chain.orienting_axis(n).angle;
          ASSERT_GE(list[k].angles[axis], request.travel[axis].negative - 1e-8);
          ASSERT_LE(list[k].angles[axis], request.travel[axis].positive + 1e-8);
          same = same && std::abs(list[k].angles[axis] - target[axis]) < 1e-5;
        }
        target_there = target_there || same;
        ASSERT_LT((chain.tool_direction_in_workpiece(list[k].angles) - request.direction).norm(), 1e-12);
        if (k > 0) {
          ASSERT_GE(longest(list[k]) - longest(list[k - 1]), -1e-6);
        }
      }
      ASSERT_TRUE(target_there) << m.name;
      const auto first = solver.best(request);
      for (std::size_t n = 0; n < angle_count; ++n)
        ASSERT_NEAR(first.best.angles[n], list[0].angles[n], 1e-9) << m.name;
    }
  }
}

TEST(Angle, sine_and_cosine_are_those_of_the_c_library_and_exact_at_quarter_turns) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> angle(-360, 360);
  for (int i = 0; i < 100000; ++i) {
    const double degrees = angle(random);
    const auto t = sine_cosine(degrees);
    const long double radians = static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
    // Half a unit of the result and what rounding the radians to 53 bits costs.
    ASSERT_NEAR(static_cast<double>(t.sine - std::sin(radians)), 0, 3e-16) << degrees;
    ASSERT_NEAR(static_cast<double>(t.cosine - std::cos(radians)), 0, 3e-16) << degrees;
  }
  const double sine[] = {0, 1, 0, -1}, cosine[] = {1, 0, -1, 0};
  for (int k = -4000; k <= 4000; ++k) {
    const auto t = sine_cosine(90.0 * k);
    ASSERT_EQ(t.sine, sine[k & 3]);
    ASSERT_EQ(t.cosine, cosine[k & 3]);
  }
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::infinity()).sine));
  EXPECT_TRUE(std::isnan(sine_cosine(std::numeric_limits<double>::quiet_NaN()).cosine));
  EXPECT_EQ(sine_cosine(360.0 * 1e15).cosine, 1);
}

// Against the C library in 80 bits, for vectors of any size and as near to the axes as they come.
TEST(Angle, the_arc_tangent_is_that_of_the_c_library_and_exact_on_the_axes) {
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> part(-1, 1), exponent(-20, 20);
  for (int i = 0; i < 200000; ++i) {
    const double scale = std::pow(10, exponent(random));
    const double y = part(random) * (i % 2 == 0 ? 1 : std::pow(10, exponent(random))) * scale;
    const double x = part(random) * scale;
    const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
    const double size = std::min(1.0, std::abs(static_cast<double>(exact)));
    ASSERT_NEAR(static_cast<double>(arc_tangent(y, x) - exact), 0, std::abs(exact) < 1 ? 4e-16 * size : 5e-16)
        << y << " " << x;
  }
  const double pi = std::numbers::pi, inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(arc_tangent(0, 2), 0);
  EXPECT_EQ(arc_tangent(2, 0), pi / 2);
  EXPECT_EQ(arc_tangent(-2, 0), -pi / 2);
  EXPECT_EQ(arc_tangent(0, -2), pi);
  EXPECT_EQ(arc_tangent(3, 3), pi / 4);
  EXPECT_EQ(arc_tangent(0, 0), 0);
  EXPECT_TRUE(std::isnan(arc_tangent(inf, 1)) && std::isnan(arc_tangent(1, std::nan(""))) &&
              std::isnan(arc_tangent(std::nan(""), 1)));
}

}  // namespace
}  // namespace trunnion::geometry
