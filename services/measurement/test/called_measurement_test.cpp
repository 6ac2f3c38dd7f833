// SPDX-License-Identifier: Apache-2.0
// A program that calls CYCLE9960.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_machine.hpp"

namespace trunnion::measurement {
namespace {

using idl::channel::ChannelRequest;
using idl::channel::CycleOutcome;
using idl::measurement::Operation;
using idl::parameters::ParameterRequest;
using testing::HasSubstr;

// The initial pose, A at -60 and 60, C at 120 and 240; it corrects.
const calibration::MacroVariables arguments_of_five_poses{
    {1, 11400}, {3, 1},  {4, 25}, {5, 0},      {6, -60},
    {7, 60},    {8, 3},  {9, 0},  {10, 0},     {11, 0},
    {12, 240},  {13, 3}, {14, 0}, {15, 0.001}, {16, measuring_path},
    {17, 2},    {18, 1}, {19, 1}, {20, 0},     {21, 1}};

calibration::MacroVariables with(std::uint32_t place, double value) {
  auto arguments = arguments_of_five_poses;
  arguments[place] = value;
  return arguments;
}

struct CalledMeasurement : ::testing::Test {
  std::unique_ptr<Measurement> core = std::make_unique<Measurement>(test_facts());
  FakeMachine machine{*core};

  void SetUp() override { machine.state.letters = "XYZAC"; }
  const MeasurementState& state() const { return core->stored().state; }
  const MeasurementResult& result() const { return core->stored().result; }
  void begin_again() {
    const auto text = machine.kept.back();
    core = std::make_unique<Measurement>(test_facts());
    machine.attach(*core);
    core->restore(parse_measurement(text));
  }
  const ParameterRequest* written() const {
    for (const auto& request : machine.requests)
      if (const auto* values = std::get_if<ParameterRequest>(&request)) return values;
    return nullptr;
  }
  bool commanded() const {
    return std::any_of(machine.requests.begin(), machine.requests.end(),
                       [](const auto& r) { return std::holds_alternative<ChannelRequest>(r); });
  }
};

TEST_F(CalledMeasurement, IsExecutedByTheProgramAndWritesWithoutAConfirmation) {
  machine.call_cycle(arguments_of_five_poses);
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::RECEIVED) << machine.reply.reason;
  ASSERT_TRUE(machine.run_program());
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::FINISHED) << machine.reply.reason;
  EXPECT_EQ(state().phase, Phase::FINISHED);
  EXPECT_EQ(state().complete, 5u);
  EXPECT_TRUE(state().written);
  EXPECT_FALSE(commanded()) << "no mode, no selection, no start";
  // The repeatability, two rounds of each pose, and the way up.
  EXPECT_EQ(machine.calls, 1 + 2 * 5 + 1u);
  ASSERT_NE(written(), nullptr);
  EXPECT_EQ(written()->who, "program part.nc line 7 calibrate");
  bool found = false;
  for (const auto& value : written()->values)
    if (value.number == 40433) {
      found = true;
      EXPECT_NEAR(value.value, machine.true_offset, 1e-5);
    }
  EXPECT_TRUE(found);
  EXPECT_FALSE(machine.stored.contains(part_program)) << "the parts are removed";
}

TEST_F(CalledMeasurement, MeasuresOnlyWhenItIsToldSo) {
  machine.call_cycle(with(1, 10400));
  ASSERT_TRUE(machine.run_program());
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::FINISHED) << machine.reply.reason;
  EXPECT_EQ(written(), nullptr);
  EXPECT_FALSE(result().protocol.empty());
}

TEST_F(CalledMeasurement, EndsTheProgramWhenAVectorIsBeyondTheToleranceAndMayBeConfirmed) {
  auto arguments = with(20, 10);
  arguments[15] = 0.05;  // the table is 0.1 mm beside its place
  machine.call_cycle(arguments);
  ASSERT_TRUE(machine.run_program());
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::REFUSED);
  EXPECT_THAT(machine.reply.reason, HasSubstr("nothing written: confirm or discard"));
  EXPECT_EQ(state().phase, Phase::WAITING);
  EXPECT_EQ(written(), nullptr);
  MeasurementRequest confirm;
  confirm.operation = Operation::CONFIRM;
  confirm.acknowledge = true;
  ASSERT_TRUE(machine.order(confirm).accepted);
  ASSERT_EQ(machine.run(), Phase::FINISHED);
  EXPECT_NE(written(), nullptr);
}

// The parameters of the kinematics are the builder's, also when somebody else measures within the tolerance.
TEST_F(CalledMeasurement, WritesOfAProgramOfASetterOnlyWhatABuilderConfirms) {
  machine.role = 1;
  machine.call_cycle(arguments_of_five_poses);
  ASSERT_TRUE(machine.run_program());
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::REFUSED);
  EXPECT_THAT(machine.reply.reason,
              HasSubstr("nothing written: the parameters of the kinematics need the role builder"));
  EXPECT_EQ(state().phase, Phase::WAITING);
  EXPECT_EQ(written(), nullptr);
  MeasurementRequest confirm;
  confirm.operation = Operation::CONFIRM;
  ASSERT_TRUE(machine.order(confirm).accepted);
  ASSERT_EQ(machine.run(), Phase::FINISHED);
  ASSERT_NE(written(), nullptr);
  EXPECT_EQ(written()->role, 2);
}

