// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_machine.hpp"
#include "machine/parameter_constants.hpp"

namespace trunnion::measurement {
namespace {

using idl::channel::ChannelRequest;
using idl::channel::CommandKind;
using idl::measurement::Operation;
using idl::parameters::ParameterRequest;
using testing::HasSubstr;

// The shaft of the sphere is below it; five poses.
const std::string five_poses =
    "mode: correct\nsphere: {shaft: [0, 0, -1]}\naxes:\n"
    "  A: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0}\n"
    "  C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}\n";

struct MeasurementCore : ::testing::Test {
  std::unique_ptr<Measurement> core = std::make_unique<Measurement>(test_facts());
  FakeMachine machine{*core};

  const MeasurementState& state() const { return core->stored().state; }
  const MeasurementResult& result() const { return core->stored().result; }
  void begin() {
    const auto reply = machine.measure(five_poses);
    ASSERT_TRUE(reply.accepted) << reply.reason;
  }
  void begin_again() {
    core = std::make_unique<Measurement>(test_facts());
    machine.attach(*core);
  }
  bool wrote() const {
    return std::any_of(machine.requests.begin(), machine.requests.end(),
                       [](const auto& r) { return std::holds_alternative<ParameterRequest>(r); });
  }
  double found(std::uint32_t number) const {
    for (const auto& change : result().changes)
      if (change.number == number) return change.after;
    return std::nan("");
  }
};

TEST_F(MeasurementCore, FindsTheOffsetOfTheTableAndWritesItOnConfirmation) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING) << state().error;
  EXPECT_EQ(state().complete, 5);
  EXPECT_LT(state().repeatability, 1e-9);
  EXPECT_NEAR(found(40433), machine.true_offset, 1e-5);
  EXPECT_FALSE(wrote());
  EXPECT_FALSE(machine.stored.contains(pose_program));
  ASSERT_TRUE(machine.order(Operation::CONFIRM).accepted);
  ASSERT_EQ(machine.run(), Phase::FINISHED);
  EXPECT_TRUE(state().written);
  EXPECT_EQ(std::get<ParameterRequest>(machine.requests.back()).who, "test calibrate");
}

// Another head on the same machine: its end sits 0.4, -0.2, 0.1 mm beside that of the reference, which had
// measured the sphere where it truly is.
TEST(MeasurementOfAHead, AdaptsItToTheReferenceThatTheInputsHave) {
  Measurement core(test_facts("cb-head"));
  FakeMachine machine(core, "cb-head", "XYZBC");
  auto real = machine::chain_parameters(machine.delivered(), 0);
  const calibration::Vec3 origin = real.origin + calibration::Vec3(0.4, -0.2, 0.1);
  real.origin = origin;
  machine.become(real);
  const std::string inputs =
      "mode: correct\nreference: adapt\nsphere: {centre_mm: [60, 40, -360]}\nzero_offset_mm: [1, 2, "
      "3]\naxes:\n"
      "  B: {start_deg: -40, end_deg: 40, points: 3, other_deg: 0}\n"
      "  C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 40}\n";
  EXPECT_THAT(machine.measure(inputs).reason, HasSubstr("needs reference_measurement"));
  const auto reply = machine.measure(
      inputs + "reference_measurement: {sphere_mm: [60, 40, -360], zero_offset_mm: [1, 2, 3]}\n");
  ASSERT_TRUE(reply.accepted) << reply.reason;
  ASSERT_EQ(machine.run(), Phase::WAITING) << core.stored().state.error;
  std::map<std::uint32_t, double> found;
  for (const auto& change : core.stored().result.changes) found[change.number] = change.after;
  for (std::uint32_t i = 0; i < 3; ++i)
    EXPECT_NEAR(found.at(parameter::chain_origin.number(0) + i), origin[i], 1e-5) << i;
  // Measured under another work offset it is refused, and nothing moves.
  ASSERT_TRUE(machine.order(Operation::DISCARD).accepted);
  const auto count = machine.requests.size();
  const auto refused = machine.measure(
      inputs + "reference_measurement: {sphere_mm: [60, 40, -360], zero_offset_mm: [1, 2, 4]}\n");
  EXPECT_FALSE(refused.accepted);
  EXPECT_THAT(refused.reason, HasSubstr("is not the one of the reference, 1.0000 2.0000 4.0000 mm"));
  EXPECT_EQ(core.stored().state.phase, Phase::NOTHING);
  EXPECT_EQ(machine.requests.size(), count);
}

