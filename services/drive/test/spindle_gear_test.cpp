// SPDX-License-Identifier: Apache-2.0
#include "spindle_gear.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace trunnion::drive {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

TEST(SpindleGear, HasTheHighestSpeedOfTheGearInForce) {
  machine::Parameters p;
  p.values[105985] = {500, ""}, p.values[105986] = {3000, ""};  // M41 and M42
  SpindleGear gear;
  gear.configure(gear_speeds(p, 5));
  EXPECT_EQ(gear.in_force(), 0);
  EXPECT_EQ(gear.highest(), no_limit) << "without a gear";
  gear.engage(1);
  EXPECT_EQ(gear.in_force(), 1);
  EXPECT_EQ(gear.highest(), 500);
  gear.engage(2);
  EXPECT_EQ(gear.highest(), 3000);
}

TEST(SpindleGear, OneThatDoesNotExistIsASpindleWithoutGears) {
  machine::Parameters p;
  p.values[105985] = {500, ""};
  SpindleGear gear;
  gear.configure(gear_speeds(p, 5));
  for (const std::uint8_t missing : {std::uint8_t{2}, std::uint8_t{5}, std::uint8_t{6}, std::uint8_t{255}}) {
    gear.engage(missing);
    EXPECT_EQ(gear.in_force(), 0);
    EXPECT_EQ(gear.highest(), no_limit);
  }
}

}  // namespace
}  // namespace trunnion::drive
