// SPDX-License-Identifier: Apache-2.0
#include "swap_sequence.hpp"

#include <gtest/gtest.h>

namespace trunnion::launcher {
namespace {

using idl::service::Lifecycle;
using idl::service::StandbyState;

// A swap as the launcher goes through it, a step every 10 ms. The sequence's times and the steps' rounding
// are apart by less than one step.
struct Trial {
  explicit Trial(Comparison comparison, std::uint32_t cycles = 500) : sequence(comparison, cycles, 0) {}

  SwapStep step(double seconds = 0.01) {
    view.now += seconds;
    if (moves) view.moved = view.now;
    const auto step = sequence.step(view);
    if (step.action == SwapAction::start_new)
      view.new_runs = true, view.standby = StandbyState::JOINING, ++starts;
    if (step.action == SwapAction::kill_new) view.new_runs = false;
    if (step.action == SwapAction::kill_old) ++kills;
    if (step.action == SwapAction::start_old) view.old_runs = true;
    return step;
  }
  // The first step that is not `wait` within `seconds`, or `wait`.
  SwapStep until_action(double seconds) {
    for (const double end = view.now + seconds; view.now < end;)
      if (const auto next = step(); next.action != SwapAction::wait) return next;
    return {};
  }
  void join() {
    view.announced = true;
    view.standby = StandbyState::MATCHING;
    view.in_step = true;
  }
  // A stage that is in step and has computed `cycles` equal cycles.
  void compare(std::uint64_t cycles) {
    join();
    EXPECT_EQ(step().action, SwapAction::wait);
    view.compared = cycles;
  }
  void promote() {
    view.standby = StandbyState::TAKES_PART;
    view.lifecycle = Lifecycle::ACTIVE;
  }

