// SPDX-License-Identifier: Apache-2.0
// A program that calls a cycle which another service carries out.
#include <gmock/gmock.h>

#include "channel_fixture.hpp"
#include "machine/alarm_constants.hpp"

namespace trunnion::channel {
namespace {

using idl::channel::CommandKind;
using testing::Channel;
using ::testing::HasSubstr;

struct CycleOfAService : Channel {
  std::vector<CycleRequest> told;

  void SetUp() override {
    Channel::SetUp();
    core->set_cycle_service(true);
  }
  void go(int rounds = 200) {
    for (int i = 0; i < rounds; ++i) {
      round();
      if (const auto request = core->take_cycle_request()) told.push_back(*request);
    }
  }
  void reply(CycleOutcome outcome, const std::string& reason = "", std::uint64_t revision = 0) {
    CycleReply answer;
    answer.number = told.back().number;
    answer.outcome = outcome, answer.reason = reason, answer.revision = revision;
    if (outcome == CycleOutcome::CALL) answer.program = "O99601.tmp.nc";
    core->on_cycle_reply(answer);
  }
  void begin_program(const std::string& program) {
    load(program);
    ask(CommandKind::CYCLE_START);
    go();
    ASSERT_FALSE(told.empty());
    ASSERT_EQ(told.back().caller, CycleCaller::ASKS);
  }
  double x() const { return drive.rows.back()[0]; }
};

TEST_F(CycleOfAService, IsAskedForAtRestWithPlaceVariablesAndPosition) {
  begin_program("G90 G1 X10 F6000\nG65 P9010 A3\nG1 X20\nM30\nO9010\n#52151=7\n#52999=2\n#3100=9960\nM99\n");
  const auto& request = told.back();
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  EXPECT_EQ(core->state().detail, "waits for the measurement of the kinematics");
  EXPECT_EQ(request.cycle, 9960u);
  EXPECT_EQ(request.program, "part.nc");
  EXPECT_EQ(request.role, 1) << "a setter's";
  EXPECT_EQ(request.line, 2u);
  ASSERT_EQ(request.machine.size(), 9u);
  EXPECT_EQ(request.machine[0], 10);
  EXPECT_EQ(request.numbers, (std::vector<std::uint32_t>{1, 52151, 52999}));
  EXPECT_EQ(request.values, (std::vector<double>{3, 7, 2}));
  EXPECT_EQ(x(), 10) << "nothing behind it moves";
  EXPECT_TRUE(core->cycle_unheard());
  reply(CycleOutcome::RECEIVED);
  EXPECT_FALSE(core->cycle_unheard());
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  reply(CycleOutcome::FINISHED);
  go();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(x(), 20);
  EXPECT_EQ(told.back().caller, CycleCaller::ENDED);
}

TEST_F(CycleOfAService, TheMacroOfCYCLE9960CallsThePartsAndLeavesTheModalStateAsItWas) {
  begin_program("G91 G1 X5 F600\nCYCLE9960(11400)\nX3\nM30\n");
  EXPECT_EQ(told.back().cycle, 9960u);
  EXPECT_EQ(told.back().line, 2u);
  subprograms["O99601.tmp.nc"] = {"G90 G61 F3000\nG1 X50\n#52999=1\nM99\n", 1};
  reply(CycleOutcome::CALL, "", 1);
  go();
  EXPECT_EQ(x(), 5) << "the list of programs has not come yet";
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  store();
  go();
  EXPECT_EQ(x(), 50);
  EXPECT_EQ(told.back().cycle, 0u);
  EXPECT_EQ(told.back().values.back(), 1);

  // The text of before must not be read again.
  subprograms["O99601.tmp.nc"] = {"G90\nG1 X60\n#52999=2\nM99\n", 2};
  reply(CycleOutcome::CALL, "", 2);
  go();
  EXPECT_EQ(x(), 50);
  store();
  go();
  EXPECT_EQ(x(), 60);
  EXPECT_EQ(told.back().values.back(), 2);
  reply(CycleOutcome::FINISHED);
  go();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(x(), 63) << "G91 again";
}

TEST_F(CycleOfAService, ARefusalEndsTheProgramWithTheReason) {
  begin_program("CYCLE9960(11400)\nG1 X20 F6000\nM30\n");
  reply(CycleOutcome::REFUSED, "argument 4 is wrong");
  const auto reported = core->take_events();
  ASSERT_FALSE(reported.empty());
  EXPECT_EQ(reported.back().alarm, &alarm::cycle_refused);
  EXPECT_EQ(reported.back().text, "part.nc:1: argument 4 is wrong");
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  go();
  EXPECT_EQ(told.back().caller, CycleCaller::ENDED);
  EXPECT_TRUE(drive.rows.empty());
}

TEST_F(CycleOfAService, OnlyTheReplyToTheOpenCallCounts) {
  begin_program("#3100=1\n#3100=2\nM30\n");
  CycleReply other;
  other.number = told.back().number - 1, other.outcome = CycleOutcome::REFUSED;
  core->on_cycle_reply(other);
  other.number += 1, other.channel = 1;
  core->on_cycle_reply(other);
  EXPECT_EQ(core->run_state(), RunState::WAITING);
  reply(CycleOutcome::FINISHED);
  go();
  EXPECT_EQ(told.back().cycle, 2u);
  EXPECT_EQ(told.back().caller, CycleCaller::ASKS);
}

TEST_F(CycleOfAService, AResetTellsTheServiceAndTheNextCallCountsOn) {
  begin_program("#3100=1\nM30\n");
  const auto first = told.back().number;
  ask(CommandKind::RESET);
  go();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_EQ(told.back().caller, CycleCaller::ENDED);
  reply(CycleOutcome::REFUSED, "too late");
  EXPECT_TRUE(core->take_events().empty());
  begin_program("#3100=1\nM30\n");
  EXPECT_GT(told.back().number, first);
}

TEST_F(CycleOfAService, WithoutTheServiceOrItsSignTheProgramEnds) {
  core->set_cycle_service(false);
  load("G1 X1 F6000\nCYCLE9960(11400)\nM30\n");
  ask(CommandKind::CYCLE_START);
  go();
  ASSERT_FALSE(events.empty());
  EXPECT_THAT(events.back().text, HasSubstr("part.nc:2: this machine has no service `measurement`"));
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_TRUE(told.empty());

  core->set_cycle_service(true);
  begin_program("CYCLE9960(11400)\nM30\n");
  core->give_up_cycle();
  const auto reported = core->take_events();
  ASSERT_FALSE(reported.empty());
  EXPECT_THAT(reported.back().text, HasSubstr("does not answer"));
  EXPECT_EQ(core->run_state(), RunState::IDLE);
}

TEST_F(CycleOfAService, AProgramBehindItIsNotRestarted) {
  begin_program("#3100=1\nG91\nG1 X100 F600\nM30\n");
  cycles_per_round = 8;
  reply(CycleOutcome::FINISHED);
  go();
  drive.forget();
  go(1);
  ASSERT_EQ(core->run_state(), RunState::INTERRUPTED);
  const double left = x();
  ASSERT_TRUE(ask(CommandKind::CYCLE_START).accepted);
  go();
  EXPECT_EQ(core->run_state(), RunState::IDLE);
  EXPECT_THAT(events.back().text, HasSubstr("cannot be resumed"));
  EXPECT_NEAR(x(), left, 1e-9);
}

}  // namespace
}  // namespace trunnion::channel
