// SPDX-License-Identifier: Apache-2.0
#include "src/connections.hpp"

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

TEST(Connections, ATransferMakesRoomWhenNoneWaits) {
  const List list{{"10.0.0.2", Activity::answering}, {"10.0.0.2", Activity::transferring}};
  EXPECT_EQ(one_to_close(list), 1u);
}

TEST(Connections, AnOrderThatIsWithTheClusterIsNotCutOff) {
  const List list{{"10.0.0.2", Activity::answering}, {"10.0.0.1", Activity::answering}};
  EXPECT_EQ(one_to_close(list), std::nullopt);
  EXPECT_EQ(one_to_close({}), std::nullopt);
}

}  // namespace
}  // namespace trunnion::gateway