  SwapSequence sequence;
  SwapView view;
  bool moves = true;
  int starts = 0, kills = 0;
};

void expect_failure(const SwapStep& step, SwapFailure failure) {
  EXPECT_EQ(step.action, SwapAction::fail);
  EXPECT_EQ(step.failure, failure);
}

TEST(SwapSequence, AStageIsPromotedAfterEnoughEqualCyclesOverlapsAndThenEndsTheOldOne) {
  Trial t(Comparison::batches);
  t.compare(499);
  EXPECT_EQ(t.step().action, SwapAction::wait) << "one cycle is missing";
  t.view.compared = 500;
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  EXPECT_FALSE(t.sequence.ends_old());
  t.promote();
  const double promoted = t.view.now;
  EXPECT_EQ(t.until_action(1).action, SwapAction::end_old);
  EXPECT_NEAR(t.view.now - promoted, SwapSequence::overlap, 0.02);
  EXPECT_EQ(t.step().action, SwapAction::wait) << "it still runs";
  t.view.old_runs = false;
  EXPECT_EQ(t.step().action, SwapAction::succeed);
  EXPECT_EQ(t.sequence.compared(), 500u);
  EXPECT_EQ(t.sequence.gap(), 0) << "one of the two served at any time";
}

TEST(SwapSequence, TheOverlapCountsFromWhenTheNewStageIsInStep) {
  Trial t(Comparison::batches);
  t.compare(500);
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  t.promote();
  t.view.in_step = false;
  EXPECT_EQ(t.until_action(1).action, SwapAction::wait);
  t.view.in_step = true;
  const double in_step = t.view.now;
  EXPECT_EQ(t.until_action(1).action, SwapAction::end_old);
  EXPECT_NEAR(t.view.now - in_step, SwapSequence::overlap, 0.03);
}

TEST(SwapSequence, FewerCyclesSufficeWhenNothingMoves) {
  Trial t(Comparison::batches);
  t.compare(120);
  t.moves = false;
  EXPECT_EQ(t.until_action(2).action, SwapAction::promote_new);
  EXPECT_GT(t.view.now - t.view.moved, SwapSequence::rest_time);
  EXPECT_EQ(t.sequence.compared(), 120u);
}

TEST(SwapSequence, AServiceThatOwnsFilesIsPromotedWhenTheOldOneHasEndedAndTheGapIsMeasured) {
  Trial t(Comparison::once);
  t.join();
  EXPECT_EQ(t.step().action, SwapAction::end_old);
  const double ended = t.view.now;
  EXPECT_EQ(t.until_action(0.5).action, SwapAction::wait) << "files and port have one owner at a time";
  t.view.old_runs = false;
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  EXPECT_EQ(t.step().action, SwapAction::wait);
  t.promote();
  EXPECT_EQ(t.step().action, SwapAction::succeed);
  EXPECT_DOUBLE_EQ(t.sequence.gap(), t.view.now - ended);
}

TEST(SwapSequence, ThePlcEndsTheOldOneAfterEnoughEqualTicksWithoutAnOverlap) {
  Trial t(Comparison::ticks, 100);
  t.compare(100);
  EXPECT_EQ(t.step().action, SwapAction::end_old);
  t.view.old_runs = false;
  t.view.compared = 0;  // its heartbeat counts no more once it takes part
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  t.promote();
  EXPECT_EQ(t.step().action, SwapAction::succeed);
  EXPECT_EQ(t.sequence.compared(), 100u);
}

TEST(SwapSequence, ADifferenceBeforeThePromotionKeepsTheOldOne) {
  for (const auto comparison : {Comparison::batches, Comparison::ticks, Comparison::once}) {
    Trial t(comparison);
    t.view.announced = true;
    t.view.standby = StandbyState::DIFFERING;
    t.view.differs = true;
    expect_failure(t.step(), SwapFailure::differs);
  }
  Trial t(Comparison::batches);
  t.compare(499);
  t.view.differs = true;
  expect_failure(t.step(), SwapFailure::differs);
  EXPECT_EQ(t.sequence.compared(), 499u);
}

TEST(SwapSequence, AnotherContractIsRefusedBeforeAnythingIsCompared) {
  Trial t(Comparison::batches);
  t.view.announced = true;
  t.view.contract_matches = false;
  expect_failure(t.step(), SwapFailure::other_contract);
}

TEST(SwapSequence, OneThatDoesNotJoinOrHasNothingToCompareIsGivenUp) {
  Trial never(Comparison::batches);
  expect_failure(never.until_action(10), SwapFailure::did_not_join);
  EXPECT_NEAR(never.view.now, SwapSequence::join_timeout, 0.02);
  Trial silent(Comparison::batches);
  silent.compare(10);
  expect_failure(silent.until_action(10), SwapFailure::nothing_to_compare);
}

TEST(SwapSequence, AServiceAtWorkIsNotEnded) {
  Trial t(Comparison::once);
  t.join();
  t.view.may_end = false;
  expect_failure(t.step(), SwapFailure::may_not_end);
  EXPECT_FALSE(t.sequence.ends_old());
}

TEST(SwapSequence, OneThatEndsEarlyIsStartedASecondTimeAndNotAThird) {
  Trial t(Comparison::batches);
  t.view.new_runs = false;
  EXPECT_EQ(t.step().action, SwapAction::start_new);
  t.compare(200);
  t.view.new_runs = false;
  expect_failure(t.step(), SwapFailure::ended);
  EXPECT_EQ(t.starts, 1);
}

TEST(SwapSequence, WhatCannotBeExecutedIsNotTriedTwice) {
  Trial t(Comparison::batches);
  t.view.new_runs = t.view.executable = false;
  expect_failure(t.step(), SwapFailure::no_executable);
}

TEST(SwapSequence, APromotedStageThatTakesNoPartIsStartedAgainAndThenGivenUp) {
  Trial t(Comparison::batches);
  t.compare(500);
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  EXPECT_EQ(t.until_action(4).action, SwapAction::start_new);
  EXPECT_EQ(t.sequence.compared(), 0u);
  t.view.compared = 0;
  t.compare(500);
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  expect_failure(t.until_action(4), SwapFailure::takes_no_part);
  EXPECT_FALSE(t.sequence.ends_old()) << "the old one serves";
}

TEST(SwapSequence, AnOldOneThatDoesNotEndIsKilledOnce) {
  Trial t(Comparison::once);
  t.join();
  EXPECT_EQ(t.step().action, SwapAction::end_old);
  EXPECT_EQ(t.until_action(3).action, SwapAction::kill_old);
  EXPECT_EQ(t.until_action(1).action, SwapAction::wait);
  EXPECT_EQ(t.kills, 1);
}

TEST(SwapSequence, ANewOneThatDoesNotTakeOverIsEndedAndTheOldOneStartedAgain) {
  Trial t(Comparison::once);
  t.join();
  EXPECT_EQ(t.step().action, SwapAction::end_old);
  t.view.old_runs = false;
  EXPECT_EQ(t.step().action, SwapAction::promote_new);
  EXPECT_EQ(t.until_action(6).action, SwapAction::kill_new);
  EXPECT_EQ(t.step().action, SwapAction::start_old);
  expect_failure(t.step(), SwapFailure::ended);
}

TEST(SwapSequence, TheOldOneIsStartedAgainOnlyWhenItHasEnded) {
  Trial t(Comparison::once);
  t.join();
  EXPECT_EQ(t.step().action, SwapAction::end_old);
  t.view.new_runs = false;
  EXPECT_EQ(t.until_action(1).action, SwapAction::wait) << "its files and its port are not free";
  EXPECT_EQ(t.until_action(2).action, SwapAction::kill_old);
  t.view.old_runs = false;
  EXPECT_EQ(t.step().action, SwapAction::start_old);
  expect_failure(t.step(), SwapFailure::ended);
  EXPECT_EQ(t.starts, 0);
}

}  // namespace
}  // namespace trunnion::launcher