// The touches of five poses last minutes; Y of the vector of A does not say where it is along A.
TEST_F(MeasurementCore, RefusesBeforeTheFirstTouchWhatTheEvaluationWouldRefuse) {
  const std::string axes =
      "mode: correct\nsphere: {shaft: [0, 0, -1]}\naxes:\n"
      "  A: {start_deg: -60, end_deg: 60, points: 3, other_deg: 0, normalization: ";
  const std::string rest = "}\n  C: {start_deg: 0, end_deg: 240, points: 3, other_deg: 0}\n";
  for (const auto& [mode, reason] :
       {std::pair{"5", "the normalizations do not fix the free components"},
        std::pair{"14", "normalization: the chain is open for all axes or for none"}}) {
    const auto reply = machine.measure(axes + mode + rest);
    EXPECT_FALSE(reply.accepted) << mode;
    EXPECT_THAT(reply.reason, HasSubstr(reason));
    EXPECT_EQ(state().phase, Phase::NOTHING);
    EXPECT_TRUE(machine.requests.empty());
  }
  EXPECT_TRUE(machine.measure(axes + "4" + rest).accepted);
}

TEST_F(MeasurementCore, StopsWhenAnyRequestIsRefusedAndGoesOnAfterThat) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  const auto changes = result().changes;
  const auto count = machine.requests.size();
  ASSERT_GT(count, 60u);
  for (std::size_t i = 0; i + 1 < count; ++i) {  // the last one removes the program of the poses
    begin_again();
    FakeMachine fresh(*core);
    machine = fresh;
    machine.refused = i;
    begin();
    const auto phase = machine.run();
    const auto* command = std::get_if<ChannelRequest>(&machine.requests[i]);
    if (command != nullptr && command->command == CommandKind::SELECT_PROGRAM) {
      // The list with the new program may reach the channel after the answer of the store.
      ASSERT_EQ(phase, Phase::WAITING) << "request " << i;
      continue;
    }
    ASSERT_EQ(phase, Phase::INTERRUPTED) << "request " << i;
    EXPECT_THAT(state().error, HasSubstr("refused; nothing written"));
    EXPECT_FALSE(wrote());
    ASSERT_TRUE(machine.order(Operation::CONTINUE).accepted);
    ASSERT_EQ(machine.run(), Phase::WAITING) << "request " << i << ": " << state().error;
    EXPECT_EQ(result().changes, changes);
  }
}

TEST_F(MeasurementCore, StopsWhenARequestIsNotAnswered) {
  machine.silent = 3;
  begin();
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_THAT(state().error, HasSubstr("does not answer; nothing written, 0 of 5 poses"));
}

TEST_F(MeasurementCore, EndsAtAnyInstantWithoutMovingAfterwardsAndGoesOnToTheSameResult) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  const auto changes = result().changes;
  const auto kept = machine.kept;
  ASSERT_GE(kept.size(), 9u);
  for (const auto& text : kept) {
    begin_again();
    FakeMachine fresh(*core);
    machine = fresh;
    core->restore(parse_measurement(text));
    const auto phase = machine.run();
    for (int i = 0; i < 50; ++i) machine.step();
    EXPECT_TRUE(machine.requests.empty()) << "an idle channel needs no hold, and nothing moves";
    if (phase == Phase::INTERRUPTED) {
      EXPECT_THAT(state().error, HasSubstr("the measurement process has ended; nothing written, "));
      ASSERT_TRUE(machine.order(Operation::CONTINUE).accepted);
      ASSERT_EQ(machine.run(), Phase::WAITING) << state().error;
    }
    ASSERT_EQ(state().phase, Phase::WAITING);
    EXPECT_EQ(result().changes, changes);
  }
}

TEST_F(MeasurementCore, HoldsAProgramOfItsOwnThatRunsWhenItIsRestored) {
  begin();
  machine.endless = true;
  for (int i = 0; i < 100 && machine.state.state != idl::channel::RunState::RUNNING; ++i) machine.step();
  const auto text = machine.kept.back();
  auto requests = machine.requests.size();
  core = std::make_unique<Measurement>(test_facts());
  machine.attach(*core);
  core->restore(parse_measurement(text));
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  ASSERT_EQ(machine.requests.size(), requests + 1);
  EXPECT_EQ(std::get<ChannelRequest>(machine.requests.back()).command, CommandKind::FEED_HOLD);
  EXPECT_THAT(state().error, HasSubstr("the channel is HELD, reset it before anything else"));
  EXPECT_THAT(machine.order(Operation::CONTINUE).reason, HasSubstr("end or reset it first"));
}

