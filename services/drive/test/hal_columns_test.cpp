// SPDX-License-Identifier: Apache-2.0
#include "columns.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "testing_support/refusal.hpp"

namespace trunnion::drive {
namespace {

std::string refusal(const std::string& setpoints, std::size_t axes, std::size_t spindles) {
  return testing_support::refusal_of([&] { SetpointColumns::from(setpoints, axes, spindles); });
}

TEST(HalColumns, SetpointsCarryAsManyFeedForwardsAsTheFileHasColumnsFor) {
  const auto all = SetpointColumns::from("ubbbffffffffffbf", 3, 1);
  EXPECT_EQ(all.per_axis, 3u);
  EXPECT_EQ(all.first_spindle, 4u + 9u);
  EXPECT_EQ(SetpointColumns::from("ubbbffffff", 3, 0).per_axis, 2u);
  EXPECT_EQ(SetpointColumns::from("ubbbffffbf", 3, 1).per_axis, 1u);
}

TEST(HalColumns, WhatDoesNotFitTheMachineIsRefusedWithWhatIsExpected) {
  EXPECT_EQ(
      refusal("ubbbffff", 3, 0),
      "The .hal file loads streamer 0 with cfg=ubbbffff; this machine needs ubbb, then f, ff or fff for each "
      "of 3 axes, then fbf for each of 0 spindles (docs/hal.md has the columns)");
  EXPECT_NE(refusal("fff", 1, 0), "taken");
}

TEST(HalColumns, SamplesHaveEncodersAndSwitchesAndUpToFourSkipInputs) {
  const auto columns = SampleColumns::from("uffffffff", "bbbbbbbbbb", 3, 1);
  EXPECT_EQ(columns.per_axis, 2u);
  EXPECT_EQ(columns.first_spindle, 7u);
  EXPECT_EQ(columns.first_skip_input, 9u);
  EXPECT_EQ(columns.skip_inputs, 1u);
  EXPECT_EQ(SampleColumns::from("ufff", "bbbbbbbbb", 3, 0).skip_inputs, 0u);
  EXPECT_THROW(SampleColumns::from("ufff", "bbbbbbbb", 3, 0), std::runtime_error);
  EXPECT_THROW(SampleColumns::from("ufff", "bbbbbbbbbbbbbb", 3, 0), std::runtime_error);
  EXPECT_THROW(SampleColumns::from("uff", "bbbbbbbbb", 3, 0), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::drive
