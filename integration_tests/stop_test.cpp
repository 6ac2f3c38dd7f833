// SPDX-License-Identifier: Apache-2.0
// A stage without a twin dies in full motion: how far the machine still goes, and that the workpiece does not
// show it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cluster_harness.hpp"
#include "machine/services.hpp"

namespace trunnion::integration {
namespace {

// Two rounds of 0.3 m with both rotary axes at 100 mm/s, or the axes' fastest: about 7 s.
std::string sweep() {
  std::string text = "G21 G17 G90 G54\nG0 X0 Y0 A0 C0\nG43.4 H1\nG1 X0 Y0 Z80 F6000\n";
  for (int i = 0; i < 2; ++i) text += "X60 Y30 A20 C40 F6000\nX-60 Y-30 A-10 C-20\n";
  return text + "X0 Y0 A0 C0\nG49\nM30\n";
}

constexpr double path_tolerance = 0.01;  // mm or deg, parameter 040901 of the machine

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

double distance_to_segment(const std::vector<double>& p, const std::vector<double>& a,
                           const std::vector<double>& b) {
  double along = 0, length = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    along += (p[i] - a[i]) * (b[i] - a[i]);
    length += (b[i] - a[i]) * (b[i] - a[i]);
  }
  const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  std::vector<double> foot(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) foot[i] = a[i] + t * (b[i] - a[i]);
  return distance(p, foot);
}

// Largest distance of the points of `path` from the line through `reference`, both followed in one direction:
// a point may lie at most 200 cycles of the reference farther on than the one before it.
double deviation(const Rows& path, const Rows& reference) {
  double most = 0;
  std::size_t at = 0;
  for (const auto& point : path) {
    if (point.empty()) continue;
    double nearest = 1e9;
    std::size_t where = at;
    // The path goes to and fro on one line: of the places that are near enough the first is meant.
    for (std::size_t k = at; k + 1 < reference.size() && k < at + 200 && nearest > path_tolerance; ++k)
      if (const double d = distance_to_segment(point, reference[k], reference[k + 1]); d < nearest)
        nearest = d, where = k;
    at = where;
    most = std::max(most, nearest);
  }
  return most;
}

Rows undisturbed_rows() {
  Cluster cluster("ac-table");
  cluster.keep_rows = true;
  cluster.start_text(sweep());
  EXPECT_TRUE(cluster.finish()) << cluster.told();
  auto rows = cluster.rows;
  std::erase_if(rows, [](const auto& row) { return row.empty(); });
  return rows;
}

// Into the fast part. A virtual machine's processor may be away for longer than half the lead before there is
// anything to see.
void run_to_line_6(Cluster& cluster) {
  cluster.keep_rows = true;
  cluster.start_text(sweep());
  for (int i = 0; i < 5 && cluster.channels[0].line < 6; ++i) {
    if (i > 0) {
      ASSERT_TRUE(cluster.go_on()) << cluster.told();
    }
    cluster.until([&] { return cluster.channels[0].line >= 6 || cluster.state() == RunState::INTERRUPTED; });
  }
  ASSERT_GE(cluster.channels[0].line, 6) << cluster.told();
  ASSERT_EQ(cluster.state(), RunState::RUNNING) << cluster.told();
}

class StageLost : public testing::TestWithParam<std::string> {};

TEST_P(StageLost, StopsOnThePathWithinTheLeadAndTheWorkpieceDoesNotShowIt) {
  const auto undisturbed = undisturbed_rows();
  const std::string victim = GetParam();
  // In real time the drive brakes at once; in virtual time it would wait for the stage to come back.
  Cluster cluster("ac-table", Time::real);
  ASSERT_NO_FATAL_FAILURE(run_to_line_6(cluster));
  ASSERT_FALSE(cluster.has_alarm(110)) << cluster.told();
  cluster.history.clear();
  const auto killed = cluster.expected_cycle;
  ASSERT_EQ(kill(cluster.service(victim)->pid, SIGKILL), 0);
  ASSERT_TRUE(cluster.until([&] { return cluster.has_alarm(110); })) << cluster.told();
  ASSERT_TRUE(cluster.until([&] { return cluster.feedback.mode == DriveMode::HELD; })) << cluster.told();
  const auto stood = cluster.expected_cycle;  // the first cycle that is not executed

  // The drive says with which cycle the setpoints ended, how many were at hand and how many it needed.
  unsigned long long missing = 0, at_hand = 0, needed = 0;
  for (const auto& alarm : cluster.history) {
    if (!alarm.active || alarm.number != 110) continue;
    ASSERT_EQ(std::sscanf(alarm.text.c_str(), "No setpoint for cycle %llu in time; %llu cycles at hand, %llu",
                          &missing, &at_hand, &needed),
              3)
        << alarm.text;
  }
  const auto begun = missing - at_hand;
  constexpr std::uint64_t lead = 32;  // parameter 000900; the drive keeps at most half of it to stop with
  std::printf(
      "%s killed: the last setpoint is of cycle %llu, braking began at %llu with %llu at hand (%llu needed), "
      "stood at %llu: %llu cycles after the lack was seen, %llu after the kill\n",
      victim.c_str(), missing - 1, begun, at_hand, needed, static_cast<unsigned long long>(stood),
      static_cast<unsigned long long>(stood) - begun, static_cast<unsigned long long>(stood - killed));
  EXPECT_LE(at_hand, lead) << "by the credits nothing farther than the lead can be on its way";
  EXPECT_LE(stood - begun, at_hand) << "it stood before the setpoints ended: on the path";
  EXPECT_LE(stood - begun, lead / 2);

  ASSERT_TRUE(cluster.until([&] { return cluster.ready(); }));
  // A busy machine may stop once more: that, too, leaves the path as it is.
  bool finished = false;
  for (int i = 0; i < 5 && !finished; ++i) {
    ASSERT_TRUE(cluster.go_on()) << cluster.told();
    finished = cluster.finish();
  }
  ASSERT_TRUE(finished) << cluster.told();
  // Where the channel held while the service was away it has rounded its corners at another speed, within the
  // path tolerance, once on each side of a corner.
  const double off = deviation(cluster.rows, undisturbed);
  std::printf("%s killed: at most %.6f mm or deg off the undisturbed path over %zu cycles, undisturbed %zu\n",
              victim.c_str(), off, cluster.rows.size(), undisturbed.size());
  EXPECT_LE(off, 2 * path_tolerance);
  EXPECT_EQ(distance(cluster.rows.back(), undisturbed.back()), 0) << "the same last point";
}

// The stage lives, it was only late: nobody has to find out what is wrong, and to reset it.
TEST(Starved, OneKeyContinuesAtThePlaceTheWorkpieceDoesNotShowItAndNoAlarmIsLeft) {
  const auto undisturbed = undisturbed_rows();
  Cluster cluster("ac-table", Time::real);
  ASSERT_NO_FATAL_FAILURE(run_to_line_6(cluster));
  const auto pid = cluster.service("kinematics")->pid;
  ASSERT_EQ(kill(pid, SIGSTOP), 0);
  const bool stopped = cluster.until([&] { return cluster.state() == RunState::INTERRUPTED; });
  ASSERT_EQ(kill(pid, SIGCONT), 0);
  ASSERT_TRUE(stopped) << cluster.told();
  ASSERT_TRUE(cluster.until([&] {
    return cluster.feedback.mode == DriveMode::HELD && cluster.has_alarm(110);
  })) << cluster.told();
  // A busy machine may stop once more.
  bool finished = false;
  for (int i = 0; i < 5 && !finished; ++i) {
    ASSERT_NO_THROW(cluster.client().channel(0, CommandKind::CYCLE_START)) << cluster.told();
    ASSERT_TRUE(cluster.until([&] { return cluster.state() != RunState::INTERRUPTED; })) << cluster.told();
    finished = cluster.finish();
  }
  ASSERT_TRUE(finished) << cluster.told();
  EXPECT_TRUE(cluster.until([&] { return cluster.active_alarms().empty(); })) << cluster.told();
  EXPECT_LE(deviation(cluster.rows, undisturbed), 2 * path_tolerance);
  EXPECT_EQ(distance(cluster.rows.back(), undisturbed.back()), 0) << "the same last point";
}

INSTANTIATE_TEST_SUITE_P(Stages, StageLost, testing::ValuesIn(machine::transforming_stages()),
                         [](const auto& stage) { return std::string(stage.param); });

}  // namespace
}  // namespace trunnion::integration
