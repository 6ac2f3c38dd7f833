// SPDX-License-Identifier: Apache-2.0
#include "collision/way_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/test/machines.hpp"
#include "projected_distance.hpp"

namespace trunnion::collision {
namespace {

Travel travel() {
  Travel out{};
  out[0] = {true, -400, 400};
  out[1] = {true, -300, 300};
  out[2] = {true, -450, 0};
  out[3] = {true, -100, 100};
  out[5] = {true, -1e6, 1e6};
  return out;
}

geometry::ChainParameters design() {
  auto p = geometry::ac_table();
  p.table_1->offset = Vec3::Zero();
  p.table_2->offset = Vec3(0, 0, -400);
  return p;
}

// A probe of 60 mm, a table with the sphere of examples/calibration and with walls, and a cradle.
CollisionModel machine(double lid = 0) {
  auto links = std::get<MachineLinks>(MachineLinks::make(design()));
  BodySet set;
  set.clearance = 1;
  const Link workpiece = links.workpiece(), cradle = *links.carried_by(3);
  set.bodies = {{"table", workpiece, Cylinder{160, 20}, Vec3(0, 0, -420)},
                {"fixture", workpiece, Box{Vec3(30, 30, 40)}, Vec3(-60, 0, -360)},
                {"cradle +X", cradle, Box{Vec3(15, 120, 90)}, Vec3(190, 0, -400)},
                {"cradle -X", cradle, Box{Vec3(15, 120, 90)}, Vec3(-190, 0, -400)},
                {"spindle nose", links.spindle(), Cylinder{50, 100}, Vec3(0, 0, 100)}};
  // Around the sphere a box without a cover: the way out is up.
  for (const auto& [name, x, y, half] : {std::tuple{"wall 1", 95.0, 40.0, Vec3(2, 40, 25)},
                                         {"wall 2", 25.0, 40.0, Vec3(2, 40, 25)},
                                         {"wall 3", 60.0, 78.0, Vec3(40, 2, 25)},
                                         {"wall 4", 60.0, 2.0, Vec3(40, 2, 25)}})
    set.bodies.push_back({name, workpiece, Box{half}, Vec3(x, y, -375)});
  if (lid > 0) set.bodies.push_back({"lid", workpiece, Box{Vec3(40, 40, 2)}, Vec3(60, 40, -360 + lid)});
  touch_probe::TouchProbeTruth probe;
  probe.length = 60;
  add_probe(links, probe, set);
  add_solids(links, {touch_probe::SphereGauge{Vec3(60, 40, -360), 12.5, -Vec3::UnitZ(), 4, 40}}, set);
  return {std::move(links), std::move(set)};
}

// Over the pole of the sphere, 17.5 mm from its centre.
AxisPosition over_sphere(double a, double c) {
  const auto chain = geometry::make(design());
  geometry::Angles angles{};
  angles[0] = a, angles[2] = c;
  const Vec3 centre = chain.machine_from_tip({60, 40, -360}, angles, 60);
  return {centre.x(), centre.y(), centre.z() + 17.5, a, 0, c};
}

// The distance of two bodies without the code that searches for ways but for the placements of the links,
// which machine_links_test compares with geometry::Chain.
double independent_distance(const CollisionModel& model, const PairDistance& pair, const AxisPosition& at) {
  std::array<Placement, 2> places;
  for (int i = 0; i < 2; ++i) {
    const Body& body = model.bodies()[i == 0 ? pair.first : pair.second];
    std::vector<Placement> links;
    model.links().place(at, body.link.workpiece, links);
    const Placement& link = links[body.link.depth];
    places[static_cast<std::size_t>(i)] = {link.rotation * body.rotation, link * body.position};
  }
  return projected_distance(model.bodies()[pair.first].shape, places[0], model.bodies()[pair.second].shape,
                            places[1], 100);
}

double least_distance(const CollisionModel& model, const std::vector<AxisPosition>& way) {
  double least = 1e9;
  for (std::size_t i = 1; i < way.size(); ++i)
    for (int k = 0; k <= 200; ++k) {
      AxisPosition at{};
      for (std::size_t n = 0; n < at.size(); ++n)
        at[n] = way[i - 1][n] + k / 200.0 * (way[i][n] - way[i - 1][n]);
      if (const auto near = model.nearest(at, least)) {
        least = near->distance;
        EXPECT_NEAR(independent_distance(model, *near, at), least, 0.05);
      }
    }
  return least;
}

TEST(WaySearch, SixteenPosesWithoutCollisionByADenseCheck) {
  const auto model = machine();
  const auto limits = travel();
  std::vector<AxisPosition> poses{{0, 0, 0, 0, 0, 0}};
  for (int i = 0; i < 8; ++i) poses.push_back(over_sphere(-25.0 + 6 * i, 0));
  for (int i = 0; i < 8; ++i) poses.push_back(over_sphere(0, 45.0 * i));
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const auto found = find_way(model, limits, poses[i - 1], poses[i]);
    ASSERT_TRUE(std::holds_alternative<std::vector<AxisPosition>>(found))
        << i << ": " << std::get<std::string>(found);
    const auto& way = std::get<std::vector<AxisPosition>>(found);
    EXPECT_EQ(way.front(), poses[i - 1]);
    EXPECT_EQ(way.back(), poses[i]);
    for (const auto& position : way)
      for (std::size_t k = 0; k < 5; ++k)
        if (limits[k].present) {
          EXPECT_TRUE(position[k] >= limits[k].low - 1e-9 && position[k] <= limits[k].high + 1e-9);
        }
    EXPECT_GE(least_distance(model, way), 1 - 0.002) << "way " << i;
    EXPECT_EQ(std::get<std::vector<AxisPosition>>(find_way(model, limits, poses[i - 1], poses[i])), way)
        << "the same inputs give the same way";
  }
}

TEST(WaySearch, FindsAWayThatNeitherTheDirectMoveNorARetractIs) {
  // A lid 90 mm over the sphere: the probe has to come from the side, between lid and walls.
  const auto model = machine(140);
  const auto from = over_sphere(0, 0);
  const AxisPosition to{-250, -200, -100, 0, 0, 0};
  const auto found = find_way(model, travel(), to, over_sphere(0, 0));
  // The spindle nose of 100 mm does not fit below the lid at 140 mm: the start is beyond reach.
  ASSERT_TRUE(std::holds_alternative<std::string>(found));
  EXPECT_THAT(std::get<std::string>(found), testing::StartsWith("end: '"));
  EXPECT_EQ(from[3], 0);
}

TEST(WaySearch, AroundTheFixtureBySamples) {
  auto links = std::get<MachineLinks>(MachineLinks::make(design()));
  BodySet set;
  set.clearance = 1;
  // A wall to the end of the travel of Z above and below, open at Y beyond 150 only; walls of the base close
  // the ends of X and Y.
  set.bodies = {{"wall", links.workpiece(), Box{Vec3(10, 250, 600)}, Vec3(0, -100, -200)},
                {"ball", links.spindle(), Sphere{20}, Vec3::Zero()}};
  const CollisionModel model(links, std::move(set));
  auto limits = travel();
  limits[3] = {true, -1, 1}, limits[5] = {true, -1, 1};
  const AxisPosition from{-200, -200, -200, 0, 0, 0}, to{200, -200, -200, 0, 0, 0};
  const auto found = find_way(model, limits, from, to);
  ASSERT_TRUE(std::holds_alternative<std::vector<AxisPosition>>(found)) << std::get<std::string>(found);
  EXPECT_GE(least_distance(model, std::get<std::vector<AxisPosition>>(found)), 1 - 0.002);
}

TEST(WaySearch, SaysWhichBodiesMeetWhenThereIsNoWay) {
  auto links = std::get<MachineLinks>(MachineLinks::make(design()));
  BodySet set;
  set.bodies = {{"wall", links.workpiece(), Box{Vec3(10, 2000, 2000)}, Vec3::Zero()},
                {"ball", links.spindle(), Sphere{20}, Vec3::Zero()}};
  const CollisionModel model(links, std::move(set));
  auto limits = travel();
  limits[3] = {true, -1, 1}, limits[5] = {true, -1, 1};
  SearchOptions options;
  options.most_samples = 300;
  const auto found = find_way(model, limits, {-200, 0, -200, 0, 0, 0}, {200, 0, -200, 0, 0, 0}, options);
  ASSERT_TRUE(std::holds_alternative<std::string>(found));
  EXPECT_THAT(
      std::get<std::string>(found),
      testing::MatchesRegex("no way was found in 300 samples; on the direct one 'wall' and 'ball' are "
                            "1\\.0.. mm apart at X-31\\.0.. Y0.000 Z-200.000 A0.000 C0.000"));
  const auto outside = find_way(model, limits, {-200, 0, -200, 0, 0, 0}, {200, 0, 20, 0, 0, 0});
  EXPECT_EQ(std::get<std::string>(outside), "end: Z 20.0000 is not within its travel -450 .. 0");
}

}  // namespace
}  // namespace trunnion::collision
