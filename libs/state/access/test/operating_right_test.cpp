// SPDX-License-Identifier: Apache-2.0
#include "access/operating_right.hpp"

#include <gtest/gtest.h>

namespace trunnion::access {
namespace {

using Taken = OperatingRight::Taken;
const Station ann{"key of ann", "ann"}, bob{"key of bob", "bob"}, setter{"key of sam", "sam", true};

/// An order that is accepted at once. Empty, or the name of who holds the right.
std::string order(OperatingRight& right, const Station& station, double now) {
  auto holder = right.order(station, now);
  if (holder.empty()) right.answered(right.reservation(), true, now);
  return holder;
}

TEST(OperatingRight, TheFirstOrderTakesItAndTheOthersAreRefusedWithTheName) {
  OperatingRight right;
  EXPECT_FALSE(right.holder(0));
  EXPECT_EQ(order(right, ann, 0), "");
  EXPECT_EQ(order(right, bob, 1), "ann");
  EXPECT_EQ(order(right, ann, 2), "");
  EXPECT_EQ(right.holder(2)->name, "ann");
  EXPECT_TRUE(right.is_held_by(ann.key, 2));
  EXPECT_FALSE(right.is_held_by(bob.key, 2));
}

TEST(OperatingRight, ARefusedOrderDoesNotTakeItAndHasItUntilItsAnswer) {
  OperatingRight right;
  EXPECT_EQ(right.order(ann, 0), "");
  EXPECT_EQ(right.order(ann, 0), "");
  const auto of_ann = right.reservation();
  EXPECT_FALSE(right.holder(0)) << "it is reserved, and nobody holds it";
  EXPECT_EQ(right.order(bob, 0), "ann");
  EXPECT_FALSE(right.answered(of_ann, false, 1));
  EXPECT_EQ(right.order(bob, 1), "ann") << "another order of ann's is being answered";
  EXPECT_FALSE(right.answered(of_ann, false, 1));
  EXPECT_EQ(right.order(bob, 1), "");
  EXPECT_FALSE(right.answered(of_ann, true, 1)) << "ann has reserved nothing any more";
  EXPECT_TRUE(right.answered(right.reservation(), true, 2));
  EXPECT_EQ(right.holder(2)->name, "bob");
  EXPECT_EQ(right.order(bob, 3), "");
  EXPECT_FALSE(right.answered(right.reservation(), false, 3));
  EXPECT_EQ(right.holder(3)->name, "bob") << "who holds it keeps it";
}

TEST(OperatingRight, WhoTakesItWhileAnotherOnesOrderIsBeingAnsweredHasIt) {
  OperatingRight right;
  right.order(ann, 0);
  const auto of_ann = right.reservation();
  EXPECT_EQ(right.take(bob, 1), Taken::yes);
  EXPECT_FALSE(right.answered(of_ann, true, 2));
  EXPECT_EQ(right.holder(2)->name, "bob");
}

// The first order was given while ann held it: its answer ends nothing that she has reserved since.
TEST(OperatingRight, AnAnswerEndsTheReservationOfItsOwnOrderOnly) {
  OperatingRight right;
  order(right, ann, 0);
  EXPECT_EQ(right.order(ann, 1), "");
  const auto first = right.reservation();
  right.release(ann.key);
  EXPECT_EQ(right.order(ann, 2), "");
  const auto second = right.reservation();
  EXPECT_FALSE(right.answered(first, false, 3));
  EXPECT_EQ(right.order(bob, 3), "ann") << "her second order is being answered";
  EXPECT_TRUE(right.answered(second, true, 4));
  EXPECT_EQ(right.holder(4)->name, "ann");
}

TEST(OperatingRight, AStationThatIsGoneLosesItWhenItsLeaseEnds) {
  OperatingRight right;
  order(right, ann, 0);
  right.present(ann.key, 10);
  EXPECT_EQ(order(right, bob, 25), "ann") << "10 s and the lease of 15 s";
  EXPECT_EQ(order(right, bob, 25.1), "");
  right.present(ann.key, 26);
  EXPECT_EQ(right.holder(26)->name, "bob") << "a sign of life does not bring it back";
  EXPECT_FALSE(right.holder(41));
}

TEST(OperatingRight, IsHandedOverWithConsent) {
  OperatingRight right;
  order(right, ann, 0);
  EXPECT_FALSE(right.hand_over(ann.key, 1)) << "nobody asks";
  EXPECT_EQ(right.take(bob, 1), Taken::asked);
  EXPECT_EQ(right.asking(1)->name, "bob");
  EXPECT_EQ(right.holder(1)->name, "ann");
  EXPECT_FALSE(right.hand_over(bob.key, 2)) << "who asks does not agree for the holder";
  EXPECT_TRUE(right.hand_over(ann.key, 2));
  EXPECT_EQ(right.holder(2)->name, "bob");
  EXPECT_FALSE(right.asking(2));
  EXPECT_EQ(order(right, ann, 3), "bob");
}

TEST(OperatingRight, MayBeKeptAndWhoAskedAndIsGoneIsForgotten) {
  OperatingRight right;
  order(right, ann, 0);
  right.take(bob, 0);
  EXPECT_TRUE(right.refuse(ann.key, 1));
  EXPECT_FALSE(right.asking(1));
  right.take(bob, 2);
  right.present(ann.key, 10), right.present(ann.key, 16);
  EXPECT_FALSE(right.hand_over(ann.key, 17.1)) << "bob was seen 15.1 s ago";
  EXPECT_EQ(right.holder(17.1)->name, "ann");
}

TEST(OperatingRight, ASetterTakesItOver) {
  OperatingRight right;
  order(right, ann, 0);
  EXPECT_EQ(order(right, setter, 1), "ann") << "an order alone does not";
  EXPECT_EQ(right.take(setter, 1), Taken::yes);
  EXPECT_EQ(order(right, ann, 2), "sam");
  EXPECT_EQ(right.take(ann, 2), Taken::asked);
}

TEST(OperatingRight, ALogoutGivesItBackAtOnce) {
  OperatingRight right;
  order(right, ann, 0);
  right.take(bob, 0);
  right.release(bob.key);
  EXPECT_FALSE(right.asking(1));
  right.release(ann.key);
  EXPECT_FALSE(right.holder(1));
  EXPECT_EQ(right.take(bob, 1), Taken::yes);
}

TEST(OperatingRight, ANumberIsThatOfTheStation) {
  EXPECT_EQ(shown(ann), shown(ann));
  EXPECT_NE(shown(ann).number, shown(bob).number);
  EXPECT_LT(shown(ann).number, 1u << 28);
}

}  // namespace
}  // namespace trunnion::access
