// SPDX-License-Identifier: Apache-2.0
// Every cell of the fault matrix on a cluster of its own, in virtual time. A whole run is `make faults`; a
// sample of the cells runs with every other test.
#include <cstdlib>
#include <functional>

#include "fault_matrix_rig.hpp"

namespace trunnion::integration {
namespace {

// Cycles: what is written ahead in virtual time (000903), what is in a batch when the channel learns of it
// and the batch that ends it (64 each), and 0.1 s for the path's own braking at 1 ms: 50 mm/s need 13 at the
// axes' 4000 mm/s2 and twice the smoothing, 40, and the proof of the limits plans with less than the whole
// acceleration.
constexpr std::int64_t hold_bound = 512 + 2 * 64 + 100;

std::optional<std::uint32_t> given_domain() {
  const char* text = std::getenv("TRUNNION_TEST_DOMAIN");
  if (text == nullptr) return std::nullopt;
  return static_cast<std::uint32_t>(std::atoi(text));
}

// Cells strike at different places of the program, each always at the same.
unsigned line_of(const Cell& cell) {
  unsigned hash = 2166136261u;
  for (const char c : cell.name()) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
  return 9 + hash % 14;
}

void expect_alarms(const Observation& seen, const Expectation& expected) {
  for (const auto number : expected.must)
    EXPECT_TRUE(seen.alarms.count(number)) << "alarm " << number << " is missing";
  for (const auto number : seen.alarms)
    EXPECT_TRUE(expected.must.count(number) || expected.may.count(number))
        << "alarm " << number << " is unexpected";
}

// Rows lie on the way of the undisturbed run, in its order, with nothing left out.
void expect_on_path(const FaultRig& rig, const Rows& reference, bool to_the_end) {
  const auto judgement = rig.judge(reference, to_the_end);
  EXPECT_EQ(judgement.problem, "");
  testing::Test::RecordProperty("largest_deviation_nm", static_cast<int>(judgement.largest * 1e6));
  testing::Test::RecordProperty("cycles_gone_back", static_cast<int>(judgement.back));
  testing::Test::RecordProperty("unseen_cycles", static_cast<int>(judgement.unseen));
}

class FaultMatrix : public testing::TestWithParam<Cell> {
 protected:
  void in_motion(FaultRig& rig, const Rows& reference, const Expectation& expected);
  void at_rest(FaultRig& rig, const Rows& reference, const Expectation& expected);
  double runs_ = 0;  ///< begun
};

void FaultMatrix::in_motion(FaultRig& rig, const Rows& reference, const Expectation& expected) {
  const auto& cell = GetParam();
  rig.begin(), ++runs_;
  const unsigned line = line_of(cell);
  // Until it moves, the channel shows the last line of the run before.
  const auto moves = [&] {
    return rig.cluster().rows.size() > 500 && rig.cluster().channels[0].line >= line;
  };
  ASSERT_TRUE(rig.cluster().until(moves)) << rig.cluster().told();
  ASSERT_NO_FATAL_FAILURE(rig.strike(cell.service, cell.fault));
  const auto seen = rig.await(cell.service, cell.fault, true);
  expect_alarms(seen, expected);
  if (expected.machine == Machine::goes_on) {
    EXPECT_FALSE(seen.stopped);
    ASSERT_TRUE(rig.finish()) << rig.cluster().told();
    EXPECT_TRUE(same_rows(rig.rows(), reference, 1e-9))
        << rig.rows().size() << " rows, not " << reference.size();
    return;
  }
  EXPECT_TRUE(seen.stopped) << rig.cluster().told();
  if (expected.machine == Machine::stops_axes_off) {
    EXPECT_TRUE(seen.axes_off);
  }
  if (seen.cycles_of_hold) {
    RecordProperty("cycles_of_hold", static_cast<int>(*seen.cycles_of_hold));
    EXPECT_LE(*seen.cycles_of_hold, hold_bound);
  }
  if (seen.cycles_of_braking) {
    RecordProperty("cycles_of_braking", static_cast<int>(*seen.cycles_of_braking));
    EXPECT_LE(*seen.cycles_of_braking, *seen.cycles_at_hand) << "no cycle that was not at hand";
  }
  const auto at = rig.cluster().channels[0].machine;
  rig.cluster().until([] { return false; }, 0.2);
  for (std::size_t i = 0; i < at.size(); ++i)
    EXPECT_NEAR(rig.cluster().channels[0].machine[i], at[i], 0.05) << "stands still";

  const auto way = rig.go_on();
  if (expected.may_begin_again && seen.axes_off)
    EXPECT_EQ(way, Way::begin_again);
  else
    EXPECT_EQ(way, expected.way);
  if (way == Way::begin_again) {
    expect_on_path(rig, reference, false);
    rig.go_home();
    rig.begin(), ++runs_;
  }
  ASSERT_TRUE(rig.finish()) << rig.cluster().told();
  expect_on_path(rig, reference, true);
}

void FaultMatrix::at_rest(FaultRig& rig, const Rows& reference, const Expectation& expected) {
  const auto& cell = GetParam();
  rig.mdi("G53 G0 X12.5 Y-7.25 Z-30 A15 C-20");
  rig.cluster().until([] { return false; }, 0.3);
  const auto at = rig.cluster().channels[0].machine;
  const auto executed = rig.cluster().feedback.first + rig.cluster().feedback.count;
  ASSERT_NEAR(at[0], 12.5, 1e-3);
  ASSERT_NO_FATAL_FAILURE(rig.strike(cell.service, cell.fault));
  const auto seen = rig.await(cell.service, cell.fault, false);
  expect_alarms(seen, expected);
  EXPECT_EQ(seen.executed_at_standstill, executed) << "no cycle was executed";
  rig.reset_alarms();
  rig.cluster().until([] { return false; }, 0.2);
  for (std::size_t i = 0; i < at.size(); ++i)
    // The servos settle for another while when periods pass.
    EXPECT_NEAR(rig.cluster().channels[0].machine[i], at[i], 1e-3) << "the position is kept";
  rig.go_home();
  rig.begin(), ++runs_;
  ASSERT_TRUE(rig.finish()) << rig.cluster().told();
  expect_on_path(rig, reference, true);
}

TEST_P(FaultMatrix, Cell) {
  const auto& cell = GetParam();
  FaultRig rig(cell.layout, cell.service == "gateway", given_domain());
  rig.store_keepsakes();
  const Rows reference = rig.undisturbed(runs_);
  ASSERT_GT(reference.size(), 10000u) << "the observer is too slow: nothing can be judged";
  if (cell.service == "recorder") {
    ASSERT_NO_FATAL_FAILURE(rig.start_recorder());
  }
  const auto expected = expectation(cell.service, cell.fault, cell.in_motion);
  if (cell.in_motion)
    in_motion(rig, reference, expected);
  else
    at_rest(rig, reference, expected);
  if (HasFatalFailure()) return;
  if (cell.service == "recorder") {
    EXPECT_GT(cell.fault == Fault::suspended ? rig.stop_recorder() : rig.recorded_messages(), 0u);
  }
  if (cell.service == "gateway") {
    EXPECT_EQ(http_client::request(rig.cluster().running().port, "GET", "/api/status").status, 200);
  }
  EXPECT_EQ(rig.kept_variable(501), runs_) << "each run has counted once";
  EXPECT_EQ(rig.kept_variable(502), 2 * runs_);
  rig.check_keepsakes();
}

std::string document() {
  return R"(# The fault matrix

Written by `make faults`, which causes the loss of every service in every way, on clusters of all Fast DDS, all Cyclone
DDS and both mixed, and checks each cell of these tables. The machine is ac-table in virtual time, feed 3000 mm/min.
Cycles are those that are still executed: from the one at which the channel detects the loss, or the drive the missing
setpoint, to the standstill. The channel's hold is what it writes ahead (000903, 512; in real time the lead, 32), two
setpoint batches (64 each; 4) and at most 0.1 s for the braking on the path.

- *killed*: SIGKILL. *terminated*: SIGTERM that the launcher did not send; the service ends in order, and the launcher
  treats it as a loss.
- *suspended*: SIGSTOP for 2 s. After 1.5 s without a heartbeat the launcher raises alarm 100; it would replace the
  process after 4 s.
- *restarts*: SIGKILL after each start. After the fifth run in succession shorter than 10 s: alarm 105.

In every cell: the cluster becomes ready without another restart; no parameter (active or waiting), tool, work offset,
stored program, kept variable or position is lost; every setpoint that is executed lies within 0.02 mm and degrees of
the undisturbed run, in its order, and the program reaches its end.
)" + matrix_document();
}

TEST(FaultMatrixDocument, IsWhatTheMatrixChecks) {
  const std::string path = TRUNNION_FAULT_DOCUMENT;
  if (std::getenv("TRUNNION_WRITE_FAULT_MATRIX") != nullptr) std::ofstream(path) << document();
  std::ifstream in(path);
  const std::string there((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(there, document()) << "run `make faults`";
}

INSTANTIATE_TEST_SUITE_P(Faults, FaultMatrix, testing::ValuesIn(all_cells()),
                         [](const auto& cell) { return cell.param.name(); });

}  // namespace
}  // namespace trunnion::integration
