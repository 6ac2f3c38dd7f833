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
    } else if (step.message->topic->handle == "feedback_frame") {
      EXPECT_GE(span.first + span.count, executed);
      executed = span.first + span.count;
    } else {
      EXPECT_EQ(span.revision, revision) << "parameters come before what is made with them";
      EXPECT_LE(span.first + span.count, executed + lead) << "never beyond the credit";
      EXPECT_LT((std::pair<std::uint64_t, std::uint64_t>(span.epoch, span.first)),
                (std::pair<std::uint64_t, std::uint64_t>(span.epoch, span.first + 1)));
      auto answer = axis_frame(span.first, span.starts, span.ends, span.epoch);
      progress.observe(stored(topics::kinematics_frame, answer, 0));
    }
  }
  EXPECT_TRUE(progress.reached(plan.end));
}

TEST(StagePlan, FeedsEveryFrameWithinItsCreditAndExpectsEveryOutput) {
  const auto recording = sample_recording(100);
  const auto plan = plan_verification(recording, "kinematics", 0);
  EXPECT_EQ(plan.cycles, 800u);
  EXPECT_EQ(plan.expected.size(), 100u);
  EXPECT_EQ(plan.topics, (std::set<std::string>{"kinematics_frame"}));
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
    if (step.message->topic->handle != "path_frame") continue;
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
            stored(topics::kinematics_frame, axis_frame(need.place.minor - frame_cycles, false, false), 0));
    ASSERT_TRUE(rows.load(*step.message->topic, step.message->cdr));
    if (step.message->topic->handle == "path_frame") {
      EXPECT_LE(rows.span().first + rows.span().count,
                progress.at({bus::find_topic("kinematics_frame"), 0}).minor + 512)
          << "half of the 1024 cycles that a stage keeps";
    }
  }
}

TEST(StagePlan, AnEpochThatWasGivenUpIsNotWaitedForBeyondWhatIsRecorded) {
  auto recording = sample_recording(20);  // cycles 0..159 of epoch 1
  // The last two frames of epoch 1 were never transformed: a reset came, and epoch 2 begins at cycle 144.
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    idl::stream::AxisFrame f;
    return m.topic->handle == "kinematics_frame" && bus::decode(m.cdr, f) && f.first >= 144;
  });
  add_motion(recording, 144, 10, 2);
  const auto plan = plan_verification(recording, "kinematics", 0);
  play(plan);
  // A service that does transform them is not wrong.
  auto produced = plan.expected;
  produced.push_back(stored(topics::kinematics_frame, axis_frame(144, false, false), 0));
  produced.push_back(stored(topics::kinematics_frame, axis_frame(152, false, true), 0));
  EXPECT_EQ(plan.drop_unrecorded(produced), 2u);
  EXPECT_EQ(produced.size(), plan.expected.size());
}

TEST(StagePlan, ParametersComeBeforeTheFirstFrameMadeWithThem) {
  auto recording = sample_recording(20);
  recording.messages.push_back(parameters(2, 900));
  recording.messages.push_back(parameters(3, 901));
  add_motion(recording, 160, 20);
  for (auto& message : recording.messages) {
    idl::stream::PathFrame frame;
    if (message.topic->handle != "path_frame" || !bus::decode(message.cdr, frame) || frame.first < 160)
      continue;
    frame.revision = 3;
    bus::encode(frame, message.cdr);
  }
  play(plan_verification(recording, "kinematics", 0));
}

