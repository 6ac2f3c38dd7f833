// SPDX-License-Identifier: Apache-2.0
#include "access/sessions.hpp"

#include <gtest/gtest.h>

namespace trunnion::access {
namespace {

TEST(Sessions, EndWhenNothingIsAskedForHalfAnHour) {
  Sessions sessions;
  sessions.begin("secret", {"ann", Role::setter}, 0);
  EXPECT_EQ(sessions.find("secret", 1800)->name, "ann");
  EXPECT_EQ(sessions.find("secret", 3600)->role, Role::setter) << "used at 1800 s";
  EXPECT_FALSE(sessions.find("secret", 5401));
  EXPECT_FALSE(sessions.find("secret", 5402));
  EXPECT_FALSE(sessions.find("another", 0));
  EXPECT_FALSE(sessions.find("", 0));
}

TEST(Sessions, ALookDoesNotProlongThem) {
  Sessions sessions(60);
  sessions.begin("secret", {"ann"}, 0);
  EXPECT_TRUE(sessions.look("secret", 50));
  EXPECT_TRUE(sessions.look("secret", 60));
  EXPECT_FALSE(sessions.look("secret", 61));
  EXPECT_FALSE(sessions.look("another", 0));
}

TEST(Sessions, EndAfterTwelveHours) {
  Sessions sessions;
  sessions.begin("secret", {"ann"}, 0);
  for (double now = 0; now <= Sessions::longest; now += 1000)
    EXPECT_TRUE(sessions.find("secret", now)) << now;
  EXPECT_FALSE(sessions.find("secret", Sessions::longest + 1));
}

TEST(Sessions, EndOneByOneAndAllOfAUser) {
  Sessions sessions;
  sessions.begin("a", {"ann"}, 0), sessions.begin("b", {"ann"}, 0), sessions.begin("c", {"bob"}, 0);
  sessions.end("a");
  EXPECT_FALSE(sessions.find("a", 1));
  EXPECT_TRUE(sessions.find("b", 1));
  sessions.end_of("ann");
  EXPECT_FALSE(sessions.find("b", 1));
  EXPECT_TRUE(sessions.find("c", 1));
}

TEST(Sessions, AreABoundedNumber) {
  Sessions sessions;
  for (std::size_t i = 0; i < 2 * Sessions::most; ++i)
    sessions.begin(std::to_string(i), {"ann"}, static_cast<double>(i));
  EXPECT_EQ(sessions.size(), Sessions::most);
  EXPECT_FALSE(sessions.find("0", 600)) << "the one that was idle longest";
  EXPECT_TRUE(sessions.find(std::to_string(2 * Sessions::most - 1), 600));
}

}  // namespace
}  // namespace trunnion::access