TEST_F(MeasurementCore, LeavesAProgramOfAnOperatorAlone) {
  begin();
  const auto text = machine.kept.back();
  begin_again();
  machine.endless = true;
  machine.state.program = "part.nc";
  machine.state.state = idl::channel::RunState::RUNNING;
  core->restore(parse_measurement(text));
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_TRUE(machine.requests.empty());
}

TEST_F(MeasurementCore, HoldsTheChannelOnAbort) {
  begin();
  machine.endless = true;
  for (int i = 0; i < 100 && machine.state.state != idl::channel::RunState::RUNNING; ++i) machine.step();
  ASSERT_TRUE(machine.order(Operation::ABORT).accepted);
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_EQ(std::get<ChannelRequest>(machine.requests.back()).command, CommandKind::FEED_HOLD);
  EXPECT_THAT(state().error, HasSubstr("repeatability of the probe: aborted; the channel is HELD"));
}

TEST_F(MeasurementCore, NamesTheAlarmThatHasHeldTheChannel) {
  begin();
  machine.endless = true;
  for (int i = 0; i < 100 && machine.state.state != idl::channel::RunState::RUNNING; ++i) machine.step();
  for (int i = 0; i < 10; ++i) machine.step();
  machine.state.state = idl::channel::RunState::HELD;
  machine.raise(130);
  ASSERT_EQ(machine.run(), Phase::INTERRUPTED);
  EXPECT_EQ(state().alarm, 130u);
  EXPECT_THAT(state().error, HasSubstr("repeatability of the probe: alarm 130: cause"));
  EXPECT_THAT(machine.order(Operation::CONTINUE).reason, HasSubstr("alarm 130"));
  machine.raise(130, false);
  machine.state.state = idl::channel::RunState::IDLE;
  machine.endless = false;
  ASSERT_TRUE(machine.order(Operation::CONTINUE).accepted);
  EXPECT_EQ(machine.run(), Phase::WAITING) << state().error;
}

TEST_F(MeasurementCore, ConfirmsNothingThatWasChangedMeanwhile) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  const auto number = result().changes.front().number;
  for (auto& value : machine.set.values)
    if (value.number == number) value.value += 1;
  if (std::none_of(machine.set.values.begin(), machine.set.values.end(),
                   [&](auto& v) { return v.number == number; }))
    machine.set.values.push_back({number, 1, ""});
  EXPECT_THAT(machine.order(Operation::CONFIRM).reason, HasSubstr("was changed since the measurement"));
  EXPECT_FALSE(wrote());
}

TEST_F(MeasurementCore, TakesNoOtherAnswerForThatOfTheImport) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  const auto removal = machine.requests.size() - 1;
  begin_again();
  FakeMachine fresh(*core);
  machine = fresh;
  machine.silent = removal;
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  ASSERT_TRUE(machine.order(Operation::CONFIRM).accepted);
  core->answered(1, {true, ""}, machine.now);
  EXPECT_EQ(state().phase, Phase::WRITING);
  ASSERT_EQ(machine.run(), Phase::FINISHED);
  EXPECT_TRUE(wrote());
}

TEST_F(MeasurementCore, KnowsAfterARestartWhetherItHasWritten) {
  begin();
  ASSERT_EQ(machine.run(), Phase::WAITING);
  ASSERT_TRUE(machine.order(Operation::CONFIRM).accepted);
  const auto text = machine.kept.back();
  core = std::make_unique<Measurement>(test_facts());
  machine.attach(*core);
  core->restore(parse_measurement(text));
  EXPECT_EQ(machine.run(), Phase::WAITING) << "the request was never sent";
  ASSERT_TRUE(machine.order(Operation::CONFIRM).accepted);
  ASSERT_EQ(machine.run(), Phase::FINISHED);
  core = std::make_unique<Measurement>(test_facts());
  machine.attach(*core);
  core->restore(parse_measurement(text));
  EXPECT_EQ(machine.run(), Phase::FINISHED) << "the values wait for a reset";
  EXPECT_TRUE(state().written);
}

TEST(StoredMeasurement, IsRefusedWhenItIsNone) {
  const auto error = [](const std::string& text) {
    try {
      parse_measurement(text);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(error(""), "");
  EXPECT_NE(error("[1]"), "");
  EXPECT_EQ(error("{}"), "");
  EXPECT_EQ(error(R"({"state": {"phase": 99}})"), "the phase is not known");
  EXPECT_EQ(error(R"({"result": {"poses": [{"angles": [1]}]}})"), "a pose is incomplete");
  EXPECT_EQ(error(R"({"request": {"sphere": [1, 2]}})"), "the sphere has not three coordinates");
}

}  // namespace
}  // namespace trunnion::measurement
