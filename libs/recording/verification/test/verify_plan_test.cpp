// SPDX-License-Identifier: Apache-2.0
#include "verification/verify_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "sample_recording.hpp"
#include "verification/answers.hpp"

namespace trunnion::verification {
namespace {

// Plays a plan against a kinematics that answers at once, and checks what every stage relies on.
void play(const VerifyPlan& plan) {
  Progress progress;
  std::uint64_t executed = 0, revision = 0;
  std::pair<std::uint64_t, std::uint64_t> done;
  MessageRows rows;
  for (const auto& step : plan.steps) {
    ASSERT_TRUE(progress.reached(step.needs)) << "what is waited for follows from what was fed";
    ASSERT_TRUE(rows.load(*step.message->topic, step.message->cdr));
    const auto& span = rows.span();
    if (step.message->topic->handle == "parameter_set") {
      idl::parameters::ParameterSet set;
      ASSERT_TRUE(bus::decode(step.message->cdr, set));
      revision = set.revision;
    } else if (step.message->topic->handle == "feedback") {
      EXPECT_GE(span.first + span.count, executed);
      executed = span.first + span.count;
    } else {
      EXPECT_EQ(span.revision, revision) << "parameters come before what is made with them";
      EXPECT_LE(span.first + span.count, executed + lead) << "never beyond the credit";
      const auto begin = std::pair<std::uint64_t, std::uint64_t>(span.epoch, span.first);
      EXPECT_GE(begin, done) << "no cycle is fed twice, and none after a later one";
      done = {span.epoch, span.first + span.count};
      auto answer = axis_batch(span.first, span.starts, span.ends, span.epoch);
      progress.observe(stored(topics::kinematics_batch, answer, 0));
    }
  }
  EXPECT_TRUE(progress.reached(plan.end));
}

TEST(StagePlan, FeedsEveryBatchWithinItsCreditAndExpectsEveryOutput) {
  const auto recording = sample_recording(100);
  const auto plan = plan_verification(recording, "kinematics", 0);
  EXPECT_EQ(plan.cycles, 800u);
  EXPECT_EQ(plan.expected.size(), 100u);
  EXPECT_EQ(plan.topics, (std::set<std::string>{"kinematics_batch"}));
  play(plan);
}

TEST(StagePlan, TheOrderInWhichTheRecorderHeardThingsDoesNotMatter) {
  auto recording = sample_recording(40);
  const auto handles = [](const VerifyPlan& plan) {
    std::vector<bus::Bytes> order;
    for (const auto& step : plan.steps) order.push_back(step.message->cdr);
    return order;
  };
  const auto straight = handles(plan_verification(recording, "kinematics", 0));
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    std::shuffle(recording.messages.begin(), recording.messages.end(), random);
    const auto plan = plan_verification(recording, "kinematics", 0);
    EXPECT_EQ(handles(plan), straight);
    play(plan);
  }
}

TEST(StagePlan, AStartWaitsForEverythingBeforeIt) {
  auto recording = sample_recording(20);  // cycles 0..159
  add_motion(recording, 160, 20);
  const auto plan = plan_verification(recording, "kinematics", 0);
  MessageRows rows;
  bool found = false;
  for (const auto& step : plan.steps) {
    if (step.message->topic->handle != "path_batch") continue;
    ASSERT_TRUE(rows.load(*step.message->topic, step.message->cdr));
    if (rows.span().first != 160) continue;
    found = true;
    ASSERT_EQ(step.needs.size(), 1u);
    EXPECT_EQ(step.needs[0].place, (Place{1, 160})) << "epoch 1, every cycle below 160";
  }
  EXPECT_TRUE(found);
  play(plan);
}

TEST(StagePlan, AStageIsNeverFedMoreThanAWindowAhead) {
  const auto recording = sample_recording(200);
  const auto plan = plan_verification(recording, "kinematics", 0);
  Progress progress;  // of a stage that answers as late as it is allowed to
  MessageRows rows;
  for (const auto& step : plan.steps) {
    for (const auto& need : step.needs)
      if (!progress.reached(need))
        progress.observe(
            stored(topics::kinematics_batch, axis_batch(need.place.minor - batch_cycles, false, false), 0));
    ASSERT_TRUE(rows.load(*step.message->topic, step.message->cdr));
    if (step.message->topic->handle == "path_batch") {
      EXPECT_LE(rows.span().first + rows.span().count,
                progress.at({bus::find_topic("kinematics_batch"), 0}).minor + 512)
          << "half of the 1024 cycles that a stage keeps";
    }
  }
}

TEST(StagePlan, AnEpochThatWasGivenUpIsNotWaitedForBeyondWhatIsRecorded) {
  auto recording = sample_recording(20);  // cycles 0..159 of epoch 1
  // The last two batches of epoch 1 were never transformed: a reset came, and epoch 2 begins at cycle 144.
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    idl::stream::AxisBatch f;
    return m.topic->handle == "kinematics_batch" && bus::decode(m.cdr, f) && f.first >= 144;
  });
  add_motion(recording, 144, 10, 2);
  const auto plan = plan_verification(recording, "kinematics", 0);
  play(plan);
  // A service that does transform them is not wrong.
  auto produced = plan.expected;
  produced.push_back(stored(topics::kinematics_batch, axis_batch(144, false, false), 0));
  produced.push_back(stored(topics::kinematics_batch, axis_batch(152, false, true), 0));
  EXPECT_EQ(plan.drop_unrecorded(produced), 2u);
  EXPECT_EQ(produced.size(), plan.expected.size());
}

