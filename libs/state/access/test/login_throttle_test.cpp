// SPDX-License-Identifier: Apache-2.0
#include "access/login_throttle.hpp"

#include <gtest/gtest.h>

namespace trunnion::access {
namespace {

TEST(LoginThrottle, LetsFiveMistakesPassAndThenWaitsTwiceAsLongEachTime) {
  LoginThrottle throttle;
  for (int i = 0; i < LoginThrottle::free_tries; ++i) {
    EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 100), 0) << i;
    throttle.failed("ann", "10.0.0.1", 100);
  }
  for (const double expected : {1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0}) {
    EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 100), expected);
    throttle.failed("ann", "10.0.0.1", 100);
  }
  EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 130), 30);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 160), 0);
  EXPECT_EQ(throttle.wait("bob", "10.0.0.1", 130), 30) << "another name from there";
  EXPECT_EQ(throttle.wait("ann", "10.0.0.2", 100), 0) << "from another address";
}

TEST(LoginThrottle, NobodyLocksOutANameFromWhereItHasLoggedIn) {
  LoginThrottle throttle;
  throttle.succeeded("ann", "10.0.0.1", 0);
  // From a thousand addresses, and other names from her own one.
  for (int i = 0; i < 1000; ++i) throttle.failed("ann", "10.1.0." + std::to_string(i), 1);
  for (int i = 0; i < 20; ++i) throttle.failed("name" + std::to_string(i), "10.0.0.1", 1);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 1), 0);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.2", 1), LoginThrottle::longest_wait) << "a stranger waits";
  EXPECT_GT(throttle.wait("bob", "10.0.0.1", 1), 0);
  // Her own mistakes count from there, too: a known address is no place to guess from.
  for (int i = 0; i < LoginThrottle::free_tries; ++i) throttle.failed("ann", "10.0.0.1", 2);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.1", 2), 1);
}

TEST(LoginThrottle, AFewMistakesElsewhereDoNotConcernANewAddress) {
  LoginThrottle throttle;
  for (int i = 0; i < LoginThrottle::free_tries_of_strangers - 1; ++i)
    throttle.failed("ann", "10.1.0." + std::to_string(i % 20), 1);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.2", 1), 0);
  throttle.failed("ann", "10.1.0.1", 1);
  EXPECT_EQ(throttle.wait("ann", "10.0.0.2", 1), 1);
}

TEST(LoginThrottle, EndsWithASuccessAndAfterAnHour) {
  LoginThrottle throttle;
  for (int i = 0; i < 20; ++i) throttle.failed("ann", "a", 0), throttle.failed("bob", "b", 0);
  throttle.succeeded("ann", "a", 1);
  EXPECT_EQ(throttle.wait("ann", "a", 1), 0);
  EXPECT_EQ(throttle.wait("bob", "b", 1), 59);
  throttle.failed("bob", "b", 3601);
  EXPECT_EQ(throttle.wait("bob", "b", 3601), 0) << "the count began again";
}

TEST(LoginThrottle, KeepsABoundedNumberOfNames) {
  LoginThrottle throttle;
  for (int i = 0; i < LoginThrottle::free_tries; ++i) throttle.failed("first", "a", 0);
  for (std::size_t i = 0; i < LoginThrottle::most / 2; ++i)
    throttle.failed(std::to_string(i), std::to_string(i), 1);
  EXPECT_EQ(throttle.wait("first", "a", 1), 0) << "the oldest made room";
}

}  // namespace
}  // namespace trunnion::access
