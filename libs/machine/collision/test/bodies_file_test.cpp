// SPDX-License-Identifier: Apache-2.0
#include "collision/bodies_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/test/machines.hpp"
#include "testing_support/refusal.hpp"

namespace trunnion::collision {
namespace {

MachineBodies parsed(const std::string& text) {
  return parse_bodies(text, "bodies.yaml", geometry::ac_table());
}
std::string refusal(const std::string& text) {
  return testing_support::refusal_of([&] { parsed(text); });
}

TEST(BodiesFile, EveryShapeOnItsLink) {
  const auto bodies = parsed(R"(
structure: "[w C' A' Y' b X Z (S) t]"
clearance_mm: 2.5
bodies:
  - {name: bed, on: base, box: {size_mm: [1000, 800, 300]}, position_mm: [0, 0, -900]}
  - {name: table, on: workpiece, cylinder: {diameter_mm: 320, height_mm: 40}, position_mm: [0, 0, -20]}
  - {name: cradle, on: A, hull: {points_mm: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
  - {name: nose, on: spindle, cylinder: {diameter_mm: 100, height_mm: 150}, rotation_deg: [90, 0, 0]}
  - {name: ball, on: tool, sphere: {diameter_mm: 6}, position_mm: [0, 0, -60]}
allowed: [[ball, bed]]
)");
  ASSERT_EQ(bodies.set.bodies.size(), 5u);
  EXPECT_EQ(bodies.set.clearance, 2.5);
  EXPECT_EQ(bodies.set.bodies[0].link, Link{});
  EXPECT_EQ(bodies.set.bodies[1].link, (Link{true, 3}));
  EXPECT_EQ(bodies.set.bodies[2].link, (Link{true, 2}));
  EXPECT_EQ(bodies.set.bodies[3].link, (Link{false, 2}));
  EXPECT_EQ(std::get<Box>(bodies.set.bodies[0].shape).half_lengths, Vec3(500, 400, 150));
  EXPECT_EQ(std::get<Cylinder>(bodies.set.bodies[1].shape).half_height, 20);
  EXPECT_EQ(std::get<Hull>(bodies.set.bodies[2].shape).points.size(), 4u);
  EXPECT_LT((bodies.set.bodies[3].rotation.col(2) - Vec3(0, -1, 0)).norm(), 1e-12) << "about X by 90 degrees";
  EXPECT_TRUE(bodies.set.bodies[4].tool);
  EXPECT_FALSE(bodies.set.bodies[3].tool);
  EXPECT_EQ(bodies.set.allowed[0].second, "bed");
}

TEST(BodiesFile, AnEmptyOneHasNoBodies) { EXPECT_TRUE(parsed("").set.bodies.empty()); }

TEST(BodiesFile, EveryFaultIsOneLineWithItsPlace) {
  const std::string body = "bodies: [{name: a, on: Z, ";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"bodys: []", "1:1: error: unknown key 'bodys'; the keys are structure, clearance_mm, bodies, allowed"},
      {"clearance_mm: 0", "1:15: error: 0 is not within 0.01 .. 100"},
      {"structure: \"[w C' b X Y Z t]\"", "1:12: error: axis A must be there once"},
      {"bodies: 3", "1:9: error: expected a list of bodies"},
      {"bodies: [{on: Z, sphere: {diameter_mm: 1}}]", "1:10: error: 'name' is missing"},
      {"bodies: [{name: a, sphere: {diameter_mm: 1}}]", "1:10: error: 'on' is missing"},
      {body + "x: 1}]", "error: unknown key 'x'; the keys are name, on, one of box"},
      {body + "position_mm: [0, 0, 0]}]", "1:10: error: a shape is missing"},
      {body + "sphere: {diameter_mm: 0}}]", "1:49: error: 0 is not within 0.01 .. 100000"},
      {body + "sphere: {}}]", "1:35: error: 'diameter_mm' is missing"},
      {body + "cylinder: {diameter_mm: 3}}]", "error: 'height_mm' is missing"},
      {body + "sphere: {diameter_mm: 1}, box: {size_mm: [1, 1, 1]}}]", "'sphere' is there already"},
      {body + "hull: {points_mm: [[0, 0, 0]]}}]", "expected a list of 4 .. 64 points"},
      {body + "hull: {points_mm: [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]}}]", "the points are in a plane"},
      {body + "hull: {points_mm: [[0,0,0],[1,0,0],[2,0,0],[3,0,0]]}}]", "the points are in a plane"},
      {"bodies: [{name: a, on: B, sphere: {diameter_mm: 1}}]",
       "1:24: error: 'B' is none of base, workpiece, spindle, tool and the axes of [w C' A' b X Y Z (S) t]"},
      {"bodies: [{name: a, on: Z, sphere: {diameter_mm: 1}}, {name: a, on: Z, sphere: {diameter_mm: 1}}]",
       "'a' is there twice"},
      {body + "sphere: {diameter_mm: 1}}]\nallowed: [[a, b]]", "2:15: error: 'b' is no body"},
      {"allowed: [[a]]", "1:11: error: expected a pair [name, name]"},
  };
  for (const auto& [text, expected] : faults) {
    const auto told = refusal(text);
    EXPECT_THAT(told, testing::StartsWith("bodies.yaml:")) << text;
    EXPECT_THAT(told, testing::HasSubstr(expected)) << text;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 0) << told;
  }
}

TEST(DerivedBodies, ATableWhereTheLastRotaryAxisIsAndASpindleNose) {
  const auto links = std::get<MachineLinks>(MachineLinks::make(geometry::ac_table()));
  const auto set = derived_bodies(links);
  ASSERT_EQ(set.bodies.size(), 2u);
  // The table's face is at the point of C, Z -516.0118; it is 40 mm high.
  EXPECT_NEAR(set.bodies[0].position.z(), -516.0118 - 20, 1e-9);
  EXPECT_NEAR(set.bodies[1].position.z(), 75, 1e-9) << "150 mm above the spindle face";
  auto one = geometry::ac_table();
  one.table_1 = one.table_2;
  one.table_2.reset();
  EXPECT_EQ(derived_bodies(std::get<MachineLinks>(MachineLinks::make(one))).bodies.size(), 1u)
      << "its point may slide along C: nothing is known of its height";
  const auto head = std::get<MachineLinks>(MachineLinks::make(geometry::cb_head()));
  EXPECT_EQ(derived_bodies(head).bodies.size(), 1u) << "nothing is known of what is under the workpiece";
}

TEST(DerivedBodies, ProbeAndSphereAreThoseOfTheTruth) {
  const auto links = std::get<MachineLinks>(MachineLinks::make(geometry::ac_table()));
  BodySet set;
  touch_probe::TouchProbeTruth probe;
  probe.length = 100, probe.ball_radius = 3;
  add_probe(links, probe, set);
  add_solids(links, {touch_probe::SphereGauge{Vec3(1, 2, 3), 12.5, -Vec3::UnitZ(), 4, 50}}, set);
  ASSERT_EQ(set.bodies.size(), 5u);
  EXPECT_EQ(set.bodies[0].position, Vec3(0, 0, -100)) << "the ball";
  EXPECT_NEAR(set.bodies[1].position.z(), -80, 1e-12) << "stylus from -60 to -100";
  EXPECT_NEAR(set.bodies[2].position.z(), -30, 1e-12) << "body from 0 to -60";
  EXPECT_EQ(set.bodies[3].name, "sphere");
  EXPECT_LT((set.bodies[4].position - Vec3(1, 2, -22)).norm(), 1e-12) << "the shaft goes from Z3 to Z-47";
}

TEST(BodiesFile, IsNotNeeded) {
  const auto bodies = load_bodies(testing::TempDir() + "/no-machine", geometry::ac_table());
  EXPECT_TRUE(bodies.derived);
  EXPECT_EQ(bodies.set.bodies.size(), derived_bodies(bodies.links).bodies.size());
  EXPECT_FALSE(parsed("bodies: []").derived);
}

}  // namespace
}  // namespace trunnion::collision
