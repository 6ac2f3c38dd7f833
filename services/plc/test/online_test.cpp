// SPDX-License-Identifier: Apache-2.0
// Programs that are changed while they run: forces, programs that take over.
#include <gtest/gtest.h>

#include <random>

#include "program_load.hpp"
#include "round_recorder.hpp"
#include "running_core.hpp"
#include "standby_comparison.hpp"

namespace trunnion::plc {
namespace {

using idl::plc::OnlineAction;
using idl::plc::OnlineRequest;

TEST(Forces, KeepTheirValueAgainstTheProgramAndTheInputsUntilTheyAreReleased) {
  Running plc(counting);
  EXPECT_EQ(plc.force("main.list[2]", "-4"), "");
  EXPECT_EQ(plc.force("%X16.1", "TRUE"), "");
  EXPECT_EQ(plc.force("%Y16.0", "1"), "");
  EXPECT_EQ(plc.force("%W50", "16#FFFF"), "");
  plc.pass(25);
  plc.input(16, 0);  // the switch is off, the input stays on
  plc.pass(25);
  EXPECT_EQ(plc.value("main.list[2]"), "-4");
  EXPECT_EQ(plc.value("%X16.1"), "TRUE");
  EXPECT_EQ(plc.value("%Y17.0"), "TRUE") << "the program sees the forced input";
  EXPECT_EQ(plc.value("%Y16.0"), "TRUE");
  EXPECT_EQ(plc.value("%W50"), "65535");
  const auto shown = forces_of(plc.core.memory(), plc.variables);
  ASSERT_EQ(shown.values.size(), 4u);
  EXPECT_EQ(shown.values[0].path + " " + shown.values[0].type + " " + shown.values[0].value,
            "main.list[2] INT -4");
  EXPECT_EQ(shown.values[1].path + " " + shown.values[1].value, "%X16.1 TRUE");

  EXPECT_EQ(plc.release({"main.list[2]", "%Y16.0"}), "");
  plc.input(16, 0);
  plc.pass(25);
  EXPECT_EQ(plc.value("main.list[2]"), "7");
  EXPECT_EQ(plc.value("%Y16.0"), "FALSE");
  EXPECT_EQ(plc.value("%X16.1"), "TRUE");
  EXPECT_EQ(plc.release({}), "");
  plc.input(16, 0);
  plc.pass(25);
  EXPECT_EQ(plc.value("%Y17.0"), "FALSE");
  EXPECT_EQ(plc.core.memory().forces.count, 0u);
}

TEST(Forces, AreRefusedAsAWholeInOneLine) {
  Running plc(counting);
  EXPECT_EQ(plc.force("main.most", "1"), "'main.most': it is a constant");
  EXPECT_EQ(plc.force("main.none", "1"), "'main.none': there is no such variable");
  EXPECT_EQ(plc.force("main.timer", "1"), "'main.timer': it is TON; name one of its elements");
  EXPECT_EQ(plc.force("main.limit", "TRUE"),
            "'main.limit': 'TRUE' is no INT: write a whole number -32768 .. 32767");
  EXPECT_EQ(plc.force("%X16.1", "5"), "'%X16.1': '5' is no BOOL: write TRUE or FALSE");
  EXPECT_EQ(plc.release({"%X16.1"}), "'%X16.1': it is not forced");
  OnlineRequest both;
  both.action = OnlineAction::FORCE;
  both.paths = {"main.limit", "main.none"}, both.values = {"1", "1"};
  EXPECT_NE(change_forces(both, plc.variables, plc.core), "");
  EXPECT_EQ(plc.core.memory().forces.count, 0u);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(plc.force("%R" + std::to_string(i), "1"), "");
  EXPECT_EQ(plc.force("%R64", "1"), "64 values are forced; at most 64 can be");
  EXPECT_EQ(plc.force("%R5", "2"), "") << "another value of one that is forced";
}

TEST(Forces, SurviveAKillAndEndWithTheStartOfTheClusterUnlessTheyArePermanent) {
  Running plc(counting);
  EXPECT_EQ(plc.force("main.limit", "1"), "");
  EXPECT_EQ(plc.force("%X16.1", "TRUE", true), "");
  plc.pass(10);
  const auto kept = plc.core.memory();

  Running killed(counting);
  killed.core.restore(kept);
  killed.pass(30);
  EXPECT_EQ(killed.value("main.limit"), "1");
  EXPECT_EQ(killed.value("%X16.1"), "TRUE");

  Running started(counting);
  started.core.power_up(kept);
  started.pass(30);
  EXPECT_EQ(started.value("main.limit"), "7");
  EXPECT_EQ(started.value("%X16.1"), "TRUE");
  EXPECT_EQ(started.core.memory().forces.count, 1u);
}

TEST(Forces, OfVariablesEndWithOtherPrograms) {
  Running plc(counting);
  EXPECT_EQ(plc.force("main.limit", "1"), "");
  EXPECT_EQ(plc.force("%X16.1", "TRUE"), "");
  Running other("PROGRAM main VAR a, b : LREAL; END_VAR a := b; END_PROGRAM");
  other.core.restore(plc.core.memory());
  EXPECT_EQ(other.core.memory().forces.count, 1u);
}

TEST(Forces, AreRepeatedByAPlcOnStandby) {
  Running plc(counting);
  const auto p = std::make_shared<machine::Parameters>(axis_parameters());
  StandbyComparison standby(programs_of(counting), true, [&](std::uint64_t) { return p; });
  RoundRecorder rounds;
  ASSERT_TRUE(rounds.begin_round(1, plc.core, 1));
  ASSERT_EQ(standby.play(rounds.first_round(), 1), StandbyComparison::Outcome::equal) << standby.difference();
  OnlineRequest request;
  request.action = OnlineAction::FORCE;
  request.paths = {"main.limit"}, request.values = {"12"};
  ASSERT_EQ(change_forces(request, plc.variables, plc.core), "");
  rounds.record(StepKind::ONLINE_REQUEST, request);
  plc.pass(20);
  rounds.record(StepKind::ADVANCE, plc.core.memory().tick);
  EXPECT_EQ(standby.play(rounds.end_round(plc.core, {}), 1), StandbyComparison::Outcome::equal)
      << standby.difference();
}

// A timer that has run for 400 ms ends 600 ms after the change.
TEST(TakingOver, KeepsVariablesTimersRegistersAndForces) {
  Running plc(counting);
  plc.input(16, 1);
  EXPECT_EQ(plc.force("main.limit", "12"), "");
  plc.pass(400);
  const auto hours = plc.value("main.hours");
  auto text = std::string(counting);
  text.replace(text.find("scans : UDINT"), 13, "begin, new : INT := 5; scans : UDINT");
  text.replace(text.find("%Y16.0 := timer.Q"), 17, "%Y20.0 := timer.Q");
  auto next = programs_of(text);
  const st::Changeover change(plc.variables, next.variables);
  EXPECT_EQ(change.losses().size(), 2u);
  const auto old_variables = plc.variables;
  plc.variables = next.variables;
  plc.core.take_over(next, change);
  EXPECT_EQ(plc.value("main.hours"), hours);
  EXPECT_EQ(plc.value("main.new"), "5");
  EXPECT_EQ(plc.value("main.limit"), "12");
  plc.pass(590);
  EXPECT_EQ(plc.value("%Y20.0"), "FALSE");
  plc.pass(20);
  EXPECT_EQ(plc.value("%Y20.0"), "TRUE");
  EXPECT_EQ(plc.value("main.list[2]"), "12");
  // Undone: `next` has what ran before.
  const st::Changeover back(plc.variables, old_variables);
  plc.variables = old_variables;
  plc.core.take_over(next, back);
  plc.pass(20);
  EXPECT_EQ(plc.value("%Y16.0"), "TRUE");
}

TEST(Comparison, OfTheSameProgramsFindsNothingWhateverHappens) {
  Running plc(counting);
  auto next = programs_of(counting);
  const st::Changeover change(plc.variables, next.variables);
  EXPECT_TRUE(change.losses().empty());
  OnlineComparison comparison(plc.core, std::move(next), change);
  std::mt19937 random(5);
  const auto both = [&](auto act) { act(plc.core), act(comparison.core()); };
  for (int i = 0; i < 500; ++i) {
    idl::plc::PanelRequest request;
    request.kind = idl::plc::PanelRequestKind::FORCE_INPUT;
    request.address = 16, request.value = random() % 4;
    both([&](PlcCore& core) { core.panel(request); });
    const auto tick = plc.core.memory().tick + random() % 300;
    both([&](PlcCore& core) { core.advance(tick); });
    comparison.compare(plc.core, plc.core.take_done());
  }
  EXPECT_EQ(comparison.differences(), 0u) << testing::PrintToString(comparison.lines());
  EXPECT_GT(comparison.scans(), 1000u);
}

TEST(Comparison, NamesEachRegisterAndVariableThatDiffersOnce) {
  Running plc(counting);
  plc.pass(20);
  auto text = std::string(counting);
  text.replace(text.find("%Y17.0 := %X16.1"), 16, "%Y17.0 := NOT %X16.1");
  auto next = programs_of(text);
  const st::Changeover changeover(plc.variables, next.variables);
  OnlineComparison comparison(plc.core, std::move(next), changeover);
  // At rest it is found before anything happens: what one more scan would change.
  ASSERT_EQ(comparison.differences(), 1u) << testing::PrintToString(comparison.lines());
  EXPECT_EQ(comparison.lines()[0], "tick 1020, register Y17: 0 and 1");
}

TEST(ProgramLoad, GoesThroughItsPhasesAndSaysWhatIsNotKept) {
  Running plc(counting);
  ProgramLoad load;
  EXPECT_NE(load.write("main.st", "x"), "");
  EXPECT_NE(load.start_compiling(), "");
  load.begin();
  EXPECT_EQ(load.write("../main.st", "x").substr(0, 12), "'../main.st'");
  EXPECT_NE(load.write("main_test.st", "x"), "");
  EXPECT_EQ(load.write("fast.st", empty_fast), "");
  EXPECT_EQ(load.write("main.st", "PROGRAM main VAR limit"), "");
  EXPECT_EQ(load.write("main.st", " : DINT; END_VAR limit := 1; END_PROGRAM"), "");
  EXPECT_EQ(load.may_take_over(true), "no programs are ready to take over");
  EXPECT_EQ(load.start_compiling(), "");
  load.translated(translated(load.files(), true, {plc.variables, {}}));
  EXPECT_EQ(load.phase(), ProgramLoad::Phase::COMPILED);
  const auto messages = load.status(0).messages;
  EXPECT_NE(std::find(messages.begin(), messages.end(),
                      "main.limit (INT) becomes DINT: it begins with its initial value"),
            messages.end());
  EXPECT_NE(std::find(messages.begin(), messages.end(),
                      "main.hours (UDINT, RETAIN) is not in the new programs: its value is lost"),
            messages.end());
  EXPECT_EQ(load.may_take_over(false), "the programs have not been compared");
  EXPECT_EQ(load.start_comparing(plc.core), "");
  EXPECT_NE(load.may_take_over(false), "");
  EXPECT_EQ(load.may_take_over(true), "");
}

TEST(ProgramLoad, WithErrorsNothingTakesOver) {
  Running plc(counting);
  ProgramLoad load;
  load.begin();
  EXPECT_EQ(load.write("fast.st", empty_fast), "");
  EXPECT_EQ(load.write("main.st", "PROGRAM main\nlamp := TRUE;\nmore := 1;\nEND_PROGRAM\n"), "");
  EXPECT_EQ(load.start_compiling(), "");
  load.translated(translated(load.files(), true, {plc.variables, {}}));
  EXPECT_EQ(load.phase(), ProgramLoad::Phase::WITH_ERRORS);
  EXPECT_EQ(load.status(0).messages,
            (std::vector<std::string>{"main.st:2:1: error: there is no variable 'lamp'",
                                      "main.st:3:1: error: there is no variable 'more'"}));
  EXPECT_EQ(load.may_take_over(true), "the programs have errors");
  EXPECT_EQ(load.start_comparing(plc.core), "the programs have errors");
}

}  // namespace
}  // namespace trunnion::plc
