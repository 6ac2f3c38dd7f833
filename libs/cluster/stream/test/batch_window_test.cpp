// SPDX-License-Identifier: Apache-2.0
#include "stream/batch_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "contracts/types.hpp"
#include "stream/feedback_window.hpp"

namespace trunnion::stream::batch_window_test {
namespace {

using idl::stream::AxisBatch;

AxisBatch batch(std::uint64_t first, std::uint32_t count, std::uint32_t epoch = 1, bool starts = false) {
  AxisBatch f;
  f.epoch = epoch, f.first = first, f.count = count, f.starts = starts;
  f.setpoints.assign(count, static_cast<double>(first));
  return f;
}

Arrival put(BatchWindow<AxisBatch>& window, AxisBatch f) { return window.put(f); }

std::vector<std::uint64_t> drain(BatchWindow<AxisBatch>& window) {
  std::vector<std::uint64_t> taken;
  window.jump_to_start();
  while (const auto* f = window.peek()) {
    taken.push_back(f->first);
    window.advance();
    window.jump_to_start();
  }
  return taken;
}

TEST(BatchWindow, NothingIsTakenBeforeAStart) {
  BatchWindow<AxisBatch> window;
  put(window, batch(8, 8));
  EXPECT_TRUE(drain(window).empty());
}

TEST(BatchWindow, TwoCopiesInAnyOrderGiveEachBatchOnce) {
  // Property over 200 seeded shufflings of two replicas of 30 batches in which each replica keeps its own
  // order.
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    BatchWindow<AxisBatch> window;
    std::vector<std::uint64_t> taken;
    int at[2] = {0, 0};
    while (at[0] < 30 || at[1] < 30) {
      const int replica = at[0] == 30 ? 1 : at[1] == 30 ? 0 : static_cast<int>(random() % 2);
      put(window, batch(100 + 8 * static_cast<std::uint64_t>(at[replica]), 8, 1, at[replica] == 0));
      ++at[replica];
      for (const auto first : drain(window)) taken.push_back(first);
    }
    ASSERT_EQ(taken.size(), 30u);
    for (std::size_t i = 0; i < 30; ++i) EXPECT_EQ(taken[i], 100 + 8 * i);
  }
}

TEST(BatchWindow, ACopyThatComputesOtherwiseIsSeenEvenAfterTheBatchWasTaken) {
  BatchWindow<AxisBatch> window;
  put(window, batch(0, 8, 1, true));
  EXPECT_EQ(drain(window).size(), 1u);
  EXPECT_EQ(put(window, batch(0, 8, 1, true)), Arrival::duplicate);
  auto other = batch(0, 8, 1, true);
  other.setpoints[3] = std::nextafter(other.setpoints[3], 1.0);
  EXPECT_EQ(put(window, other), Arrival::differs);
}

TEST(BatchWindow, TheHistoryOfAWriterThatMatchesLateReplacesNothingThatIsStillToBeTaken) {
  // A process that has just started hears first the replica that started shortly before it, then the other
  // one, whose history reaches back to the start of the motion, 2048 cycles (two rounds of the slots)
  // earlier.
  BatchWindow<AxisBatch> window;
  for (std::uint64_t first = 2040; first < 2064; first += 4) put(window, batch(first, 4));
  window.set_next(1, 2040);
  for (std::uint64_t first = 0; first < 2040; first += 4) put(window, batch(first, 4, 1, first == 0));
  EXPECT_EQ(drain(window), (std::vector<std::uint64_t>{2040, 2044, 2048, 2052, 2056, 2060}));

  // The same before the process knows where it continues.
  BatchWindow<AxisBatch> joining;
  for (std::uint64_t first = 2040; first < 2064; first += 4) put(joining, batch(first, 4));
  for (std::uint64_t first = 0; first < 2040; first += 4) put(joining, batch(first, 4, 1, first == 0));
  joining.set_next(1, 2040);
  EXPECT_EQ(drain(joining), (std::vector<std::uint64_t>{2040, 2044, 2048, 2052, 2056, 2060}));
}

TEST(BatchWindow, ANewEpochDropsWhatIsLeftOfTheOld) {
  BatchWindow<AxisBatch> window;
  put(window, batch(0, 8, 1, true));
  put(window, batch(8, 8, 1));
  put(window, batch(5, 8, 2, true));
  EXPECT_EQ(drain(window), std::vector<std::uint64_t>{5});
  EXPECT_EQ(put(window, batch(16, 8, 1)), Arrival::stale);
}

TEST(BatchWindow, ABatchOfALaterEpochIsAGapWhenItsStartIsMissing) {
  BatchWindow<AxisBatch> window;
  window.set_next(1, 100);
  EXPECT_FALSE(window.gap());
  put(window, batch(40, 8, 2));
  EXPECT_TRUE(window.gap()) << "the batch that starts epoch 2 was lost";
  put(window, batch(32, 8, 2, true));
  EXPECT_EQ(drain(window), (std::vector<std::uint64_t>{32, 40}));
  EXPECT_FALSE(window.gap());
}

TEST(BatchWindow, AMissingBatchIsAGapOnceALaterOneIsHere) {
  BatchWindow<AxisBatch> window;
  put(window, batch(0, 8, 1, true));
  drain(window);
  EXPECT_FALSE(window.gap());
  put(window, batch(16, 8, 1));
  EXPECT_TRUE(window.gap());
  put(window, batch(8, 8, 1));
  EXPECT_EQ(drain(window), (std::vector<std::uint64_t>{8, 16}));
}

// No channel writes epoch 9 after epoch 1; only a foreign process does.
TEST(BatchWindow, ABatchOfAnImpossibleEpochStandsInTheWayOfNone) {
  BatchWindow<AxisBatch> window;
  window.set_next(1, 100);
  EXPECT_EQ(put(window, batch(108, 8, 9)), Arrival::news);
  EXPECT_TRUE(window.gap());
  put(window, batch(100, 8, 1, true));
  EXPECT_EQ(put(window, batch(108, 8, 1)), Arrival::news) << "in the same slot";
  EXPECT_EQ(drain(window), (std::vector<std::uint64_t>{100, 108}));
  window.set_next(1, 116);  // as after a gap, from the drive
  EXPECT_FALSE(window.gap());
}

TEST(BatchWindow, AWindowThatAForeignStartLedAwayIsAstrayAndReturns) {
  BatchWindow<AxisBatch> window;
  window.set_next(1, 100);
  put(window, batch(5000, 8, 9, true));
  EXPECT_EQ(drain(window), std::vector<std::uint64_t>{5000});
  EXPECT_TRUE(window.is_astray(1, 100));
  window.set_next(1, 100);
  EXPECT_FALSE(window.is_astray(1, 100));
  put(window, batch(100, 8, 2, true));
  EXPECT_EQ(drain(window), std::vector<std::uint64_t>{100});
  put(window, batch(1'000'000, 8, 2, true));
  drain(window);
  EXPECT_TRUE(window.is_astray(2, 108)) << "the same epoch, but cycles that nobody may write yet";
}

TEST(FeedbackWindow, RowsAreFoundByTheirCycleOnly) {
  FeedbackWindow window;
  idl::stream::Feedback f;
  f.first = 40, f.count = 2, f.axis_count = 2;
  f.actual = {1, 2, 3, 4};
  window.put(f);
  EXPECT_EQ(window.actual(39), nullptr);
  EXPECT_EQ(window.actual(41)[1], 4);
  EXPECT_EQ(window.actual(40 + FeedbackWindow::rows), nullptr);
}

}  // namespace
}  // namespace trunnion::stream::batch_window_test