TEST(StagePlan, ParametersComeBeforeTheFirstBatchMadeWithThem) {
  auto recording = sample_recording(20);
  recording.messages.push_back(parameters(2, 900));
  recording.messages.push_back(parameters(3, 901));
  add_motion(recording, 160, 20);
  for (auto& message : recording.messages) {
    idl::stream::PathBatch batch;
    if (message.topic->handle != "path_batch" || !bus::decode(message.cdr, batch) || batch.first < 160)
      continue;
    batch.revision = 3;
    bus::encode(batch, message.cdr);
  }
  play(plan_verification(recording, "kinematics", 0));
}

TEST(StagePlan, ARecordingThatBeginsInMotionIsJoinedAtAConsistentCut) {
  auto recording = sample_recording(100);
  // Of the batches the recorder has 41 and on, of the feedback everything from cycle 280 on.
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    MessageRows rows;
    return is_cyclic(*m.topic) && rows.load(*m.topic, m.cdr) &&
           rows.span().first < (m.topic->handle == "feedback" ? 280u : 328u);
  });
  for (auto& message : recording.messages) {
    idl::stream::Feedback batch;
    if (message.topic->handle != "feedback" || !bus::decode(message.cdr, batch)) continue;
    batch.channels.resize(1);
    batch.channels[0].epoch = 1;
    batch.channels[0].active = true;
    batch.channels[0].states = {{idl::stream::Stage::KINEMATICS, batch.first + batch.count - 1, {}}};
    bus::encode(batch, message.cdr);
  }
  const auto plan = plan_verification(recording, "kinematics", 0);
  // The cut after cycle 327 is the first whose next batch is there; its lead reaches back to 295, which is.
  MessageRows rows;
  ASSERT_TRUE(rows.load(*plan.expected.front().topic, plan.expected.front().cdr));
  EXPECT_EQ(rows.span().first, 328u);
  EXPECT_EQ(plan.cycles, 800u - 328u);
  play(plan);
}

// In virtual time a batch is longer than the lead. With the feedback of its own cycles at hand a process that
// has just started would continue behind it.
TEST(StagePlan, ALongFirstBatchComesBeforeTheFeedbackOfItsCycles) {
  auto recording = sample_recording(5);
  std::erase_if(recording.messages, [](const StoredMessage& m) { return is_cyclic(*m.topic); });
  constexpr std::uint32_t batch = 64;
  static_assert(batch > lead);
  const auto lengthen = [](auto& message) {
    const auto width = message.setpoints.size() / message.count;
    message.count = batch;
    message.setpoints.assign(batch * width, 1.0);
    message.lines.assign(batch, 7);
  };
  auto path = path_batch(160, true, true);
  auto axes = axis_batch(160, true, true);
  lengthen(path), lengthen(axes);
  recording.messages.push_back(stored(topics::feedback, feedback(160, 0), 10));
  recording.messages.push_back(stored(topics::path_batch, path, 20));
  recording.messages.push_back(stored(topics::kinematics_batch, axes, 30));
  recording.messages.push_back(stored(topics::feedback, feedback(160, batch), 40));
  const auto plan = plan_verification(recording, "kinematics", 0);
  EXPECT_EQ(plan.cycles, batch);
  MessageRows rows;
  std::uint64_t executed = 0;
  bool fed = false;
  for (const auto& step : plan.steps) {
    if (step.message->topic->handle == "feedback" && rows.load(*step.message->topic, step.message->cdr))
      executed = rows.span().first + rows.span().count;
    if (step.message->topic->handle != "path_batch") continue;
    fed = true;
    EXPECT_EQ(executed, 160u);
  }
  EXPECT_TRUE(fed);
}

