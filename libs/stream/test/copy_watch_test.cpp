#include "stream/copy_watch.hpp"

#include <gtest/gtest.h>

#include <random>

#include "stream/stage_names.hpp"

namespace trunnion::stream {
namespace {

using Standing = CopyWatch::Standing;
constexpr std::uint64_t lead = 32;

std::vector<machine::ServiceEntry> twins() {
  std::vector<machine::ServiceEntry> services;
  for (const char* name : {"channel", "kinematics", "kinematics", "compensation", "drive"}) {
    machine::ServiceEntry entry;
    entry.service = name;
    entry.copy = services.size() == 2 ? 1 : 0;
    services.push_back(entry);
  }
  return services;
}

class Watch {
 public:
  // A sign of copy `copy` and the judgement `seconds` later than the last.
  void say(std::uint8_t copy, std::uint64_t next, bool in_step = true, std::uint32_t epoch = 1) {
    watch.heard({Stage::KINEMATICS, copy, 0, in_step, epoch, next}, now);
  }
  void pass(double seconds) {
    now += seconds;
    for (const auto& change : watch.judge(lead, now)) changes.push_back(change);
  }
  Standing standing(std::size_t copy) const { return watch.copies().at(copy).standing; }

  double now = 100;
  CopyWatch watch{twins(), now};
  std::vector<CopyWatch::Change> changes;
};

TEST(CopyWatch, FollowsStagesWithTwinsOnly) {
  const Watch w;
  ASSERT_EQ(w.watch.copies().size(), 2u);
  EXPECT_EQ(w.watch.copies()[0].stage, Stage::KINEMATICS);
  EXPECT_EQ(w.watch.copies()[1].copy, 1);
  auto single = twins();
  single.erase(single.begin() + 2);
  CopyWatch none(single, 0);
  EXPECT_TRUE(none.copies().empty());
  EXPECT_TRUE(none.may_start(0));
  EXPECT_EQ(none.floor(), CopyWatch::everywhere);
}

TEST(CopyWatch, AStartWaitsUntilBothAreInStepAndAtMostTwoSeconds) {
  Watch w;
  w.say(0, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.standing(0), Standing::in_step);
  EXPECT_FALSE(w.watch.may_start(w.now));
  w.say(1, 0, false);
  w.pass(0.01);
  EXPECT_FALSE(w.watch.may_start(w.now)) << "it joins";
  w.say(1, 1000);
  w.pass(0.01);
  EXPECT_TRUE(w.watch.may_start(w.now));
  EXPECT_TRUE(w.changes.empty()) << "joining at the beginning is no loss";

  Watch late;
  for (int i = 0; i < 41; ++i) {  // 2.05 s
    EXPECT_FALSE(late.watch.may_start(late.now)) << i;
    late.say(0, 1000);
    late.pass(0.05);
  }
  EXPECT_TRUE(late.watch.may_start(late.now))
      << "the machine is not stopped for ever by a copy that never came";
}

TEST(CopyWatch, TheFloorIsTheSlowestCopyInStep) {
  Watch w;
  w.say(0, 1000), w.say(1, 960);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 960u);
  w.say(1, 992);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 992u);
  w.say(1, 5000, false);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 1000u) << "a copy that joins holds nobody up";
}

TEST(CopyWatch, ACopyWithoutProgressWhileItsTwinAdvancesIsDroppedAfter100Milliseconds) {
  Watch w;
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  w.say(0, 1032);
  w.pass(0.01);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(w.standing(1), Standing::in_step) << i;
    w.say(0, 1064), w.say(1, 1000);  // signs of life without progress
    w.pass(0.01);
  }
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::dropped);
  ASSERT_EQ(w.changes.size(), 1u);
  EXPECT_TRUE(w.changes[0].lost);
  EXPECT_EQ(w.changes[0].copy, 1);
  EXPECT_EQ(w.watch.floor(), 1064u) << "nobody waits for it any more";
  // It lives, but as long as it does not advance it stays dropped.
  w.say(1, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::dropped);
  w.say(1, 1064);
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::in_step);
  ASSERT_EQ(w.changes.size(), 2u);
  EXPECT_FALSE(w.changes[1].lost);
}