TEST(StagePlan, ARecordingThatBeginsInMotionIsJoinedAtAConsistentCut) {
  auto recording = sample_recording(100);
  // Of the frames the recorder has 41 and on, of the feedback everything from cycle 280 on.
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    MessageRows rows;
    return is_cyclic(*m.topic) && rows.load(*m.topic, m.cdr) &&
           rows.span().first < (m.topic->handle == "feedback_frame" ? 280u : 328u);
  });
  for (auto& message : recording.messages) {
    idl::stream::FeedbackFrame frame;
    if (message.topic->handle != "feedback_frame" || !bus::decode(message.cdr, frame)) continue;
    frame.channels.resize(1);
    frame.channels[0].epoch = 1;
    frame.channels[0].active = true;
    frame.channels[0].states = {{idl::stream::Stage::KINEMATICS, frame.first + frame.count - 1, {}}};
    bus::encode(frame, message.cdr);
  }
  const auto plan = plan_verification(recording, "kinematics", 0);
  // The cut after cycle 327 is the first whose next frame is there; its lead reaches back to 295, which is.
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
  const auto lengthen = [](auto& frame) {
    const auto width = frame.setpoints.size() / frame.count;
    frame.count = batch;
    frame.setpoints.assign(batch * width, 1.0);
    frame.lines.assign(batch, 7);
  };
  auto path = path_frame(160, true, true);
  auto axes = axis_frame(160, true, true);
  lengthen(path), lengthen(axes);
  recording.messages.push_back(stored(topics::feedback_frame, feedback_frame(160, 0), 10));
  recording.messages.push_back(stored(topics::path_frame, path, 20));
  recording.messages.push_back(stored(topics::kinematics_frame, axes, 30));
  recording.messages.push_back(stored(topics::feedback_frame, feedback_frame(160, batch), 40));
  const auto plan = plan_verification(recording, "kinematics", 0);
  EXPECT_EQ(plan.cycles, batch);
  MessageRows rows;
  std::uint64_t executed = 0;
  bool fed = false;
  for (const auto& step : plan.steps) {
    if (step.message->topic->handle == "feedback_frame" && rows.load(*step.message->topic, step.message->cdr))
      executed = rows.span().first + rows.span().count;
    if (step.message->topic->handle != "path_frame") continue;
    fed = true;
    EXPECT_EQ(executed, 160u);
  }
  EXPECT_TRUE(fed);
}

TEST(StagePlan, SaysWhichInputIsMissing) {
  auto recording = sample_recording(100);
  std::erase_if(recording.messages, [](const StoredMessage& m) {
    idl::stream::PathFrame f;
    return m.topic->handle == "path_frame" && bus::decode(m.cdr, f) && f.first == 160;
  });
  try {
    plan_verification(recording, "kinematics", 0);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "the recording misses cycles 160 to 167 of path_frame");
  }
  const StoredRecording empty, small = sample_recording(5);
  EXPECT_THROW(plan_verification(empty, "kinematics", 0), std::runtime_error);
  EXPECT_THROW(plan_verification(small, "gantry", 0), std::runtime_error);
  EXPECT_THROW(plan_verification(small, "kinematic", 0), std::runtime_error);
}

TEST(OrderedPlan, FeedsEachInputOnceTheServiceHasWrittenWhatItHadWrittenBefore) {
  StoredRecording recording;
  recording.messages = {
      parameters(1, 1),
      stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{0, 4097, false}, 10),
      stored(topics::auxiliary_request,
             idl::channel::AuxiliaryRequest{0, 4097, idl::channel::AuxiliaryKind::NO_AUXILIARY, 3, 0, 0}, 20),
      stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{0, 4098, false}, 30),
      stored(topics::feedback_frame, feedback_frame(0, 8), 5),
  };
  const auto plan = plan_verification(recording, "channel", 0);
  ASSERT_EQ(plan.steps.size(), 4u);
  EXPECT_EQ(plan.steps[1].message->topic->handle, "feedback_frame") << "by the time of writing";
  EXPECT_TRUE(plan.steps[2].needs.empty());
  ASSERT_EQ(plan.steps[3].needs.size(), 1u);
  EXPECT_EQ(plan.steps[3].needs[0].place, (Place{4097, 1})) << "its request has to be there first";
  EXPECT_TRUE(plan.end.empty()) << "nothing was written after the last input";
}

