// SPDX-License-Identifier: Apache-2.0
#include "core/bodies_document.hpp"

#include <gtest/gtest.h>

#include "geometry/test/machines.hpp"

namespace trunnion::gateway {
namespace {

using bus::Json;

Json document_of(const std::string& bodies) {
  return bodies_document(collision::parse_bodies(
      "structure: \"[w C' A' Y' b X Z (S) t]\"\nbodies:\n" + bodies, "bodies.yaml", geometry::ac_table()));
}

TEST(BodiesDocument, HasTheAxesOfBothSidesFromTheBaseOutwards) {
  const auto document = document_of("  []\n");
  EXPECT_EQ(document["structure"], "[w C' A' Y' b X Z (S) t]");
  const auto letters = [&](const char* side) {
    std::string found;
    for (const auto& axis : document[side]) found += axis["axis"].get<std::string>();
    return found;
  };
  EXPECT_EQ(letters("workpiece_side"), "YAC");
  EXPECT_EQ(letters("tool_side"), "XZ");
  // Y carries the workpiece: it moves against the axis' direction.
  EXPECT_EQ(document["workpiece_side"][0]["direction"], Json({0.0, -1.0, 0.0}));
  EXPECT_EQ(document["workpiece_side"][0]["rotary"], false);
  EXPECT_EQ(document["workpiece_side"][1]["rotary"], true);
}

TEST(BodiesDocument, HasEveryShapeWithItsPlaceAndItsCarrier) {
  const auto bodies = document_of(R"(
  - {name: bed, on: base, box: {size_mm: [1000, 800, 300]}, position_mm: [0, 0, -900]}
  - {name: table, on: C, cylinder: {diameter_mm: 320, height_mm: 40}, rotation_deg: [90, 0, 0]}
  - {name: cradle, on: A, hull: {points_mm: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}}
  - {name: ball, on: tool, sphere: {diameter_mm: 6}, position_mm: [0, 0, -60]}
)")["bodies"];
  ASSERT_EQ(bodies.size(), 4u);
  EXPECT_EQ(bodies[0], Json::parse(R"({"name": "bed", "side": "tool", "depth": 0, "tool": false,
    "position": [0.0, 0.0, -900.0], "rotation": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
    "shape": "box", "size": [1000.0, 800.0, 300.0]})"));
  EXPECT_EQ(bodies[1]["side"], "workpiece");
  EXPECT_EQ(bodies[1]["depth"], 3);
  EXPECT_EQ(bodies[1]["size"], Json({320.0, 40.0}));
  // 90 degrees about X: the second row is -Z.
  EXPECT_NEAR(bodies[1]["rotation"][5].get<double>(), -1, 1e-12);
  EXPECT_EQ(bodies[2]["depth"], 2);
  EXPECT_EQ(bodies[2]["points"].size(), 4u);
  EXPECT_EQ(bodies[3]["tool"], true);
  EXPECT_EQ(bodies[3]["depth"], 2);
  EXPECT_EQ(bodies[3]["size"], Json::array({6.0}));
}

}  // namespace
}  // namespace trunnion::gateway
