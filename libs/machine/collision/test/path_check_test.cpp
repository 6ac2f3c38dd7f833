// SPDX-License-Identifier: Apache-2.0
#include "collision/path_check.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "geometry/random_source.hpp"
#include "geometry/test/machines.hpp"

namespace trunnion::collision {
namespace {

using Verdict = PathCheck::Verdict;

Verdict whole(PathCheck& check, const AxisPosition& from, const AxisPosition& to,
              const AxisPosition& deviation = {}) {
  check.begin(from, to, deviation, false);
  std::size_t budget = std::numeric_limits<std::size_t>::max();
  return check.advance(budget);
}

// A ball of 20 mm diameter in the spindle above a block on the table whose top is at Z-100.
CollisionModel ball_over_block(double clearance) {
  auto links = std::get<MachineLinks>(MachineLinks::make(geometry::ChainParameters{}));
  BodySet set;
  set.clearance = clearance;
  set.bodies = {{"block", links.workpiece(), Box{Vec3(50, 50, 50)}, Vec3(0, 0, -150)},
                {"ball", links.spindle(), Sphere{10}, links.face()}};
  return {std::move(links), std::move(set)};
}

TEST(PathCheck, StopsAMoveWhereTheClearanceBegins) {
  const auto model = ball_over_block(1);
  PathCheck check(model);
  ASSERT_EQ(whole(check, {}, {0, 0, -200}), Verdict::contact);
  // The ball touches at Z-90; with 1 mm of clearance it is reported between Z-89 and the resolution before
  // it.
  EXPECT_LE(check.contact().position[2], -89 + PathCheck::resolution + 1e-9);
  EXPECT_GE(check.contact().position[2], -89);
  EXPECT_EQ(whole(check, {}, {0, 0, -88.9}), Verdict::free);
}

TEST(PathCheck, TheDeviationOfTheAxesAddsToTheClearance) {
  const auto model = ball_over_block(1);
  PathCheck check(model);
  // 0.3 mm of Z and nothing else moves the ball towards the block.
  ASSERT_EQ(whole(check, {}, {0, 0, -200}, {0, 0, 0.3}), Verdict::contact);
  EXPECT_LE(check.contact().position[2], -88.7 + PathCheck::resolution + 1e-9);
  EXPECT_GE(check.contact().position[2], -88.7);
}

TEST(PathCheck, APathThatBeginsWithinTheClearanceMayOnlyLeadAway) {
  const auto model = ball_over_block(1);
  PathCheck check(model);
  const AxisPosition near_top{0, 0, -89.5};
  EXPECT_EQ(whole(check, near_top, {0, 0, -50}), Verdict::free) << "away";
  ASSERT_EQ(whole(check, near_top, {0, 0, -89.6}), Verdict::contact) << "towards";
  EXPECT_EQ(check.contact().share, 0) << "no part of it";
  EXPECT_EQ(whole(check, {0, 0, -95}, {0, 0, -50}), Verdict::free) << "out of the block";
  EXPECT_EQ(whole(check, {0, 0, -95}, {0, 0, -97}), Verdict::contact) << "farther into it";
}

TEST(PathCheck, APathThatHasLeftTheClearanceDoesNotComeBack) {
  const auto model = ball_over_block(1);
  PathCheck check(model);
  ASSERT_EQ(whole(check, {0, 0, -89.5}, {0, 0, -80}), Verdict::free);
  EXPECT_EQ(whole(check, {0, 0, -80}, {0, 0, -89.5}), Verdict::contact);
}

TEST(PathCheck, GoesOnWhereTheBudgetEnded) {
  const auto model = ball_over_block(1);
  PathCheck all(model), parts(model);
  ASSERT_EQ(whole(all, {-300, 0, -88.9}, {300, 0, -88.8}), Verdict::free);
  parts.begin({-300, 0, -88.9}, {300, 0, -88.8}, {}, false);
  Verdict verdict = Verdict::unfinished;
  int calls = 0;
  for (; verdict == Verdict::unfinished; ++calls) {
    std::size_t budget = 3;
    verdict = parts.advance(budget);
  }
  EXPECT_EQ(verdict, Verdict::free);
  EXPECT_GT(calls, 1);
  EXPECT_EQ(parts.distances(), all.distances());
}

TEST(PathCheck, ShortMovesFarFromEverythingCostNoDistances) {
  const auto model = ball_over_block(1);
  PathCheck check(model);
  AxisPosition at{};
  for (int i = 1; i <= 1000; ++i) {
    AxisPosition next = at;
    next[0] = 20 * std::sin(0.01 * i), next[1] = 20 * std::cos(0.01 * i);
    ASSERT_EQ(whole(check, at, next), Verdict::free);
    at = next;
  }
  EXPECT_LE(check.distances(), 5u);
}

// The distances of the test itself: spheres on both sides of a machine with a rotary table and cradle.
struct Ball {
  Vec3 centre;
  double radius;
};

TEST(PathCheck, NoSampleOfARandomPathIsNearerThanTheClearanceBeforeItsContact) {
  const auto design = geometry::ac_table();
  constexpr std::size_t balls = 4;
  constexpr int samples = 300;  // of a move
  int contacts = 0, free = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    geometry::RandomSource random(seed);
    const auto number = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    auto links = std::get<MachineLinks>(MachineLinks::make(design));
    const Vec3 tip = links.face();
    std::vector<Ball> on_table, on_spindle;
    BodySet set;
    set.clearance = 2;
    for (std::size_t i = 0; i < balls; ++i) {
      on_table.push_back(
          {tip + Vec3(number(-100, 100), number(-100, 100), number(-250, -100)), number(10, 50)});
      on_spindle.push_back({tip + Vec3(number(-30, 30), number(-30, 30), number(0, 80)), number(5, 20)});
      set.bodies.push_back({"t" + std::to_string(i), links.workpiece(), Sphere{on_table.back().radius},
                            on_table.back().centre});
      set.bodies.push_back({"s" + std::to_string(i), links.spindle(), Sphere{on_spindle.back().radius},
                            on_spindle.back().centre});
    }
    const CollisionModel model(links, set);
    // Independent of the product: each joint by its own axis-angle rotation, one after the other.
    const auto placed = [&](bool workpiece, Vec3 p, const AxisPosition& q) {
      const auto& joints = links.joints(workpiece);
      for (std::size_t k = joints.size(); k-- > 0;) {
        const auto& joint = joints[k];
        if (!joint.rotary) {
          p += q[joint.axis] * joint.direction;
          continue;
        }
        const double a = q[joint.axis] * M_PI / 180;
        const Vec3 r = p - joint.point, n = joint.direction;
        p = joint.point + std::cos(a) * r + std::sin(a) * n.cross(r) + (1 - std::cos(a)) * n.dot(r) * n;
      }
      return p;
    };
    const auto least = [&](const AxisPosition& q) {
      double d = 1e9;
      std::array<Vec3, balls> heads;
      for (std::size_t i = 0; i < balls; ++i) heads[i] = placed(false, on_spindle[i].centre, q);
      for (const auto& t : on_table) {
        const Vec3 centre = placed(true, t.centre, q);
        for (std::size_t i = 0; i < balls; ++i)
          d = std::min(d, (centre - heads[i]).norm() - t.radius - on_spindle[i].radius);
      }
      return d;
    };
    PathCheck check(model);
    AxisPosition at{};
    if (least(at) < 3) continue;
    for (int move = 0; move < 12; ++move) {
      const AxisPosition to{number(-150, 150), number(-150, 150), number(-250, 50), number(-60, 60), 0,
                            number(-180, 180)};
      const auto verdict = whole(check, at, to);
      const double share = verdict == Verdict::contact ? check.contact().share : 1;
      for (int i = 0; i <= samples; ++i) {
        AxisPosition q{};
        for (std::size_t k = 0; k < q.size(); ++k) q[k] = at[k] + share * i / samples * (to[k] - at[k]);
        ASSERT_GE(least(q), 2 - 1e-6) << "seed " << seed << " move " << move << " sample " << i;
      }
      if (verdict == Verdict::contact) {
        // And it is none: just there the distance is the clearance and the resolution.
        ASSERT_LE(least(check.contact().position), 2 + PathCheck::resolution + 1e-6);
        ++contacts;
        continue;  // another target from the same place
      }
      ++free;
      at = to;
    }
  }
  EXPECT_GT(contacts, 30);
  EXPECT_GT(free, 30);
}

}  // namespace
}  // namespace trunnion::collision
