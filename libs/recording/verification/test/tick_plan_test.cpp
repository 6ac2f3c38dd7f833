// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "sample_recording.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {
namespace {

TEST(TickPlan, GivesTheDriveItsInputsAtTheTicksAtWhichTheyTookEffect) {
  // The PLC's order was written before the second batch and taken behind it, at tick 8.
  StoredRecording recording;
  const auto batch = [](std::uint64_t first) {
    idl::stream::AxisBatch f;
    f.first = first, f.count = 8;
    return f;
  };
  auto before = feedback(0, 8), after = feedback(8, 8);
  using idl::stream::Input;
  before.tick = 8;
  before.applied = {{Input::PARAMETER_SET, 0, 1}, {Input::GANTRY_BATCH, 0, 10}, {Input::GANTRY_BATCH, 8, 30}};
  after.tick = 16;
  after.applied = {{Input::PLC_OUTPUTS, 8, 20}};
  recording.messages = {
      parameters(1, 1),
      stored(topics::gantry_batch, batch(0), 10),
      stored(topics::plc_outputs, idl::plc::Outputs{}, 20),
      stored(topics::gantry_batch, batch(8), 30),
      stored(topics::feedback, before, 40),
      stored(topics::feedback, after, 50),
  };
  const auto plan = plan_verification(recording, "drive", 0);
  ASSERT_EQ(plan.steps.size(), 4u);
  EXPECT_EQ(plan.steps[0].message->topic->handle, "parameter_set");
  EXPECT_EQ(plan.steps[1].message->topic->handle, "gantry_batch");
  // An order of the same tick as a batch goes first: the batch lets the drive go on.
  EXPECT_EQ(plan.steps[2].message->topic->handle, "plc_outputs");
  ASSERT_EQ(plan.steps[2].needs.size(), 1u);
  EXPECT_EQ(plan.steps[2].needs[0].place, (Place{8, 8})) << "8 cycles and 8 ticks";
  EXPECT_TRUE(plan.steps[2].apart);
  EXPECT_EQ(plan.steps[3].message->topic->handle, "gantry_batch");
  ASSERT_EQ(plan.steps[3].needs.size(), 1u);
  EXPECT_EQ(plan.steps[3].needs[0].track.topic->handle, "plc_outputs") << "until the drive says it has them";
  EXPECT_EQ(plan.steps[3].needs[0].place, (Place{0, 1}));
  EXPECT_EQ(plan.cycles, 16u);
  EXPECT_EQ(plan.expected.size(), 2u);
}

// A recorder that came while the batch of time 10 was on its way to the drive.
TEST(TickPlan, AStateBehindWhichASetpointIsMissingIsPassedOver) {
  using idl::stream::Input;
  StoredRecording recording;
  const auto batch = [](std::uint64_t first) {
    idl::stream::AxisBatch f;
    f.first = first, f.count = 8;
    return f;
  };
  const auto state = [](std::uint64_t time, std::uint64_t taken) {
    idl::service::ServiceSnapshot head;
    head.instance = 1, head.pid = 100, head.number = time, head.time = time;
    head.kind = idl::service::SnapshotKind::GIVEN;
    head.taken = {{topics::gantry_batch.name, taken}};
    return snapshot::parts_of(head, "{}").front();
  };
  idl::service::Cluster cluster;
  cluster.virtual_time = true;
  cluster.services.resize(1);
  cluster.services[0].instance = 1, cluster.services[0].service = "drive";
  auto first = feedback(0, 8), second = feedback(8, 8);
  first.tick = 8, second.tick = 16;
  first.applied = {{Input::GANTRY_BATCH, 0, 10}};
  second.applied = {{Input::GANTRY_BATCH, 8, 30}};
  recording.messages = {parameters(1, 1),
                        stored(topics::cluster, cluster, 2),
                        stored(topics::snapshot_request, {1, 1}, 12),
                        stored(topics::service_snapshot, state(15, 9), 16),
                        stored(topics::feedback, first, 20),
                        stored(topics::gantry_batch, batch(8), 30)};
  try {
    plan_verification(recording, "drive", 0);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(
        error.what(),
        "it cannot be verified: the drive executed a message of gantry_batch at tick 0 that the recording "
        "does not have. Begin the recording before the motion");
  }
  recording.messages.push_back(stored(topics::service_snapshot, state(25, 10), 26));
  recording.messages.push_back(stored(topics::feedback, second, 40));
  const auto plan = plan_verification(recording, "drive", 0);
  ASSERT_TRUE(plan.seed);
  EXPECT_EQ(plan.seed->time, 25u);
  EXPECT_EQ(plan.cycles, 8u);
  EXPECT_EQ(plan.expected.size(), 1u);
}

TEST(TickPlan, OutputsOfThePlcThatWereOverwrittenBeforeTheRecordingAreStoodInForByTheNextOnes) {
  using idl::stream::Input;
  // The outputs of time 10 let time go on to tick 12; the recorder came when those of time 20 had replaced
  // them.
  StoredRecording recording;
  auto start = feedback(0, 0), end = feedback(0, 0);
  start.tick = 12;
  start.applied = {{Input::PARAMETER_SET, 0, 1}, {Input::PLC_OUTPUTS, 0, 10}};
  end.tick = 40;
  end.applied = {{Input::PLC_OUTPUTS, 12, 20}};
  idl::plc::Outputs outputs;
  outputs.run_until_tick = 40;
  recording.messages = {parameters(1, 1), stored(topics::feedback, start, 15),
                        stored(topics::plc_outputs, outputs, 20), stored(topics::feedback, end, 25)};
  const auto plan = plan_verification(recording, "drive", 0);
  ASSERT_EQ(plan.steps.size(), 3u);
  idl::plc::Outputs given;
  ASSERT_TRUE(bus::decode(plan.steps[1].message->cdr, given));
  EXPECT_EQ(given.run_until_tick, 12u);
  ASSERT_TRUE(bus::decode(plan.steps[2].message->cdr, given));
  EXPECT_EQ(given.run_until_tick, 40u);
  EXPECT_EQ(plan.steps[2].needs.size(), 2u) << "tick 12, and the stand-in was taken";
  EXPECT_EQ(plan.spindles_unknown, "") << "the spindles were ordered nothing before and behind it";
}

// The drive took outputs of times 10, 20 and 30 at ticks 0, 12 and 24; those of time 20 were overwritten
// before they were recorded.
VerifyPlan plan_without_the_second_outputs(double speed_before, double speed_behind) {
  using idl::stream::Input;
  StoredRecording recording;
  auto end = feedback(0, 8);
  end.tick = 40;
  end.applied = {{Input::PARAMETER_SET, 0, 1},
                 {Input::PLC_OUTPUTS, 0, 10},
                 {Input::PLC_OUTPUTS, 12, 20},
                 {Input::PLC_OUTPUTS, 24, 30}};
  idl::plc::Outputs before, behind;
  before.spindle_speed = {speed_before}, behind.spindle_speed = {speed_behind};
  behind.run_until_tick = 40, behind.feed_hold = true;
  recording.messages = {parameters(1, 1), stored(topics::plc_outputs, before, 10),
                        stored(topics::plc_outputs, behind, 30), stored(topics::feedback, end, 35)};
  auto plan = plan_verification(recording, "drive", 0);
  plan.steps.clear();  // they point into the recording
  return plan;
}

TEST(TickPlan, SaysThatLostOutputsOfThePlcLeaveTheSpindlesOpenWhenTheirOrdersHaveChanged) {
  EXPECT_EQ(plan_without_the_second_outputs(1000, 1000).spindles_unknown, "");
  EXPECT_EQ(plan_without_the_second_outputs(1000, 0).spindles_unknown,
            "the recording lacks outputs of the PLC that the drive took at tick 12, and those around them do "
            "not say what they ordered the spindles: record again");
}

TEST(TickPlan, SaysThatTheSpindlesAreOpenWhenTheDriveHasMissedThePlc) {
  StoredRecording recording;
  auto start = feedback(0, 8);
  start.applied = {{idl::stream::Input::PARAMETER_SET, 0, 1}};
  idl::service::Alarm missed;
  missed.number = 133, missed.active = true, missed.source = "drive";
  recording.messages = {parameters(1, 1), stored(topics::alarm, missed, 4),
                        stored(topics::feedback, start, 5)};
  EXPECT_EQ(
      plan_verification(recording, "drive", 0).spindles_unknown,
      "when the drive missed the PLC (alarm 133) is not in the recording, and it brings spindles to rest "
      "then");
  missed.number = 114;
  recording.messages[1] = stored(topics::alarm, missed, 4);
  EXPECT_EQ(plan_verification(recording, "drive", 0).spindles_unknown, "");
}

TEST(TickPlan, FeedbackThatBringsNoNewTickIsFedToThePlcWhereItWasWritten) {
  using idl::stream::Input;
  // At tick 8 the PLC takes a request; later, at the same tick, the drive gives a channel its next place.
  StoredRecording recording;
  auto place = feedback(8, 0);
  place.tick = 8;
  place.channels.resize(1);
  place.channels[0].active = true;
  idl::stream::InputLog log;
  log.tick = 8;
  log.applied = {{Input::AUXILIARY_REQUEST, 8, 20}};
  recording.messages = {parameters(1, 1),
                        stored(topics::feedback, feedback(0, 8), 10),
                        stored(topics::auxiliary_request, idl::channel::AuxiliaryRequest{}, 20),
                        stored(topics::plc_input_log, log, 21),
                        stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{}, 22),
                        stored(topics::feedback, place, 50)};
  std::string fed;
  const auto plan = plan_verification(recording, "plc", 0);
  for (const auto& step : plan.steps)
    fed += step.message->topic->handle + "@" + std::to_string(step.message->time) + " ";
  EXPECT_EQ(fed, "parameter_set@1 feedback@10 auxiliary_request@20 feedback@50 ");
}

TEST(TickPlan, ARecordingThatDoesNotSayWhenIsRefused) {
  StoredRecording recording;
  recording.messages = {parameters(1, 1), stored(topics::feedback, feedback(0, 8), 5)};
  EXPECT_THROW(plan_verification(recording, "drive", 0), std::runtime_error);
}

}  // namespace
}  // namespace trunnion::verification
