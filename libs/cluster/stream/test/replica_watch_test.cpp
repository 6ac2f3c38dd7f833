// SPDX-License-Identifier: Apache-2.0
#include "stream/replica_watch.hpp"

#include <gtest/gtest.h>

#include <random>

#include "stream/stage_names.hpp"

namespace trunnion::stream {
namespace {

using Status = ReplicaWatch::Status;
constexpr std::uint64_t lead = 32;

std::vector<machine::ServiceEntry> replicated() {
  std::vector<machine::ServiceEntry> services;
  for (const char* name : {"channel", "kinematics", "kinematics", "compensation", "drive"}) {
    machine::ServiceEntry entry;
    entry.service = name;
    entry.replica = services.size() == 2 ? 1 : 0;
    services.push_back(entry);
  }
  return services;
}

class Watch {
 public:
  // A report of `replica`; pass() evaluates `seconds` after the last evaluation.
  void report(std::uint8_t replica, std::uint64_t next, bool in_step = true, std::uint32_t epoch = 1) {
    watch.update({Stage::KINEMATICS, replica, 0, in_step, epoch, next}, now);
  }
  void pass(double seconds) {
    now += seconds;
    for (const auto& change : watch.evaluate(lead, now)) changes.push_back(change);
  }
  Status status(std::size_t replica) const { return watch.replicas().at(replica).status; }

  double now = 100;
  ReplicaWatch watch{replicated(), now};
  std::vector<ReplicaWatch::Change> changes;
};

TEST(ReplicaWatch, FollowsStagesWithReplicasOnly) {
  const Watch w;
  ASSERT_EQ(w.watch.replicas().size(), 2u);
  EXPECT_EQ(w.watch.replicas()[0].stage, Stage::KINEMATICS);
  EXPECT_EQ(w.watch.replicas()[1].number, 1);
  auto single = replicated();
  single.erase(single.begin() + 2);
  ReplicaWatch none(single, 0);
  EXPECT_TRUE(none.replicas().empty());
  EXPECT_TRUE(none.may_start(0));
  EXPECT_EQ(none.floor(), ReplicaWatch::everywhere);
}

TEST(ReplicaWatch, AStartWaitsUntilBothAreInStepAndAtMostTwoSeconds) {
  Watch w;
  w.report(0, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.status(0), Status::in_step);
  EXPECT_FALSE(w.watch.may_start(w.now));
  w.report(1, 0, false);
  w.pass(0.01);
  EXPECT_FALSE(w.watch.may_start(w.now)) << "it joins";
  w.report(1, 1000);
  w.pass(0.01);
  EXPECT_TRUE(w.watch.may_start(w.now));
  EXPECT_TRUE(w.changes.empty()) << "joining at the beginning is no loss";

  Watch late;
  for (int i = 0; i < 41; ++i) {  // 2.05 s
    EXPECT_FALSE(late.watch.may_start(late.now)) << i;
    late.report(0, 1000);
    late.pass(0.05);
  }
  EXPECT_TRUE(late.watch.may_start(late.now))
      << "the machine is not stopped for ever by a replica that never came";
}

TEST(ReplicaWatch, TheFloorIsTheSlowestReplicaInStep) {
  Watch w;
  w.report(0, 1000), w.report(1, 960);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 960u);
  w.report(1, 992);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 992u);
  w.report(1, 5000, false);
  w.pass(0.01);
  EXPECT_EQ(w.watch.floor(), 1000u) << "a replica that joins delays no one";
}

TEST(ReplicaWatch, AReplicaWithoutProgressWhileTheOtherAdvancesIsDroppedAfter100Milliseconds) {
  Watch w;
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  w.report(0, 1032);
  w.pass(0.01);
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(w.status(1), Status::in_step) << i;
    w.report(0, 1064), w.report(1, 1000);  // reports without progress
    w.pass(0.01);
  }
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::dropped);
  ASSERT_EQ(w.changes.size(), 1u);
  EXPECT_TRUE(w.changes[0].lost);
  EXPECT_EQ(w.changes[0].number, 1);
  EXPECT_EQ(w.watch.floor(), 1064u) << "no start waits for it any more";
  // It reports, but without progress it stays dropped.
  w.report(1, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::dropped);
  w.report(1, 1064);
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::in_step);
  ASSERT_EQ(w.changes.size(), 2u);
  EXPECT_FALSE(w.changes[1].lost);
}

