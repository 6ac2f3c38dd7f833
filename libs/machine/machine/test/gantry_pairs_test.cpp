// SPDX-License-Identifier: Apache-2.0
#include "machine/gantry_pairs.hpp"

#include <gtest/gtest.h>

#include "machine/parameter_constants.hpp"

namespace trunnion::machine {
namespace {

// The slave is 0.25 mm ahead of where it belongs.
TEST(AutoOffset, SetsTheZeroOfAnAbsoluteEncoderAndTheReferenceOfAnother) {
  GantryPair pair;
  pair.master = 1, pair.slave = 2;
  Parameters p;
  const auto zero = parameter::gantry_zero_deviation.number(2);
  const auto reference = parameter::reference_coordinate.number(2);
  p.values[zero] = {1.5, ""};
  p.values[reference] = {10, ""};
  p.values[parameter::homing_direction.number(2)] = {0, ""};
  const auto absolute = auto_offset(p, pair, 0.25);
  EXPECT_EQ(absolute.number, zero);
  EXPECT_EQ(absolute.now, 1.5);
  EXPECT_EQ(absolute.proposal, 1.75);
  p.values[parameter::homing_direction.number(2)] = {1, ""};
  const auto incremental = auto_offset(p, pair, 0.25);
  EXPECT_EQ(incremental.number, reference);
  EXPECT_EQ(incremental.now, 10);
  EXPECT_EQ(incremental.proposal, 9.75);
  // Nanometres are not written.
  EXPECT_NEAR(auto_offset(p, pair, 0.2500004).proposal, 9.75, 1e-9);
}

}  // namespace
}  // namespace trunnion::machine