TEST(StagePlan, SaysWhichInputIsMissing) {
  auto recording = sample_recording(100);
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    idl::stream::PathBatch f;
    return m.topic->handle == "path_batch" && bus::decode(m.cdr, f) && f.first == 160;
  });
  try {
    plan_verification(recording, "kinematics", 0);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "the recording misses cycles 160 to 167 of path_batch");
  }
  const StoredRecording empty, small = sample_recording(5);
  EXPECT_THROW(plan_verification(empty, "kinematics", 0), std::runtime_error);
  EXPECT_THROW(plan_verification(small, "gantry", 0), std::runtime_error);
  EXPECT_THROW(plan_verification(small, "kinematic", 0), std::runtime_error);
}

TEST(Answers, AddressesTheRecordedReplyToWhoAsksNow) {
  StoredRecording recording;
  idl::program::ProgramRequest request;
  request.client = 11, request.number = 4;
  request.operation = idl::program::Operation::READ;
  request.name = "a.nc", request.revision = 2, request.offset = 60000;
  idl::program::ProgramReply reply;
  reply.client = 11, reply.number = 4, reply.accepted = true, reply.data = {'M', '3', '0'};
  recording.messages = {stored(topics::program_request, request, 1), stored(topics::program_reply, reply, 2)};
  Answers answers(recording);
  request.client = 99, request.number = 1;
  const auto bytes = answers.answer(stored(topics::program_request, request, 3));
  ASSERT_TRUE(bytes);
  idl::program::ProgramReply answer;
  ASSERT_TRUE(bus::decode(*bytes, answer));
  reply.client = 99, reply.number = 1;
  EXPECT_EQ(answer, reply);
  request.offset = 0;
  EXPECT_FALSE(answers.answer(stored(topics::program_request, request, 3))) << "nobody asked for that";
}

TEST(Answers, ALineOfDprntIsAnsweredAsInTheRecordingOneAfterTheOther) {
  StoredRecording recording;
  idl::program::ProgramRequest request;
  request.client = 11;
  request.operation = idl::program::Operation::WRITE;
  request.name = "DPRNT-a.nc.txt", request.data = {'X', '\n'};
  idl::program::ProgramReply reply;
  reply.client = 11;
  for (const bool accepted : {false, true}) {
    request.number = ++reply.number;
    reply.accepted = accepted;
    recording.messages.push_back(stored(topics::program_request, request, 2 * reply.number));
    recording.messages.push_back(stored(topics::program_reply, reply, 2 * reply.number + 1));
  }
  Answers answers(recording);
  request.client = 99;
  for (const bool accepted : {false, true, true}) {
    const auto bytes = answers.answer(stored(topics::program_request, request, 9));
    idl::program::ProgramReply answer;
    ASSERT_TRUE(bytes && bus::decode(*bytes, answer));
    EXPECT_EQ(answer.accepted, accepted);
    EXPECT_EQ(answer.client, 99u);
  }
  request.name = "a.nc";
  EXPECT_FALSE(answers.answer(stored(topics::program_request, request, 9))) << "an upload";
}

TEST(RaisedAlarms, AreThoseOfTheServiceThatWereActive) {
  idl::service::Alarm alarm;
  alarm.source = "gantry", alarm.number = 120, alarm.part = 3, alarm.text = "off", alarm.active = true;
  auto over = alarm, other = alarm;
  over.number = 121, over.active = false;
  other.source = "drive";
  const auto raised = raised_alarms(
      {stored(topics::alarm, alarm, 1), stored(topics::alarm, over, 2), stored(topics::alarm, other, 3)},
      "gantry");
  ASSERT_EQ(raised.size(), 1u);
  EXPECT_EQ(raised.begin()->first, (std::pair<std::uint32_t, std::uint32_t>(120, 3)));
}

}  // namespace
}  // namespace trunnion::verification
