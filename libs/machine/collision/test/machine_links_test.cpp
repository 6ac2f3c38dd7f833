// SPDX-License-Identifier: Apache-2.0
#include "collision/machine_links.hpp"

#include <gtest/gtest.h>

#include "compensation/structure.hpp"
#include "geometry/random_source.hpp"
#include "geometry/test/machines.hpp"

namespace trunnion::collision {
namespace {

MachineLinks links_of(const geometry::ChainParameters& design, const std::string& structure = "") {
  std::vector<volumetric::StructureAxis> axes;
  if (!structure.empty())
    axes = std::get<std::vector<volumetric::StructureAxis>>(volumetric::parse_structure(structure));
  return std::get<MachineLinks>(MachineLinks::make(design, axes));
}

// The tip as the workpiece sees it by the placements of the links, against geometry::Chain.
void expect_the_chain(const geometry::ChainParameters& design, const std::string& structure) {
  const auto links = links_of(design, structure);
  const auto chain = geometry::make(design);
  geometry::RandomSource random(7);
  std::vector<Placement> tool, workpiece;
  for (int i = 0; i < 200; ++i) {
    AxisPosition position{};
    for (std::size_t k = 0; k < 3; ++k) position[k] = 1000 * random.uniform() - 500;
    geometry::Angles angles{};
    for (std::size_t k = 0; k < 6; ++k) position[3 + k] = angles[k] = 360 * random.uniform() - 180;
    const double length = 200 * random.uniform();
    links.place(position, false, tool);
    links.place(position, true, workpiece);
    const Vec3 tip = tool.back() * Vec3(links.face() - length * links.tool_direction());
    const Vec3 seen = workpiece.back().rotation.transpose() * (tip - workpiece.back().translation);
    const Vec3 expected = chain.tip_from_machine({position[0], position[1], position[2]}, angles, length);
    // Lengths of 1000 mm, a dozen operations: 1e-12 relative.
    ASSERT_LT((seen - expected).norm(), 1e-9) << links.notation();
  }
}

TEST(MachineLinks, PutTheTipWhereTheChainPutsIt) {
  expect_the_chain(geometry::ac_table(), "");
  expect_the_chain(geometry::bc_table(), "");
  expect_the_chain(geometry::cb_head(), "");
  expect_the_chain(geometry::ca_head(), "");
  expect_the_chain(geometry::b_head_c_table(), "");
  expect_the_chain(geometry::nutating_b_head_c_table(), "");
  expect_the_chain(geometry::a_table(), "");
}

TEST(MachineLinks, PutTheTipThereWhenLinearAxesCarryTheWorkpiece) {
  expect_the_chain(geometry::ac_table(), "[w C' A' Y' b X Z (S) t]");
  expect_the_chain(geometry::ac_table(), "[w C' A' X' Y' b Z t]");
  expect_the_chain(geometry::b_head_c_table(), "[w C' X' b Y Z B t]");
}

TEST(MachineLinks, PutTheTipThereWithAnOriginAndCorrections) {
  auto design = geometry::cb_head();
  design.origin = Vec3(3, -2, 5);
  design.head_2->correction = Vec3(0.1, 0.2, -0.3);
  expect_the_chain(design, "");
  design.open = true;
  design.base_correction = Vec3(0.5, 0, 1);
  expect_the_chain(design, "");
}

TEST(MachineLinks, NameTheLinks) {
  const auto links = links_of(geometry::ac_table(), "[w C' A' Y' b X Z (S) t]");
  EXPECT_EQ(*links.carried_by(0), (Link{false, 1}));
  EXPECT_EQ(*links.carried_by(1), (Link{true, 1}));
  EXPECT_EQ(*links.carried_by(3), (Link{true, 2}));
  EXPECT_EQ(links.workpiece(), (Link{true, 3}));
  EXPECT_EQ(links.spindle(), (Link{false, 2}));
  EXPECT_FALSE(links.carried_by(4));
  EXPECT_EQ(name_of(links, {true, 2}), "A");
  EXPECT_EQ(name_of(links, {true, 3}), "workpiece");
  EXPECT_EQ(name_of(links, {false, 2}), "spindle");
  EXPECT_EQ(name_of(links, {}), "base");
}

TEST(MachineLinks, RefuseAStructureOfAnotherMachine) {
  const auto structure =
      std::get<std::vector<volumetric::StructureAxis>>(volumetric::parse_structure("[w C' b X Y Z t]"));
  EXPECT_EQ(std::get<std::string>(MachineLinks::make(geometry::ac_table(), structure)),
            "axis A must be there once, it is there 0 times");
}

}  // namespace
}  // namespace trunnion::collision