TEST_F(CalledMeasurement, NamesTheArgumentThatIsWrong) {
  machine.call_cycle(with(8, 13));
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::REFUSED);
  EXPECT_THAT(machine.reply.reason, HasSubstr("argument 8"));
  EXPECT_EQ(state().phase, Phase::NOTHING);
  machine.call_cycle(with(1, 11402));
  EXPECT_THAT(machine.reply.reason, HasSubstr("digit 2 of the ones"));
}

TEST_F(CalledMeasurement, RefusesAnotherOneMeanwhileAndIsRefusedMeanwhile) {
  machine.call_cycle(arguments_of_five_poses);
  machine.step();
  EXPECT_THAT(machine.order(Operation::START).reason, HasSubstr("a measurement is under way"));
  idl::channel::CycleRequest other;
  other.channel = 1, other.number = 4, other.cycle = 9960;
  core->call(other, "");
  const auto reply = core->take_reply();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->outcome, CycleOutcome::REFUSED);
  EXPECT_EQ(reply->channel, 1);
  ASSERT_TRUE(machine.run_program()) << "the first one goes on";
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::FINISHED) << machine.reply.reason;
}

TEST_F(CalledMeasurement, IsInterruptedWhenTheProgramEndsInAnyPart) {
  for (unsigned part = 1; part <= 12; ++part) {
    core = std::make_unique<Measurement>(test_facts());
    machine = FakeMachine(*core);
    machine.ends_in_call = part;
    machine.call_cycle(arguments_of_five_poses);
    ASSERT_TRUE(machine.run_program());
    ASSERT_EQ(machine.run(), Phase::INTERRUPTED) << part;
    EXPECT_THAT(state().error, HasSubstr("the program has ended before its end; nothing written, "));
    EXPECT_EQ(written(), nullptr);
    EXPECT_FALSE(state().may_continue);
    EXPECT_THAT(machine.order(Operation::CONTINUE).reason, HasSubstr("start that program again"));
    machine.ends_in_call = 0;
    machine.call_cycle(arguments_of_five_poses);
    ASSERT_TRUE(machine.run_program()) << "again, from the beginning";
    EXPECT_EQ(machine.reply.outcome, CycleOutcome::FINISHED) << machine.reply.reason;
  }
}

TEST_F(CalledMeasurement, NamesTheAlarmThatHasEndedTheProgram) {
  machine.ends_in_call = 4;
  machine.call_cycle(arguments_of_five_poses);
  machine.run_program();
  machine.raise(1501);
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_EQ(state().alarm, 1501u);
  EXPECT_THAT(state().error, HasSubstr("alarm 1501: cause"));
}

TEST_F(CalledMeasurement, IsRefusedWhenTheProcessEndsAtAnyInstant) {
  machine.call_cycle(arguments_of_five_poses);
  ASSERT_TRUE(machine.run_program());
  const auto instants = machine.kept;
  ASSERT_GT(instants.size(), 20u);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    core = std::make_unique<Measurement>(test_facts());
    machine = FakeMachine(*core);
    machine.call_cycle(arguments_of_five_poses);
    // As far as that instant: the program waits, or executes a part and asks then.
    for (int steps = 0; machine.kept.size() <= i && steps < 3000; ++steps) {
      machine.step();
      if (machine.reply.outcome == CycleOutcome::CALL && machine.calls_due()) machine.execute_part();
    }
    if (state().phase == Phase::FINISHED) break;
    const auto phase = state().phase;
    begin_again();
    const auto before = machine.requests.size();
    if (machine.calls_due())
      machine.execute_part();
    else
      machine.ask_again();
    for (int steps = 0; steps < 100; ++steps) machine.step();
    ASSERT_EQ(machine.reply.outcome, CycleOutcome::REFUSED) << i;
    if (phase != Phase::WRITING) {
      EXPECT_THAT(machine.reply.reason, HasSubstr("the measurement process has ended"));
      EXPECT_EQ(state().phase, Phase::INTERRUPTED) << i;
    }
    EXPECT_EQ(machine.requests.size(), before) << "nothing is asked of the machine";
  }
}

TEST_F(CalledMeasurement, StopsWhenAPartCannotBeStored) {
  machine.refused = 2;
  machine.call_cycle(arguments_of_five_poses);
  ASSERT_TRUE(machine.run_program());
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::REFUSED);
  EXPECT_THAT(machine.reply.reason, HasSubstr("refused; nothing written, 0 of 5 poses"));
}

TEST_F(CalledMeasurement, IsAbortedByAFeedHoldAndTheNextQuestionIsRefused) {
  machine.call_cycle(arguments_of_five_poses);
  for (int i = 0; i < 100 && machine.reply.outcome != CycleOutcome::CALL; ++i) machine.step();
  machine.state.state = idl::channel::RunState::RUNNING;
  machine.endless = true;
  ASSERT_TRUE(machine.order(Operation::ABORT).accepted);
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_EQ(std::get<ChannelRequest>(machine.requests.back()).command, idl::channel::CommandKind::FEED_HOLD);
  machine.execute_part();  // cycle start instead of a reset
  EXPECT_EQ(machine.reply.outcome, CycleOutcome::REFUSED);
  EXPECT_THAT(machine.reply.reason, HasSubstr("aborted"));
}

}  // namespace
}  // namespace trunnion::measurement
