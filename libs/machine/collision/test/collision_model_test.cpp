// SPDX-License-Identifier: Apache-2.0
#include "collision/collision_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/angle.hpp"
#include "geometry/random_source.hpp"
#include "geometry/test/machines.hpp"

namespace trunnion::collision {
namespace {

// A sphere on the table at radius 200 mm of C, another one on the spindle.
geometry::ChainParameters c_table() {
  geometry::ChainParameters p;
  p.table_2 = geometry::RotaryAxis{Vec3(0, 0, 1), Vec3(0, 0, 0), 2};
  return p;
}
CollisionModel two_spheres(double clearance) {
  auto links = std::get<MachineLinks>(MachineLinks::make(c_table()));
  BodySet set;
  set.clearance = clearance;
  set.bodies = {{"on table", links.workpiece(), Sphere{10}, Vec3(200, 0, 0)},
                {"on spindle", links.spindle(), Sphere{20}, Vec3::Zero()}};
  return {std::move(links), std::move(set)};
}

TEST(CollisionModel, NearestPairInClosedForm) {
  const auto model = two_spheres(1);
  // At C60 the sphere of the table is at 200 (cos 60, sin 60).
  const AxisPosition at{50, 30, 40, 0, 0, 60};
  const double expected = (Vec3(100, 200 * std::sqrt(0.75), 0) - Vec3(50, 30, 40)).norm() - 30;
  const auto found = model.nearest(at);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->distance, expected, 1e-9);
  EXPECT_FALSE(model.nearest(at, expected - 0.1));
  EXPECT_FALSE(model.collides(at));
  EXPECT_TRUE(model.collides({100, 200 * std::sqrt(0.75), 30.9, 0, 0, 60}));
  EXPECT_FALSE(model.collides({100, 200 * std::sqrt(0.75), 31.1, 0, 0, 60}));
  EXPECT_EQ(model.text_of(*model.nearest({200, 0, 25, 0, 0, 0})),
            "'on table' and 'on spindle' overlap by 5.000 mm");
}

TEST(CollisionModel, FirstContactWhileTheTableTurnsInClosedForm) {
  const auto model = two_spheres(0.5);
  // C turns the sphere towards the other one at X0 Y200: they are 30.5 apart at the chord
  // 2 * 200 sin(phi / 2) with phi = 90 - C.
  const double phi = 2 * std::asin(30.5 / 400) / geometry::radians_per_degree;
  const auto contact = model.first_contact({0, 200, 0, 0, 0, -90}, {0, 200, 0, 0, 0, 180});
  ASSERT_TRUE(contact);
  // The contact may be reported up to 0.01 mm early: 0.01 / 200 rad.
  const double latest = 90 - phi, earliest = latest - 0.0101 / 200 / geometry::radians_per_degree;
  EXPECT_LE(contact->position[5], latest + 1e-9);
  EXPECT_GE(contact->position[5], earliest);
  EXPECT_NEAR(contact->share, (contact->position[5] + 90) / 270, 1e-12);
  EXPECT_FALSE(model.first_contact({0, 200, 0, 0, 0, -90}, {0, 200, 0, 0, 0, earliest - 1e-6}));
}

TEST(CollisionModel, NeighboursAndAllowedPairsAreNotChecked) {
  auto links = std::get<MachineLinks>(MachineLinks::make(geometry::ac_table()));
  BodySet set;
  const auto add = [&](const char* name, const char axis) {
    set.bodies.push_back({name, *links.carried_by(std::string_view("XYZABC").find(axis)), Sphere{10}});
  };
  add("c", 'C'), add("a", 'A'), add("x", 'X'), add("y", 'Y'), add("z", 'Z');
  set.bodies.push_back({"base", Link{}, Sphere{10}});
  set.allowed = {{"z", "a"}};
  // 15 pairs; neighbours: base-a, base-x, a-c, x-y, y-z; allowed: a-z.
  EXPECT_EQ(CollisionModel(links, set).pair_count(), 9u);
}

// A machine with bodies of all shapes, thin ones among them.
CollisionModel workshop(double clearance) {
  auto links = std::get<MachineLinks>(MachineLinks::make(geometry::ac_table()));
  const Vec3 table(-200, -190, -516);
  BodySet set;
  set.clearance = clearance;
  const Link workpiece = links.workpiece(), spindle = links.spindle(), cradle = *links.carried_by(3);
  set.bodies = {
      {"table", workpiece, Cylinder{160, 20}, table - Vec3(0, 0, 20)},
      {"plate", workpiece, Box{Vec3(60, 0.5, 40)}, table + Vec3(40, 30, 40)},
      {"sphere", workpiece, Sphere{12.5}, table + Vec3(-80, 20, 90)},
      {"cradle", cradle, Box{Vec3(15, 120, 60)}, table + Vec3(200, 0, 0)},
      {"nose", spindle, Cylinder{50, 75}, Vec3(0, 0, 75)},
      {"needle", spindle, Cylinder{1.5, 60}, Vec3(0, 0, -60)},
      {"wedge", spindle, Hull{{{30, 30, 0}, {60, 30, 0}, {30, 60, 0}, {30, 30, 50}}}, Vec3::Zero()}};
  return {std::move(links), std::move(set)};
}

TEST(CollisionModel, NothingIsOverlookedBetweenTheSamplesOfRandomMoves) {
  const auto model = workshop(1);
  geometry::RandomSource random(11);
  const auto draw = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  int contacts = 0, free = 0;
  for (int i = 0; i < 200; ++i) {
    const auto position = [&] {
      return AxisPosition{draw(-450, 50), draw(-450, 50), draw(-450, -150), draw(-90, 60), 0,
                          draw(-180, 180)};
    };
    const auto from = position(), to = position();
    const auto contact = model.first_contact(from, to);
    const double end = contact ? contact->share : 1;
    // An independent dense check of all that lies before the contact.
    constexpr int samples = 400;
    for (int k = 0; k < samples + (contact ? 0 : 1) && end > 0; ++k) {
      AxisPosition at{};
      const double share = end * k / samples;
      for (std::size_t n = 0; n < at.size(); ++n) at[n] = from[n] + share * (to[n] - from[n]);
      const auto near = model.nearest(at, 5);
      // Distances are right within 0.002 mm.
      ASSERT_FALSE(near && near->distance < 1 - 0.002)
          << i << ": " << model.text_of(*near) << " at the share " << share << " of " << end;
    }
    if (!contact) {
      ++free;
      continue;
    }
    ++contacts;
    const auto there = model.nearest(contact->position, 5);
    ASSERT_TRUE(there);
    EXPECT_LE(there->distance, 1 + 0.0101) << "the contact is none";
  }
  EXPECT_GT(contacts, 50);
  EXPECT_GT(free, 20);
}

TEST(CollisionModel, AThinPlateStopsAFastNeedle) {
  const auto model = workshop(1);
  // The needle passes the plate of 1 mm at Y -160 from Y -400 to Y 0 at the height of its middle.
  const auto contact = model.first_contact({-160, -400, -380, 0, 0, 0}, {-160, 0, -380, 0, 0, 0});
  ASSERT_TRUE(contact);
  EXPECT_EQ(model.bodies()[contact->pair.first].name, "plate");
  EXPECT_EQ(model.bodies()[contact->pair.second].name, "needle");
  // The plate begins at Y -160.5; needle 1.5, clearance 1, at most 0.01 early.
  EXPECT_LE(contact->position[1], -160.5 - 2.5 + 1e-3);
  EXPECT_GE(contact->position[1], -160.5 - 2.5 - 0.0101);
}

TEST(CollisionModel, TheTableOfClearancesHasTheLeastDistanceOfEachPair) {
  const auto model = two_spheres(1);
  ClearanceTable table;
  for (std::size_t i = 0; i <= 10; ++i)
    model.note({0, 200, 0, 0, 0, 9.0 * static_cast<double>(i) - 20}, i, 1000, table);
  ASSERT_EQ(table.rows().size(), 1u);
  EXPECT_EQ(table.rows()[0].at, 10u);  // C70 is nearest to C90
  EXPECT_NEAR(table.rows()[0].distance, 400 * std::sin(10 * geometry::radians_per_degree) - 30, 1e-9);
}

}  // namespace
}  // namespace trunnion::collision