TEST(ReplicaWatch, ABusyReplicaThatAdvancesIsNotDropped) {
  Watch w;
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  for (std::uint64_t i = 1; i < 200; ++i) {
    w.report(0, 1064 + 32 * i), w.report(1, 1000 + 32 * i);  // always two leads behind
    w.pass(0.05);
    ASSERT_EQ(w.status(1), Status::in_step);
  }
  EXPECT_TRUE(w.changes.empty());
}

TEST(ReplicaWatch, ADroppedReplicaMustComeWithinTwoLeadsToBeBack) {
  Watch w;
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  w.report(1, 0, false);
  w.pass(0.09);
  w.report(0, 1200), w.report(1, 0, false);
  w.pass(0.12);
  ASSERT_EQ(w.status(1), Status::dropped);
  w.report(0, 2000), w.report(1, 2000 - 2 * lead - 1);
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::dropped);
  w.report(0, 2000), w.report(1, 2000 - 2 * lead);
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::in_step);
}

TEST(ReplicaWatch, AReplicaThatIsSilentAtRestIsLostAndItsReplacementIsBack) {
  Watch w;
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  for (int i = 0; i < 7; ++i) {
    w.report(0, 1000);
    w.pass(0.1);
  }
  EXPECT_EQ(w.status(1), Status::dropped);
  EXPECT_FALSE(w.watch.may_start(w.now));
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  EXPECT_EQ(w.status(1), Status::in_step);
  EXPECT_TRUE(w.watch.may_start(w.now));
  EXPECT_EQ(w.changes.size(), 2u);
}

TEST(ReplicaWatch, ANewEpochAtAnEarlierCycleIsProgress) {
  Watch w;
  w.report(0, 1000), w.report(1, 1000);
  w.pass(0.01);
  w.report(0, 900, true, 2);
  w.pass(0.05);
  w.report(1, 900, true, 2);
  w.pass(0.06);
  EXPECT_EQ(w.status(0), Status::in_step);
  EXPECT_EQ(w.status(1), Status::in_step);
  EXPECT_EQ(w.watch.floor(), 900u);
}

// Property over 500 seeded histories of two replicas that stop, continue and join at random: the floor never
// is above a replica in step, a replica that advanced within the last 100 ms and reports itself in step is
// never newly dropped, and losses and returns alternate.
TEST(ReplicaWatch, KeepsItsPropertiesOverRandomHistories) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    Watch w;
    std::uint64_t next[2] = {100, 100};
    double advanced[2] = {w.now, w.now};
    bool lost[2] = {false, false};
    for (int step = 0; step < 300; ++step) {
      for (std::uint8_t replica = 0; replica < 2; ++replica) {
        const auto what = random() % 10;
        if (what < 6) {
          next[replica] = std::max(next[replica],
                                   next[1 - replica] - std::min<std::uint64_t>(next[1 - replica], 2 * lead)) +
                          1 + random() % 32;
          advanced[replica] = w.now;
          w.report(replica, next[replica]);
        } else if (what == 6) {
          w.report(replica, next[replica]);
        } else if (what == 7) {
          w.report(replica, next[replica], random() % 4 != 0);
        }
      }
      const auto before = w.changes.size();
      w.pass(0.001 * static_cast<double>(random() % 60));
      for (auto i = before; i < w.changes.size(); ++i) {
        const auto& change = w.changes[i];
        ASSERT_NE(change.lost, lost[change.number]) << "seed " << seed;
        lost[change.number] = change.lost;
        if (change.lost && w.watch.replicas()[change.number].reports_in_step) {
          ASSERT_GT(w.now - advanced[change.number], ReplicaWatch::progress_timeout) << "seed " << seed;
        }
      }
      for (std::size_t replica = 0; replica < 2; ++replica)
        if (w.status(replica) == Status::in_step) {
          ASSERT_LE(w.watch.floor(), w.watch.replicas()[replica].next);
        }
    }
  }
}

}  // namespace
}  // namespace trunnion::stream
