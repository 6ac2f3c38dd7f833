// SPDX-License-Identifier: Apache-2.0
// Stages that run twice: a replica may be killed, hang, come back and be killed again, and the bits are the
// same.
#include <cstdlib>
#include <random>

#include "cluster/swap_ticket.hpp"
#include "cluster_harness.hpp"
#include "machine/services.hpp"
#include "twin_machine.hpp"

namespace trunnion::integration {
namespace {

const std::vector<std::string> stages = machine::transforming_stages();

// `rounds` of 0.4 m with both rotary axes at 100 mm/s or the axes' fastest: about 10 s of motion each.
std::string sweep(int rounds) {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < rounds; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}

Rows undisturbed(const std::string& program) {
  Cluster cluster("ac-table");
  cluster.keep_rows = true;
  cluster.start_text(program);
  EXPECT_TRUE(cluster.finish()) << cluster.told();
  return cluster.rows;
}

void expect_same(const Rows& expected, Cluster& cluster) {
  EXPECT_EQ(first_difference(cluster.rows, expected), "");
}

// Both the launcher and the channel have all replicas again.
bool redundant(Cluster& cluster) {
  return cluster.until([&] { return cluster.ready() && !cluster.has_alarm(102); });
}

TEST(Twins, KillingEitherReplicaOfKinematicsInMotionLosesNoCycleAndChangesNoBit) {
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

// Kills one replica of each of the three stages at random cycles, waits until fresh ones have joined, kills
// the others, and so on until the program ends.
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

constexpr int longer_than_any_test = 3000;  // rounds; 8 h of motion

// The first `count` cycles of the program on a machine that nothing happens to.
Rows reference(const std::string& program, std::size_t count) {
  Cluster cluster("ac-table");
  cluster.keep_rows = true;
  cluster.start_text(program);
  EXPECT_TRUE(cluster.until([&] { return cluster.rows.size() >= count; }, 100)) << cluster.told();
  cluster.rows.resize(count);
  return cluster.rows;
}

void expect_no_bit_changed(Time time, const std::string& second, const std::vector<unsigned>& seeds,
                           int turns) {
  const auto program = sweep(longer_than_any_test);
  const TwinMachine machine(stages, second);
  if (time == Time::real) machine.set_lead(lead_beyond_stalls);
  std::vector<Rows> disturbed;
  std::size_t longest = 0;
  for (const auto seed : seeds) {
    Cluster cluster(machine.path(), time);
    cluster.keep_rows = true;
    cluster.start_text(program);
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > 500; }));
    kill_in_turn(cluster, seed, turns);
    const auto after = cluster.expected_cycle + 500;
    ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle > after; })) << cluster.told();
    EXPECT_EQ(cluster.state(), RunState::RUNNING) << "seed " << seed << " " << cluster.told();
    EXPECT_EQ(cluster.feedback.starved, 0u) << "seed " << seed;
    longest = std::max(longest, cluster.rows.size());
    disturbed.push_back(std::move(cluster.rows));
  }
  const auto expected = reference(program, longest);
  ASSERT_EQ(expected.size(), longest);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto& rows = disturbed[i];
    EXPECT_EQ(first_difference(rows, {expected.begin(), expected.begin() + static_cast<long>(rows.size())}),
              "")
        << "seed " << seeds[i];
    std::printf("seed %u: %d replicas killed within %zu cycles, the same bits\n", seeds[i], 3 * turns,
                rows.size());
  }
}

TEST(Twins, ThreeOriginalsThenTheOtherThreeAreKilledInVirtualTimeAndNoBitChanges) {
  expect_no_bit_changed(Time::virtual_, "fastdds", {1, 2}, 2);
}

TEST(Twins, ThreeOriginalsThenTheOtherThreeAreKilledInRealTimeAndNoBitChanges) {
  expect_no_bit_changed(Time::real, "cyclonedds", {3}, 2);
}

// Run by the target soak_twins: 20 seeds, each with 36 kills.
TEST(Twins, DISABLED_Soak) {
  for (unsigned seed = 100; seed < 120; ++seed) expect_no_bit_changed(Time::virtual_, "fastdds", {seed}, 12);
}

