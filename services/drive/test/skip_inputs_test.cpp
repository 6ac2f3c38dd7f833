// SPDX-License-Identifier: Apache-2.0
#include "skip_inputs.hpp"

#include <gtest/gtest.h>

namespace trunnion::drive {
namespace {

struct SkipInput : ::testing::Test, EncoderRowSink {
  void skip_edge(std::uint64_t number, const idl::stream::SkipEdge& edge) override {
    edges.push_back(edge);
    edges.back().cycle = number;
  }
  void encoder_row(const EncoderRow&) override {}
  SkipInputs inputs;
  std::vector<SimulatedAxis> servos{2};
  std::vector<idl::stream::SkipEdge> edges;

  // Input 1: axis 0 below -2; input 3: axis 1 above 5.
  void SetUp() override {
    machine::Parameters p;
    for (std::uint32_t a = 0; a < 2; ++a) p.values[100000 + a * 1000] = {0, a == 0 ? "X" : "Y"};
    p.values[10930] = {0, ""}, p.values[10934] = {-2, ""}, p.values[10938] = {-1, ""};
    p.values[10932] = {1, ""}, p.values[10936] = {5, ""};
    inputs.configure(p, machine::drive_axes(p));
  }
  void at(double x, double y) {
    servos[0].place(x);
    servos[1].place(y);
    inputs.step(servos, cycle++, *this);
  }
  std::uint64_t cycle = 0;
};

TEST_F(SkipInput, AnEdgeIsLatchedWhereTheSwitchIsNotWhereThePeriodEnds) {
  at(0, 0);
  at(-1, 1);
  EXPECT_TRUE(edges.empty());
  at(-5, 3);  // X passes -2 after a quarter of the way from -1, where Y is 1 + 2 / 4
  ASSERT_EQ(edges.size(), 1u);
  EXPECT_EQ(edges[0].input, 1);
  EXPECT_EQ(edges[0].cycle, 3u);
  EXPECT_NEAR(edges[0].position[0], -2, 1e-12);
  EXPECT_NEAR(edges[0].position[1], 1.5, 1e-12);
}

TEST_F(SkipInput, OnlyTheRisingEdgeCountsAndEachInputByItself) {
  at(-3, 0);  // it is on from the beginning: no edge
  at(-4, 6);
  at(-1, 4);
  at(-3, 4);
  ASSERT_EQ(edges.size(), 2u);
  EXPECT_EQ(edges[0].input, 3);
  EXPECT_EQ(edges[1].input, 1);
  EXPECT_EQ(edges[1].cycle, 4u);
}

TEST_F(SkipInput, AnInputThatIsNotConnectedNeverComes) {
  inputs.configure(machine::Parameters{}, {});
  at(0, 0);
  at(-100, 100);
  EXPECT_TRUE(edges.empty());
}

}  // namespace
}  // namespace trunnion::drive