TEST(OrderedPlan, NamesTheFirstCyclesOfTheFeedbackThatTheRecorderHasLost) {
  StoredRecording recording;
  recording.messages = {parameters(1, 1), stored(topics::path_frame, path_frame(0, true, true), 3),
                        stored(topics::feedback_frame, feedback_frame(0, 8), 5),
                        stored(topics::feedback_frame, feedback_frame(8, 0), 6),
                        stored(topics::feedback_frame, feedback_frame(8, 8), 7)};
  EXPECT_EQ(missing_feedback(plan_verification(recording, "channel", 0)), "");
  recording.messages.push_back(stored(topics::feedback_frame, feedback_frame(40, 8), 8));
  recording.messages.push_back(stored(topics::feedback_frame, feedback_frame(64, 8), 9));
  EXPECT_EQ(missing_feedback(plan_verification(recording, "channel", 0)),
            "the recording misses cycles 16 to 39 of feedback_frame");
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

TEST(TickPlan, GivesTheDriveItsInputsAtTheTicksAtWhichTheyTookEffect) {
  // The PLC's order was written before the second frame and taken behind it, at tick 8.
  StoredRecording recording;
  const auto frame = [](std::uint64_t first) {
    idl::stream::AxisFrame f;
    f.first = first, f.count = 8;
    return f;
  };
  auto before = feedback_frame(0, 8), after = feedback_frame(8, 8);
  using idl::stream::Input;
  before.tick = 8;
  before.applied = {{Input::PARAMETER_SET, 0, 1}, {Input::GANTRY_FRAME, 0, 10}, {Input::GANTRY_FRAME, 8, 30}};
  after.tick = 16;
  after.applied = {{Input::PLC_OUTPUTS, 8, 20}};
  recording.messages = {
      parameters(1, 1),
      stored(topics::gantry_frame, frame(0), 10),
      stored(topics::plc_outputs, idl::plc::Outputs{}, 20),
      stored(topics::gantry_frame, frame(8), 30),
      stored(topics::feedback_frame, before, 40),
      stored(topics::feedback_frame, after, 50),
  };
  const auto plan = plan_verification(recording, "drive", 0);
  ASSERT_EQ(plan.steps.size(), 4u);
  EXPECT_EQ(plan.steps[0].message->topic->handle, "parameter_set");
  EXPECT_EQ(plan.steps[1].message->topic->handle, "gantry_frame");
  // An order of the same tick as a frame goes first: the frame lets the drive go on.
  EXPECT_EQ(plan.steps[2].message->topic->handle, "plc_outputs");
  ASSERT_EQ(plan.steps[2].needs.size(), 1u);
  EXPECT_EQ(plan.steps[2].needs[0].place, (Place{8, 8})) << "8 cycles and 8 ticks";
  EXPECT_TRUE(plan.steps[2].apart);
  EXPECT_EQ(plan.steps[3].message->topic->handle, "gantry_frame");
  ASSERT_EQ(plan.steps[3].needs.size(), 1u);
  EXPECT_EQ(plan.steps[3].needs[0].track.topic->handle, "plc_outputs") << "until the drive says it has them";
  EXPECT_EQ(plan.steps[3].needs[0].place, (Place{0, 1}));
  EXPECT_EQ(plan.cycles, 16u);
  EXPECT_EQ(plan.expected.size(), 2u);
}

// A recorder that came while the frame of time 10 was on its way to the drive.
TEST(TickPlan, AStateBehindWhichASetpointIsMissingIsPassedOver) {
  using idl::stream::Input;
  StoredRecording recording;
  const auto frame = [](std::uint64_t first) {
    idl::stream::AxisFrame f;
    f.first = first, f.count = 8;
    return f;
  };
  const auto state = [](std::uint64_t time, std::uint64_t taken) {
    idl::service::ServiceSnapshot head;
    head.instance = 1, head.pid = 100, head.number = time, head.time = time;
    head.kind = idl::service::SnapshotKind::GIVEN;
    head.taken = {{topics::gantry_frame.name, taken}};
    return snapshot::parts_of(head, "{}").front();
  };
  idl::service::Cluster cluster;
  cluster.virtual_time = true;
  cluster.services.resize(1);
  cluster.services[0].instance = 1, cluster.services[0].service = "drive";
  auto first = feedback_frame(0, 8), second = feedback_frame(8, 8);
  first.tick = 8, second.tick = 16;
  first.applied = {{Input::GANTRY_FRAME, 0, 10}};
  second.applied = {{Input::GANTRY_FRAME, 8, 30}};
  recording.messages = {parameters(1, 1),
                        stored(topics::cluster, cluster, 2),
                        stored(topics::snapshot_request, {1, 1}, 12),
                        stored(topics::service_snapshot, state(15, 9), 16),
                        stored(topics::feedback_frame, first, 20),
                        stored(topics::gantry_frame, frame(8), 30)};
  try {
    plan_verification(recording, "drive", 0);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(
        error.what(),
        "it cannot be verified: the drive executed a message of gantry_frame at tick 0 that the recording "
        "does not have. Begin the recording before the motion");
  }
  recording.messages.push_back(stored(topics::service_snapshot, state(25, 10), 26));
  recording.messages.push_back(stored(topics::feedback_frame, second, 40));
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
  auto start = feedback_frame(0, 0), end = feedback_frame(0, 0);
  start.tick = 12;
  start.applied = {{Input::PARAMETER_SET, 0, 1}, {Input::PLC_OUTPUTS, 0, 10}};
  end.tick = 40;
  end.applied = {{Input::PLC_OUTPUTS, 12, 20}};
  idl::plc::Outputs outputs;
  outputs.run_until_tick = 40;
  recording.messages = {parameters(1, 1), stored(topics::feedback_frame, start, 15),
                        stored(topics::plc_outputs, outputs, 20), stored(topics::feedback_frame, end, 25)};
  const auto plan = plan_verification(recording, "drive", 0);
  ASSERT_EQ(plan.steps.size(), 3u);
  idl::plc::Outputs given;
  ASSERT_TRUE(bus::decode(plan.steps[1].message->cdr, given));
  EXPECT_EQ(given.run_until_tick, 12u);
  ASSERT_TRUE(bus::decode(plan.steps[2].message->cdr, given));
  EXPECT_EQ(given.run_until_tick, 40u);
  EXPECT_EQ(plan.steps[2].needs.size(), 2u) << "tick 12, and the stand-in was taken";
}

TEST(TickPlan, FeedbackThatBringsNoNewTickIsFedToThePlcWhereItWasWritten) {
  using idl::stream::Input;
  // At tick 8 the PLC takes a request; later, at the same tick, the drive gives a channel its next place.
  StoredRecording recording;
  auto place = feedback_frame(8, 0);
  place.tick = 8;
  place.channels.resize(1);
  place.channels[0].active = true;
  idl::stream::InputLog log;
  log.tick = 8;
  log.applied = {{Input::AUXILIARY_REQUEST, 8, 20}};
  recording.messages = {parameters(1, 1),
                        stored(topics::feedback_frame, feedback_frame(0, 8), 10),
                        stored(topics::auxiliary_request, idl::channel::AuxiliaryRequest{}, 20),
                        stored(topics::plc_input_log, log, 21),
                        stored(topics::auxiliary_done, idl::plc::AuxiliaryDone{}, 22),
                        stored(topics::feedback_frame, place, 50)};
  std::string fed;
  const auto plan = plan_verification(recording, "plc", 0);
  for (const auto& step : plan.steps)
    fed += step.message->topic->handle + "@" + std::to_string(step.message->time) + " ";
  EXPECT_EQ(fed, "parameter_set@1 feedback_frame@10 auxiliary_request@20 feedback_frame@50 ");
}

TEST(TickPlan, ARecordingThatDoesNotSayWhenIsRefused) {
  StoredRecording recording;
  recording.messages = {parameters(1, 1), stored(topics::feedback_frame, feedback_frame(0, 8), 5)};
  EXPECT_THROW(plan_verification(recording, "drive", 0), std::runtime_error);
}

TEST(OrderedPlan, AChannelIsFedAndComparedWithItsOwn) {
  auto recording = sample_recording(5);
  auto other = path_frame(0, true, true);
  other.channel = 1;
  recording.messages.push_back(stored(topics::path_frame, other, 5000));
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
      stored(topics::feedback_frame, feedback_frame(0, 8), 5),
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