TEST(CopyWatch, ABusyCopyThatAdvancesIsNotDropped) {
  Watch w;
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  for (std::uint64_t i = 1; i < 200; ++i) {
    w.say(0, 1064 + 32 * i), w.say(1, 1000 + 32 * i);  // always two leads behind
    w.pass(0.05);
    ASSERT_EQ(w.standing(1), Standing::in_step);
  }
  EXPECT_TRUE(w.changes.empty());
}

TEST(CopyWatch, ADroppedCopyMustComeWithinTwoLeadsToBeBack) {
  Watch w;
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  w.say(1, 0, false);
  w.pass(0.09);
  w.say(0, 1200), w.say(1, 0, false);
  w.pass(0.12);
  ASSERT_EQ(w.standing(1), Standing::dropped);
  w.say(0, 2000), w.say(1, 2000 - 2 * lead - 1);
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::dropped);
  w.say(0, 2000), w.say(1, 2000 - 2 * lead);
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::in_step);
}

TEST(CopyWatch, ACopyThatIsSilentAtRestIsLostAndItsReplacementIsBack) {
  Watch w;
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  for (int i = 0; i < 7; ++i) {
    w.say(0, 1000);
    w.pass(0.1);
  }
  EXPECT_EQ(w.standing(1), Standing::dropped);
  EXPECT_FALSE(w.watch.may_start(w.now));
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.standing(1), Standing::in_step);
  EXPECT_TRUE(w.watch.may_start(w.now));
  EXPECT_EQ(w.changes.size(), 2u);
}

TEST(CopyWatch, ANewEpochAtAnEarlierCycleIsProgress) {
  Watch w;
  w.say(0, 1000), w.say(1, 1000);
  w.pass(0.01);
  w.say(0, 900, true, 2);
  w.pass(0.05);
  w.say(1, 900, true, 2);
  w.pass(0.06);
  EXPECT_EQ(w.standing(0), Standing::in_step);
  EXPECT_EQ(w.standing(1), Standing::in_step);
  EXPECT_EQ(w.watch.floor(), 900u);
}

// Property over 500 seeded histories of two copies that stop, go on and join as they like: the floor never
// lies above a copy in step, a copy that advanced within the last 100 ms and reports itself in step is never
// newly dropped, and losses and returns alternate.
TEST(CopyWatch, KeepsItsPromisesOverRandomHistories) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    Watch w;
    std::uint64_t next[2] = {100, 100};
    double advanced[2] = {w.now, w.now};
    bool lost[2] = {false, false};
    for (int step = 0; step < 300; ++step) {
      for (std::uint8_t copy = 0; copy < 2; ++copy) {
        const auto what = random() % 10;
        if (what < 6) {
          next[copy] =
              std::max(next[copy], next[1 - copy] - std::min<std::uint64_t>(next[1 - copy], 2 * lead)) + 1 +
              random() % 32;
          advanced[copy] = w.now;
          w.say(copy, next[copy]);
        } else if (what == 6) {
          w.say(copy, next[copy]);
        } else if (what == 7) {
          w.say(copy, next[copy], random() % 4 != 0);
        }
      }
      const auto before = w.changes.size();
      w.pass(0.001 * static_cast<double>(random() % 60));
      for (auto i = before; i < w.changes.size(); ++i) {
        const auto& change = w.changes[i];
        ASSERT_NE(change.lost, lost[change.copy]) << "seed " << seed;
        lost[change.copy] = change.lost;
        if (change.lost && w.watch.copies()[change.copy].reports_in_step) {
          ASSERT_GT(w.now - advanced[change.copy], CopyWatch::progress_patience) << "seed " << seed;
        }
      }
      for (std::size_t copy = 0; copy < 2; ++copy)
        if (w.standing(copy) == Standing::in_step) {
          ASSERT_LE(w.watch.floor(), w.watch.copies()[copy].next);
        }
    }
  }
}

}  // namespace
}  // namespace trunnion::stream