// Run by the target soak_twins: both replicas of kinematics die, 0.3 s apart, so that each has to begin again
// without the other. They must agree in every cycle from then on: 103 is the alarm of replicas that differ.
// The launcher gives up after five lives below 10 s, so a cluster is used three times.
TEST(Twins, DISABLED_SoakOfBothReplicasKilled) {
  const char* const asked = std::getenv("TRUNNION_SOAK_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : 500;
  const auto program = sweep(2000);
  const TwinMachine machine({"kinematics"});
  std::mt19937 random(1);
  int done = 0;
  while (done < kills) {
    Cluster cluster(machine.path());
    cluster.start_text(program);
    for (int use = 0; use < 3 && done < kills; ++use, ++done) {
      const auto at = cluster.expected_cycle + 200 + random() % 500;
      ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle >= at; })) << cluster.told();
      const unsigned first = random() % 2;
      const int other = cluster.service("kinematics", 1 - first)->pid;
      ASSERT_EQ(kill(cluster.service("kinematics", first)->pid, SIGKILL), 0);
      cluster.until([] { return false; }, 0.3);
      ASSERT_EQ(kill(other, SIGKILL), 0);
      ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(100); })) << done << ": " << cluster.told();
      ASSERT_TRUE(cluster.until([&] {
        return cluster.ready() && cluster.service("kinematics", 1 - first)->pid != other;
      })) << done
          << ": " << cluster.told();
      ASSERT_FALSE(cluster.has_alarm(103)) << done << ": " << cluster.told();
      ASSERT_TRUE(cluster.go_on()) << done << ": " << cluster.told();
      const auto then = cluster.expected_cycle + 500;
      ASSERT_TRUE(cluster.until([&] { return cluster.expected_cycle >= then; }))
          << done << ": " << cluster.told();
      ASSERT_FALSE(cluster.has_alarm(103)) << done << ": " << cluster.told();
    }
    if (done % 30 == 0) std::printf("%d of %d\n", done, kills), std::fflush(stdout);
  }
}

class CopiesThatDiffer : public testing::TestWithParam<std::string> {};

TEST_P(CopiesThatDiffer, StopTheMotionWithAnAlarmThatNamesStageCycleAndBothValues) {
  const std::string stage = GetParam();
  const TwinMachine machine({stage});
  Cluster cluster(machine.path());
  // At rest there is nothing to compare, so the wrong one gets in; it is wrong in the last bit of cycle 700.
  idl::service::SwapRequest request;
  request.service = stage, request.replica = 1, request.cycles = 500, request.vendor = "cyclonedds";
  request.executable = cluster::binary_directory() + "/" + stage + "_one_bit";
  service::RequestClient<idl::service::SwapRequest, idl::service::SwapReply> client(
      cluster.client().bus(), topics::swap_request, topics::swap_reply);
  cluster::put_ticket(cluster.running().run.path(), request);
  const auto reply = client.call(request, 30);
  ASSERT_TRUE(reply);
  ASSERT_TRUE(reply->accepted) << reply->reason;
  ASSERT_TRUE(redundant(cluster)) << cluster.told();
  cluster.start_text(sweep(100));
  ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(103); })) << cluster.told();
  EXPECT_TRUE(cluster.has_alarm(103, "of " + stage + " differ in cycle 700, column 0: ")) << cluster.told();
  EXPECT_TRUE(cluster.has_alarm(103, " and ")) << "both values";
  ASSERT_TRUE(cluster.until([&] { return cluster.feedback.mode == DriveMode::HELD; })) << cluster.told();
  const auto stopped = cluster.expected_cycle;
  std::printf("%s: differs in cycle 700, the machine stands at cycle %llu\n", stage.c_str(),
              static_cast<unsigned long long>(stopped));
  cluster.until([] { return false; }, 0.3);
  EXPECT_EQ(cluster.expected_cycle, stopped) << "stands still";
}

INSTANTIATE_TEST_SUITE_P(Stages, CopiesThatDiffer, testing::ValuesIn(machine::transforming_stages()),
                         [](const auto& stage) { return std::string(stage.param); });

}  // namespace
}  // namespace trunnion::integration
