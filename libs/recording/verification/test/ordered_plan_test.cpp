// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "sample_recording.hpp"
#include "verification/verify_plan.hpp"

namespace trunnion::verification {
namespace {

TEST(OrderedPlan, FeedsEachInputOnceTheServiceHasWrittenWhatItHadWrittenBefore) {
  StoredRecording recording;
  recording.messages = {
      parameters(1, 1),
      stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{0, 4097, false}, 10),
      stored(
          topics::auxiliary_request,
          idl::channel::AuxiliaryRequest{0, 4097, idl::channel::AuxiliaryKind::NO_AUXILIARY, 3, 0, false, 0},
          20),
      stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{0, 4098, false}, 30),
      stored(topics::feedback, feedback(0, 8), 5),
  };
  const auto plan = plan_verification(recording, "channel", 0);
  ASSERT_EQ(plan.steps.size(), 4u);
  EXPECT_EQ(plan.steps[1].message->topic->handle, "feedback") << "by the time of writing";
  EXPECT_TRUE(plan.steps[2].needs.empty());
  ASSERT_EQ(plan.steps[3].needs.size(), 1u);
  EXPECT_EQ(plan.steps[3].needs[0].place, (Place{4097, 1})) << "its request has to be there first";
  EXPECT_TRUE(plan.end.empty()) << "nothing was written after the last input";
}

TEST(OrderedPlan, NamesTheFirstCyclesOfTheFeedbackThatTheRecorderHasLost) {
  StoredRecording recording;
  recording.messages = {parameters(1, 1), stored(topics::path_batch, path_batch(0, true, true), 3),
                        stored(topics::feedback, feedback(0, 8), 5),
                        stored(topics::feedback, feedback(8, 0), 6),
                        stored(topics::feedback, feedback(8, 8), 7)};
  EXPECT_EQ(missing_feedback(plan_verification(recording, "channel", 0)), "");
  recording.messages.push_back(stored(topics::feedback, feedback(40, 8), 8));
  recording.messages.push_back(stored(topics::feedback, feedback(64, 8), 9));
  EXPECT_EQ(missing_feedback(plan_verification(recording, "channel", 0)),
            "the recording misses cycles 16 to 39 of feedback");
}

TEST(OrderedPlan, NamesTheRequestThatTheRecorderHasLost) {
  StoredRecording recording;
  const auto reply = [](std::uint64_t client, std::uint64_t number) {
    idl::channel::ChannelReply r;
    r.client = client, r.number = number;
    return r;
  };
  idl::channel::ChannelRequest request;
  request.client = 7000000, request.number = 1;
  recording.messages = {
      stored(topics::channel_reply, reply(8000000, 3), 5),  // answered before the recording began
      stored(topics::snapshot_request, idl::service::SnapshotRequest{}, 10),
      stored(topics::channel_request, request, 11), stored(topics::channel_reply, reply(7000000, 1), 12),
      stored(topics::channel_reply, reply(1, 4), 13)};  // outputs of the PLC taken by channel 0
  EXPECT_EQ(missing_request(recording), "");
  recording.messages.push_back(stored(topics::channel_reply, reply(7000000, 2), 14));
  EXPECT_EQ(missing_request(recording),
            "the recording has the reply to request 2 of client 7000000, but not the request: record again");
}

TEST(OrderedPlan, AChannelIsFedAndComparedWithItsOwn) {
  auto recording = sample_recording(5);
  auto other = path_batch(0, true, true);
  other.channel = 1;
  recording.messages.push_back(stored(topics::path_batch, other, 5000));
  EXPECT_EQ(plan_verification(recording, "channel", 0).cycles, 40u);
  const auto plan = plan_verification(recording, "channel", 1);
  EXPECT_EQ(plan.cycles, 8u);
  EXPECT_TRUE(plan.ignored.contains("auxiliary_request.cycle"));
}

