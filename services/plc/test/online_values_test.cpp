// SPDX-License-Identifier: Apache-2.0
// Values of programs that run: traces, watch lists, lists of variables.
#include "online_values.hpp"

#include <gtest/gtest.h>

#include <random>

#include "plc/online/shown_variables.hpp"
#include "running_core.hpp"

namespace trunnion::plc {
namespace {

using idl::plc::OnlineAction;
using idl::plc::OnlineRequest;
using idl::plc::TraceCondition;

OnlineRequest trace_of(std::vector<std::string> paths, std::uint32_t scans) {
  OnlineRequest request;
  request.client = 5;
  request.action = OnlineAction::START_TRACE;
  request.paths = std::move(paths), request.scans = scans;
  return request;
}

std::vector<std::uint64_t> rows_of(OnlineValues& values, PlcCore& core, std::size_t width) {
  std::vector<std::uint64_t> cells;
  OnlineRequest read;
  read.client = 5;
  read.action = OnlineAction::READ_TRACE;
  for (;;) {
    read.first = static_cast<std::uint32_t>(cells.size() / width);
    const auto reply = values.answer(read, core, 0);
    EXPECT_TRUE(reply.accepted) << reply.reason;
    if (reply.cells.empty()) return cells;
    cells.insert(cells.end(), reply.cells.begin(), reply.cells.end());
  }
}

// The program counts its own scans, so a scan that is not in the trace is a step of more than one. Inputs
// come at random, each makes the scans until the registers are stable.
TEST(Trace, HasEveryScanOnceAndNoOther) {
  Running plc(
      "PROGRAM main VAR none : INT; END_VAR none := 0; END_PROGRAM PROGRAM other VAR END_VAR END_PROGRAM");
  const std::string fast =
      "PROGRAM fast\nVAR n : UDINT; END_VAR\nIF %R0 < 3 OR %X16 <> %R1 THEN n := n + 1; %R0 := %R0 + 1; %R1 "
      ":= "
      "%X16; ELSE n := n + 1; END_IF;\nEND_PROGRAM\n";
  auto programs = translate({{"fast.st", fast}, {"main.st", "PROGRAM main\nEND_PROGRAM\n"}}, true);
  plc.variables = programs.variables;
  plc.core.load(std::move(programs));
  OnlineValues values(plc.variables);
  std::mt19937 random(3);
  plc.pass(7);
  ASSERT_TRUE(values.answer(trace_of({"fast.n", "%X16"}, 3000), plc.core, 0).accepted);
  const auto first = std::stoul(plc.value("fast.n")) + 1;
  for (int i = 0; i < 2000 && std::stoul(plc.value("fast.n")) < first + 3200; ++i) {
    if (random() % 3 == 0) plc.input(16, random() % 256);
    plc.pass(random() % 4);
  }
  const auto cells = rows_of(values, plc.core, 4);
  ASSERT_EQ(cells.size(), 3000u * 4);
  for (std::size_t row = 0; row < 3000; ++row) {
    ASSERT_EQ(cells[row * 4 + 2], first + row);
    if (row > 0) {
      EXPECT_GE(cells[row * 4], cells[row * 4 - 4]);
    }
  }
}

TEST(Trace, BeginsWithTheScanAfterWhichItsConditionIsTrue) {
  const struct {
    TraceCondition condition;
    const char* value;
    std::uint64_t first;
  } cases[] = {{TraceCondition::EQUAL, "30", 30},
               {TraceCondition::GREATER, "30", 31},
               {TraceCondition::NOT_EQUAL, "19", 20},
               {TraceCondition::LESS, "-1000000", 0}};
  for (const auto& one : cases) {
    Running plc("PROGRAM main VAR n : DINT := 19; END_VAR n := n + 1; END_PROGRAM");
    plc.core.load(programs_of("PROGRAM main VAR n : DINT := 19; END_VAR n := n + 1; END_PROGRAM"));
    OnlineValues values(plc.variables);
    auto request = trace_of({"main.n"}, 5);
    request.condition = one.condition, request.condition_path = "main.n", request.condition_value = one.value;
    const auto reply = values.answer(request, plc.core, 0);
    ASSERT_TRUE(reply.accepted) << reply.reason;
    plc.pass(400);
    const auto cells = rows_of(values, plc.core, 3);
    if (one.first == 0) {
      EXPECT_TRUE(cells.empty());
      continue;
    }
    ASSERT_EQ(cells.size(), 15u);
    // The main task counts in every tenth scan of the fast one, or in each until the registers are stable.
    EXPECT_EQ(cells[2], one.first);
  }
}

TEST(Trace, IsRefusedWhenItIsTooLongOrItsConditionIsNoValueOfTheVariable) {
  Running plc(counting);
  OnlineValues values(plc.variables);
  // Three cells to a row, 1,000,000 in all.
  EXPECT_EQ(values.answer(trace_of({"main.limit"}, 333334), plc.core, 0).reason,
            "333334 scans: with these variables a trace has 1 .. 333333");
  auto request = trace_of({"main.limit"}, 10);
  request.condition = TraceCondition::LESS, request.condition_path = "main.limit",
  request.condition_value = "x";
  EXPECT_EQ(values.answer(request, plc.core, 0).reason,
            "'main.limit': 'x' is no INT: write a whole number -32768 .. 32767");
  OnlineRequest read;
  read.action = OnlineAction::READ_TRACE;
  EXPECT_FALSE(values.answer(read, plc.core, 0).accepted);
}

OnlineRequest watch_of(std::uint64_t client, std::vector<std::string> paths) {
  OnlineRequest request;
  request.client = client;
  request.action = OnlineAction::WATCH;
  request.paths = std::move(paths);
  return request;
}

TEST(Watch, GivesTheValuesOfElementsWithTypeUnitAndMark) {
  Running plc(counting);
  OnlineValues values(plc.variables);
  EXPECT_EQ(plc.force("main.list[3]", "9"), "");
  plc.pass(10);
  const auto reply =
      values.answer(watch_of(1, {"main.list", "spindle_speed_0", "main.timer.PT"}), plc.core, 0);
  ASSERT_TRUE(reply.accepted) << reply.reason;
  ASSERT_EQ(reply.variables.size(), 5u);
  EXPECT_EQ(reply.variables[1].path, "main.list[2]");
  EXPECT_EQ(reply.variables[1].type, "INT");
  EXPECT_EQ(reply.variables[3].unit, "1/min");
  EXPECT_EQ(reply.variables[4].kind, idl::plc::ValueKind::DURATION_VALUE);
  const auto* sample = values.watched(reply.slot, plc.core.memory());
  ASSERT_NE(sample, nullptr);
  EXPECT_EQ(sample->cells, (std::vector<std::uint64_t>{0, 7, 9, 0, 1000000000}));
  EXPECT_EQ(sample->forced, std::vector<std::uint16_t>{2});
  EXPECT_EQ(values.watched(reply.slot, plc.core.memory()), nullptr) << "nothing has changed";
}

TEST(Watch, EndsWithoutRepetitionAndHasEightPlaces) {
  Running plc(counting);
  OnlineValues values(plc.variables);
  for (std::uint64_t client = 1; client <= 8; ++client)
    EXPECT_EQ(values.answer(watch_of(client, {"main.limit"}), plc.core, 0).slot, client - 1);
  EXPECT_EQ(values.answer(watch_of(9, {"main.limit"}), plc.core, 0).reason,
            "8 clients watch variables already; end one of them");
  EXPECT_TRUE(values.answer(watch_of(3, {"main.scans"}), plc.core, 4).accepted);
  values.expire(6);  // all but that of 4 s
  EXPECT_EQ(values.answer(watch_of(9, {"main.limit"}), plc.core, 6).slot, 0);
  const auto* other = values.watched(2, plc.core.memory());
  ASSERT_NE(other, nullptr);
  EXPECT_EQ(other->client, 3u);
  const auto* freed = values.watched(5, plc.core.memory());
  ASSERT_NE(freed, nullptr);
  EXPECT_EQ(freed->client, 0u);
}

TEST(Variables, AreListedInPartsAndByPrefix) {
  Running plc(counting);
  OnlineValues values(plc.variables);
  OnlineRequest request;
  request.action = OnlineAction::LIST_VARIABLES;
  const auto all = values.answer(request, plc.core, 0);
  EXPECT_EQ(all.total, plc.variables.all().size());
  request.first = 3;
  EXPECT_EQ(values.answer(request, plc.core, 0).variables[0], all.variables[3]);
  request = {};
  request.paths = {"main.li"};
  EXPECT_EQ(values.answer(request, plc.core, 0).total, 4u);  // limit and the three of list
}

// 1000 statements, 200 to a scan: five scans for one run of the main task, here of 1 ms each, and one more at
// each time until the registers are stable would not be deterministic, so nothing else changes meanwhile.
TEST(MainTask, IsSpreadOverScansAndComesToTheSameResult) {
  std::string text = "PROGRAM main\nVAR n : DINT; runs : UDINT; END_VAR\n";
  for (int i = 0; i < 998; ++i) text += "n := n + 1;\n";
  text += "runs := runs + 1;\nEND_PROGRAM\n";
  auto p = axis_parameters();
  p.values[2] = {200, ""};
  Running plc(text);
  plc.core.configure(p, true);
  plc.core.load(programs_of(text));
  OnlineValues values(plc.variables);
  ASSERT_TRUE(values.answer(trace_of({"main.n", "main.runs"}, 60), plc.core, 0).accepted);
  plc.pass(100);
  const auto cells = rows_of(values, plc.core, 4);
  ASSERT_EQ(cells.size(), 60u * 4);
  std::uint64_t in_one_run = 0;
  for (std::size_t row = 1; row < 60; ++row) {
    const auto before = cells[row * 4 - 2], n = cells[row * 4 + 2];
    EXPECT_LE(n - before, 200u);
    if (cells[row * 4 + 3] == cells[row * 4 - 1]) {
      EXPECT_TRUE(n == before || n - before == 200 || n % 998 == 200 % 998);
      continue;
    }
    in_one_run = n;
    EXPECT_EQ(n % 998, 0u) << "a run that has ended has counted to a multiple of 998";
  }
  EXPECT_GT(in_one_run, 0u);
}

// Clients know no types: without a name they would show the cell of NULL, 9223372036854775808.
TEST(Watch, NamesTheReferenceToNothing) {
  Running plc("PROGRAM main VAR x : INT; p, q : REF_TO INT; END_VAR q := REF(x); END_PROGRAM");
  const auto p = plc.variables.find("main.p"), q = plc.variables.find("main.q"),
             x = plc.variables.find("main.x");
  const std::vector<idl::plc::VariableInfo> infos = {info_of(p), info_of(q)};
  const plc_online::ShownVariables shown(infos);
  const std::vector<std::uint64_t> cells = {st::null_reference, x.address};
  EXPECT_EQ(shown.texts(cells), (std::vector<std::string>{"NULL", std::to_string(x.address)}));
}

}  // namespace
}  // namespace trunnion::plc
