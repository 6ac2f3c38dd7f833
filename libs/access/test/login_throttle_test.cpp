// SPDX-License-Identifier: Apache-2.0
#include "access/login_throttle.hpp"

#include <gtest/gtest.h>

namespace trunnion::access {
namespace {

TEST(LoginThrottle, LetsFiveMistakesPassAndThenWaitsTwiceAsLongEachTime) {
  LoginThrottle throttle;
  for (int i = 0; i < LoginThrottle::free_tries; ++i) {
    EXPECT_EQ(throttle.wait("ann", 100), 0) << i;
    throttle.failed("ann", 100);
  }
  for (const double expected : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0}) {
    EXPECT_EQ(throttle.wait("ann", 100), expected);
    throttle.failed("ann", 100);
  }
  EXPECT_EQ(throttle.wait("ann", 130), 30);
  EXPECT_EQ(throttle.wait("ann", 160), 0);
  EXPECT_EQ(throttle.wait("bob", 100), 0) << "another name";
}

TEST(LoginThrottle, EndsWithASuccessAndAfterAnHour) {
  LoginThrottle throttle;
  for (int i = 0; i < 20; ++i) throttle.failed("ann", 0), throttle.failed("bob", 0);
  throttle.succeeded("ann");
  EXPECT_EQ(throttle.wait("ann", 1), 0);
  EXPECT_EQ(throttle.wait("bob", 1), 59);
  throttle.failed("bob", 3601);
  EXPECT_EQ(throttle.wait("bob", 3601), 0) << "the count began again";
}

TEST(LoginThrottle, KeepsABoundedNumberOfNames) {
  LoginThrottle throttle;
  for (int i = 0; i < LoginThrottle::free_tries; ++i) throttle.failed("first", 0);
  for (std::size_t i = 0; i < 2 * LoginThrottle::most; ++i) throttle.failed(std::to_string(i), 1);
  EXPECT_EQ(throttle.wait("first", 1), 0) << "the oldest made room";
}

}  // namespace
}  // namespace trunnion::access