// The reader of a state keeps the newest alone: a channel that gets its processor late misses the others.
TEST(OrderedPlan, OutputsThatOthersReplacedBeforeTheChannelReadThemAreNotFed) {
  const auto outputs = [](bool hold) {
    idl::plc::Outputs made;
    made.tick = 7;  // nothing moves, so all are of one tick
    made.feed_hold = hold;
    return made;
  };
  idl::channel::ChannelReply taken;
  taken.client = 2, taken.number = 7, taken.accepted = true;  // of channel 1
  StoredRecording recording;
  recording.messages = {
      parameters(1, 1),
      stored(topics::feedback, feedback(0, 8), 5),
      stored(topics::plc_outputs, outputs(false), 10),  // the first: there is nothing to differ from
      stored(topics::plc_outputs, outputs(true), 20),   // replaced by the next, which changes nothing
      stored(topics::plc_outputs, outputs(false), 21),
      stored(topics::plc_outputs, outputs(true), 30),
      stored(topics::channel_reply, taken, 31),
      stored(topics::plc_outputs, outputs(true), 40),  // published again
  };
  std::string fed;
  for (const auto& step : plan_verification(recording, "channel", 1).steps)
    if (step.message->topic->handle == "plc_outputs") fed += std::to_string(step.message->time) + " ";
  EXPECT_EQ(fed, "10 21 30 40 ");
}

// Virtual time goes on by a hundred ticks at once: the PLC may have written again before the channel has
// answered the outputs that it has taken.
TEST(OrderedPlan, OutputsThatArriveTogetherAreFedAsTheChannelTookThem) {
  const auto outputs = [](std::uint64_t tick, bool hold) {
    idl::plc::Outputs made;
    made.tick = tick;
    made.feed_hold = hold;
    return made;
  };
  const auto taken = [](std::uint64_t tick) {
    idl::channel::ChannelReply reply;
    reply.client = 1, reply.number = tick, reply.accepted = true;  // of channel 0
    return reply;
  };
  const auto fed = [](const StoredRecording& recording) {
    std::string text;
    for (const auto& step : plan_verification(recording, "channel", 0).steps)
      if (step.message->topic->handle == "plc_outputs")
        text += std::to_string(step.message->time) + (step.needs.empty() ? " " : " behind an answer ");
    return text;
  };
  StoredRecording before;
  before.messages = {parameters(1, 1), stored(topics::plc_outputs, outputs(2530, false), 10),
                     stored(topics::plc_outputs, outputs(2630, true), 20)};
  auto first = before, second = before, both = before;
  first.messages.push_back(stored(topics::plc_outputs, outputs(2730, true), 25));
  first.messages.push_back(stored(topics::channel_reply, taken(2630), 30));
  EXPECT_EQ(fed(first), "10 20 25 behind an answer ") << "the second ones change nothing";
  second.messages.push_back(stored(topics::plc_outputs, outputs(2730, true), 25));
  second.messages.push_back(stored(topics::channel_reply, taken(2730), 30));
  EXPECT_EQ(fed(second), "10 25 ") << "the second ones replaced the first";
  both.messages.push_back(stored(topics::plc_outputs, outputs(2730, false), 25));
  both.messages.push_back(stored(topics::channel_reply, taken(2630), 30));
  both.messages.push_back(stored(topics::channel_reply, taken(2730), 35));
  EXPECT_EQ(fed(both), "10 20 25 behind an answer ");
}

// The sample has neither requests to the program service nor its replies.
TEST(OrderedPlan, AServiceThatHadNothingToDoIsToldFromARecordingThatCannotBeUsed) {
  auto recording = sample_recording(2);
  EXPECT_THROW(plan_verification(recording, "program", 0), NothingToVerify);
  recording.foreign = {"elsewhere/topic"};
  try {
    plan_verification(recording, "program", 0);
    ADD_FAILURE() << "it is planned";
  } catch (const NothingToVerify& error) {
    ADD_FAILURE() << error.what();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("another contract"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace trunnion::verification
