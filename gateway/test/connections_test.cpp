// SPDX-License-Identifier: Apache-2.0
#include "core/connections.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace trunnion::gateway {
namespace {

using List = std::vector<Connection>;

TEST(Connections, TheOldestOfThePeerWithMostOfThemMakesRoom) {
  const List list{{"10.0.0.1"}, {"10.0.0.2"}, {"10.0.0.2"}, {"10.0.0.2"}};
  EXPECT_EQ(one_to_close(list), 1u);
}

TEST(Connections, OneThatWaitsMakesRoomBeforeOneThatTransfers) {
  const List list{{"10.0.0.2", Activity::transferring},
                  {"10.0.0.2", Activity::transferring},
                  {"10.0.0.1", Activity::waiting}};
  EXPECT_EQ(one_to_close(list), 2u);
}

TEST(Connections, AStreamMakesRoomBeforeATransferAndTheOldestOfThePeerWithMost) {
  const List list{{"10.0.0.1", Activity::streaming},
                  {"10.0.0.2", Activity::transferring},
                  {"10.0.0.2", Activity::streaming},
                  {"10.0.0.2", Activity::streaming}};
  EXPECT_EQ(one_to_close(list), 2u);
  EXPECT_EQ(one_to_close(std::span(list).first(2)), 0u);
  EXPECT_EQ(one_to_close(list, 0), 1u) << "too many are at work";
}

TEST(Connections, ATransferMakesRoomWhenNoneWaits) {
  const List list{{"10.0.0.2", Activity::answering}, {"10.0.0.2", Activity::transferring}};
  EXPECT_EQ(one_to_close(list), 1u);
}

TEST(Connections, WhenMoreAreAtWorkThanMayBeOneOfThemMakesRoomAndNotOneThatWaits) {
  const List list{{"10.0.0.3", Activity::waiting},
                  {"10.0.0.1", Activity::answering},
                  {"10.0.0.2", Activity::answering},
                  {"10.0.0.2", Activity::answering},
                  {"10.0.0.1", Activity::transferring}};
  EXPECT_EQ(one_to_close(list, 4), 0u);
  EXPECT_EQ(one_to_close(list, 3), 4u) << "a transfer before an order that is with the cluster";
  EXPECT_EQ(one_to_close(std::span(list).first(4), 2), 2u) << "of the peer with most";
}

TEST(Connections, OneWhoseRequestArrivesIsReadBeforeAnyMakesRoom) {
  const List list{{"10.0.0.2", Activity::waiting, true},
                  {"10.0.0.1", Activity::waiting},
                  {"10.0.0.2", Activity::answering}};
  EXPECT_EQ(one_to_close(list), 1u);
  EXPECT_EQ(one_to_close(std::vector{list[0], list[2]}), std::nullopt);
  EXPECT_EQ(one_to_close(std::vector{list[0], list[2]}, 0), 1u) << "too many are at work";
}

TEST(Connections, OnlyOrdersThatAreWithTheClusterMakeRoomToo) {
  const List list{{"10.0.0.2", Activity::answering}, {"10.0.0.1", Activity::answering}};
  EXPECT_EQ(one_to_close(list), 0u);
  EXPECT_EQ(one_to_close({}), std::nullopt);
}

}  // namespace
}  // namespace trunnion::gateway
