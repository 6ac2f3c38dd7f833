// SPDX-License-Identifier: Apache-2.0
#include "recorded_runs/held_channels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trunnion::recorded_runs {
namespace {

using idl::channel::RunState;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(HeldChannels, NameEachStopOnce) {
  HeldChannels held(2);
  std::vector<idl::channel::ChannelState> states(2);
  states[0].state = states[1].state = RunState::RUNNING;
  EXPECT_THAT(held.newly(states), IsEmpty());
  states[1].state = RunState::HELD;
  EXPECT_THAT(held.newly(states), ElementsAre(1u));
  EXPECT_THAT(held.newly(states), IsEmpty());
  states[1].state = RunState::RUNNING;
  EXPECT_THAT(held.newly(states), IsEmpty());
  states[0].state = states[1].state = RunState::HELD;
  EXPECT_THAT(held.newly(states), ElementsAre(0u, 1u));
}

}  // namespace
}  // namespace trunnion::recorded_runs
