// Stages that run twice: a copy may be killed, hang, come back and be killed again, and the bits are the same.
#include <random>

#include "cluster_harness.hpp"
#include "twin_machine.hpp"

namespace trunnion::integration {
namespace {

const std::vector<std::string> stages = {"kinematics", "compensation", "gantry"};

// `rounds` of 0.4 m with both rotary axes at 100 mm/s or the axes' fastest: about 10 s of motion each.
std::string sweep(int rounds) {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < rounds; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}

using Rows = std::vector<std::vector<double>>;

Rows undisturbed(const std::string& program) {
  Cluster cluster("ac-table");
  cluster.keep_rows = true;
  cluster.start_text(program);
  EXPECT_TRUE(cluster.finish()) << cluster.told();
  return cluster.rows;
}

void expect_same(const Rows& expected, Cluster& cluster) {
  EXPECT_EQ(cluster.lost_frames, 0u) << "of the feedback, by this test";
  EXPECT_EQ(cluster.rows.size(), expected.size());
  EXPECT_TRUE(cluster.rows == expected) << "the same bits";
}

// Both the launcher and the channel have all copies again.
bool redundant(Cluster& cluster) {
  return cluster.until([&] { return cluster.ready() && !cluster.has_alarm(102); });
}

TEST(Twins, KillingEitherCopyOfKinematicsInMotionLosesNoCycleAndChangesNoBit) {
  const auto program = sweep(40);
  const auto expected = undisturbed(program);
  const TwinMachine machine({"kinematics"});
  for (const unsigned victim : {0u, 1u}) {
    Cluster cluster(machine.path());
    cluster.keep_rows = true;
    cluster.start_text(program);
    ASSERT_TRUE(cluster.until([&] { return cluster.channels[0].line >= 8; }));
    const int pid = cluster.service("kinematics", victim)->pid;
    ASSERT_EQ(kill(pid, SIGKILL), 0);
    ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(102, "kinematics"); }))
        << "redundancy lost is an alarm; " << cluster.active_alarms();
    ASSERT_TRUE(cluster.finish()) << cluster.told();
    EXPECT_FALSE(cluster.has_alarm(110)) << "no setpoint was missing";
    EXPECT_EQ(cluster.feedback.starved, 0u);
    expect_same(expected, cluster);
    EXPECT_TRUE(cluster.until([&] {
      return cluster.ready() && cluster.service("kinematics", victim)->pid != pid;
    })) << "started again";
    EXPECT_TRUE(cluster.until([&] { return !cluster.has_alarm(102); }))
        << "nobody has to acknowledge it; " << cluster.told();
  }
}

// Kills one copy of each of the three stages at random cycles, waits until fresh ones have joined, kills the
// others, and so on until the program ends.
void kill_in_turn(Cluster& cluster, unsigned seed, int turns) {
  std::mt19937 random(seed);
  for (int turn = 0; turn < turns; ++turn) {
    const unsigned victim = turn % 2;
    auto order = stages;
    std::shuffle(order.begin(), order.end(), random);
    for (const auto& stage : order) {
      const auto at = cluster.expected_cycle + random() % 500;
      ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle >= at; })) << cluster.told();
      ASSERT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
      ASSERT_EQ(kill(cluster.service(stage, victim)->pid, SIGKILL), 0);
    }
    ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(102); })) << cluster.told();
    ASSERT_TRUE(redundant(cluster)) << cluster.told();
  }
}

TEST(Twins, ThreeOriginalsThenTheOtherThreeAreKilledInVirtualTimeAndNoBitChanges) {
  const auto program = sweep(800);
  const auto expected = undisturbed(program);
  const TwinMachine machine(stages);
  for (const unsigned seed : {1u, 2u}) {
    Cluster cluster(machine.path());
    cluster.keep_rows = true;
    cluster.start_text(program);
    kill_in_turn(cluster, seed, 2);
    ASSERT_TRUE(cluster.finish()) << "seed " << seed << " " << cluster.told();
    EXPECT_EQ(cluster.feedback.starved, 0u);
    expect_same(expected, cluster);
  }
}

}  // namespace
}  // namespace trunnion::integration
