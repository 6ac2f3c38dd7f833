// SPDX-License-Identifier: Apache-2.0
#include "identification/k_test.hpp"

#include <gtest/gtest.h>

#include "ac_machine.hpp"

namespace trunnion::identification {
namespace {

geometry::Chain chain_of(const char* machine) {
  return machine::make_chain(DrawnMachine::parameters_of(machine), 0);
}

TEST(KTests, AreOfTheAxisThatSwivelsAndOfTheOneAlongTheTool) {
  EXPECT_EQ(axis_of_test(chain_of("ac-table"), KTest::k1), 'A');
  EXPECT_EQ(axis_of_test(chain_of("ac-table"), KTest::k2), 'C');
  EXPECT_EQ(axis_of_test(chain_of("cb-head"), KTest::k1), 'B');
}

TEST(KTests, HaveTheAnnexOfTheirMachine) {
  const auto annex = [](const char* machine) {
    return annex_of(machine::outline_of(DrawnMachine::parameters_of(machine), 0));
  };
  EXPECT_EQ(annex("ac-table"), 'B');
  EXPECT_EQ(annex("cb-head"), 'A');
  EXPECT_EQ(annex("b-head-c-table"), 'C');
}

// A ball at 50 mm about the Z axis: at X50 the deviation along X is radial, at Y50 tangential.
TEST(KTests, HaveTheDeviationsInTheDirectionsOfTheCircle) {
  TurnedBall set{machine::outline_of(DrawnMachine::parameters_of("ac-table"), 0), chain_of("ac-table")};
  set.radius = 50;
  BallTurn turn;
  turn.speed = -1;
  turn.samples.resize(2);
  turn.samples[0].place = truth::Vec3(50, 0, 0);
  turn.samples[1].place = truth::Vec3(0, 50, 0);
  turn.samples[1].turned = -90;
  turn.samples[0].deviation = turn.samples[1].deviation = truth::Vec3(0.003, 0, 0.001);
  const auto figures = figures_of(set, turn);
  EXPECT_FALSE(figures.positive);
  EXPECT_EQ(figures.angles, (std::vector<double>{0, -90}));
  EXPECT_LT(figures.span.norm(), 1e-12);
  EXPECT_NEAR(figures.range.radial, 0.003, 1e-12);
  EXPECT_NEAR(figures.range.tangential, 0.003, 1e-12);
  EXPECT_NEAR(figures.range.axial, 0, 1e-12);
}

}  // namespace
}  // namespace trunnion::identification
