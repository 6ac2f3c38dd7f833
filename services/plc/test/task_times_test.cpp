// SPDX-License-Identifier: Apache-2.0
#include "task_times.hpp"

#include <gtest/gtest.h>

#include "running_core.hpp"

namespace trunnion::plc {
namespace {

std::uint64_t now = 0;  // ns, of the test's clock

std::uint64_t reading() { return now; }
/// Each reading is 1 us after the one before.
std::uint64_t ticking() { return now += 1000; }

const plc_online::TaskTime& of(const std::vector<plc_online::TaskTime>& times, const std::string& name) {
  static const plc_online::TaskTime none;
  for (const auto& time : times)
    if (time.name == name) return time;
  ADD_FAILURE() << "there is no task " << name;
  return none;
}

TEST(TaskTimes, HaveTheLastAndTheWorstOfEachTaskAndOfTheScan) {
  TaskTimes times(reading);
  const auto scan = [&](std::uint64_t fast, std::uint64_t main) {
    now += 5000;
    times.begin_scan();
    times.begin_task();
    now += fast;
    times.end_task(TaskName::fast, 3);
    now += 100;  // between the tasks: part of the scan
    if (main > 0) {
      times.begin_task();
      now += main;
      times.end_task(TaskName::main, main / 100);
    }
    times.end_scan();
  };
  scan(2000, 9000), scan(4000, 0), scan(1000, 3000);
  const auto shown = times.shown({100000, 200, 100000});
  ASSERT_EQ(shown.size(), 3u);
  EXPECT_EQ(shown[0], (plc_online::TaskTime{"scan", 3, 4100, 11100, scan_period_ns, 33, 93, 0}));
  EXPECT_EQ(shown[1], (plc_online::TaskTime{"fast", 3, 1000, 4000, scan_period_ns, 3, 3, 100000}));
  EXPECT_EQ(shown[2], (plc_online::TaskTime{"main", 2, 3000, 9000, scan_period_ns, 30, 90, 200}));
  times.reset();
  EXPECT_TRUE(times.shown({}).empty());
}

TEST(TaskTimes, CountTheStatementsOfAScanOfStructuredText) {
  TaskTimes times(ticking);
  // A loop of 300 assignments with a test of its end each: 200 statements in one scan, the rest in the next
  // ones.
  Running running(
      "PROGRAM main\nVAR i, s : INT; END_VAR\nFOR i := 1 TO 300 DO s := s + 1; END_FOR;\nEND_PROGRAM\n");
  auto parameters = axis_parameters();
  parameters.values[2] = {200, ""};
  running.core.configure(parameters, true);
  running.core.set_task_times(&times);
  running.pass(100);
  const auto shown = times.shown(running.core.statement_budgets());
  EXPECT_EQ(of(shown, "main").most_statements, 200u);
  EXPECT_EQ(of(shown, "main").statement_budget, 200u);
  EXPECT_EQ(of(shown, "fast").statement_budget, 100000u);
  // Every scan has the fast task; the clock is read at its begin and its end.
  EXPECT_GE(of(shown, "fast").runs, 100u);
  EXPECT_EQ(of(shown, "fast").runs, of(shown, "scan").runs);
  EXPECT_EQ(of(shown, "fast").worst_ns, 1000u);
}

TEST(TaskTimes, ChangeNothingOfWhatThePlcDoes) {
  TaskTimes times(ticking);
  Running measured(counting), plain(counting);
  measured.core.set_task_times(&times);
  for (auto* one : {&measured, &plain}) one->input(16, 1), one->pass(500), one->input(16, 3), one->pass(500);
  EXPECT_EQ(measured.core.memory().registers, plain.core.memory().registers);
  EXPECT_EQ(measured.core.memory().program, plain.core.memory().program);
  EXPECT_EQ(measured.core.outputs(), plain.core.outputs());
  const auto runs = of(times.shown({}), "fast").runs;
  (void)measured.core.rescanned();
  EXPECT_EQ(of(times.shown({}), "fast").runs, runs) << "a copy that only computes is not measured";
}

}  // namespace
}  // namespace trunnion::plc
